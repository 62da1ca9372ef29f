#include "model/terrain/sampling/analytic_terrain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "lib/error/error.hpp"
#include "model/terrain/formats/culture.hpp"

namespace yars::model::terrain {

AnalyticTerrain::AnalyticTerrain(Height height_m, std::uint64_t generation, Material material)
    : height_m_(std::move(height_m)), generation_(generation), material_(std::move(material)) {}

Surface AnalyticTerrain::surface_at(geo::GeoPoint position, Interpolation /*interpolation*/) const {
  if (!std::isfinite(position.latitude_deg) || !std::isfinite(position.longitude_deg))
    return {std::numeric_limits<double>::quiet_NaN(), 0.0};
  const geo::GeoPoint wrapped{std::clamp(position.latitude_deg, -90.0, 90.0),
                              geo::wrapped_degrees(position.longitude_deg)};
  const double height_m = height_m_(wrapped);
  const std::uint8_t given = material_ ? material_(wrapped) : std::uint8_t{0};
  const std::uint8_t material = given <= kMaxMaterial ? given : std::uint8_t{0};
  return {height_m, height_m == 0.0 ? 1.0 : 0.0, material};
}

std::size_t AnalyticTerrain::surfaces(const PositionRun& positions, Interpolation interpolation,
                                      const SurfaceRun& found) const {
  const std::size_t count = positions.north_deg.size();
  YARS_REQUIRE(positions.east_deg.size(), ==, count);
  YARS_REQUIRE(found.elevation_m.size(), ==, count);
  YARS_REQUIRE(found.water.size(), ==, count);
  for (std::size_t i = 0; i < count; ++i) {
    const Surface surface = surface_at(position_of(positions, i), interpolation);
    found.elevation_m[i] = static_cast<float>(surface.elevation_m);
    found.water[i] = static_cast<float>(surface.water);
    if (!found.peak_m.empty()) found.peak_m[i] = found.elevation_m[i];
    if (!found.material.empty()) found.material[i] = surface.material;
  }
  return 0;
}

AnalyticTerrain::Height built_in_hills() {
  return [](geo::GeoPoint position) {
    // Whole numbers of waves around the earth avoid a seam at the antimeridian. Wave numbers without common factors
    // avoid visible repetition. Heights at the poles are finite.
    const double north = position.latitude_deg * geo::kRadiansPerDegree;
    const double east = position.longitude_deg * geo::kRadiansPerDegree;
    const double ranges =
        std::sin(311.0 * east + 0.9 * std::sin(97.0 * north)) * std::sin(353.0 * north + 0.7 * std::sin(83.0 * east));
    const double hills = std::sin(1301.0 * east + 401.0 * north) * std::sin(1499.0 * north - 307.0 * east);
    const double spurs = std::sin(4099.0 * east - 1103.0 * north) * std::sin(4507.0 * north + 1201.0 * east);
    return std::max(0.0, 400.0 + 520.0 * ranges + 200.0 * hills + 50.0 * spurs);
  };
}

}  // namespace yars::model::terrain
