// Terrain given by a formula. The built-in hills are the terrain of a configuration without a terrain directory.
// Input: position. Output: height [m MSL] and, optionally, surface material. A height of exactly 0 is water; NaN is
// void.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>

#include "lib/error/error.hpp"
#include "lib/geo/quantity.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain {

// Terrain view of a height function and, optionally, a function of surface material codes.
class AnalyticTerrain final : public TerrainView {
 public:
  using Height = std::function<double(geo::GeoPoint)>;
  using Material = std::function<std::uint8_t(geo::GeoPoint)>;
  // Without `material` the material code is 0 everywhere. Codes above kMaxMaterial are read as 0.
  explicit AnalyticTerrain(Height height_m, std::uint64_t generation = 1, Material material = {})
      : height_m_(std::move(height_m)), generation_(generation), material_(std::move(material)) {}

  std::uint64_t generation() const override { return generation_; }
  std::uint64_t resident_bytes() const override { return sizeof(*this); }
  Surface surface_at(geo::GeoPoint position, Interpolation interpolation) const override;
  bool has_materials() const override { return static_cast<bool>(material_); }
  std::size_t surfaces(const PositionRun& positions, Interpolation interpolation,
                       const SurfaceRun& found) const override;

 private:
  Height height_m_;
  std::uint64_t generation_;
  Material material_;
};

inline Surface AnalyticTerrain::surface_at(geo::GeoPoint position, Interpolation /*interpolation*/) const {
  if (!std::isfinite(position.latitude_deg) || !std::isfinite(position.longitude_deg))
    return {std::numeric_limits<double>::quiet_NaN(), 0.0};
  const geo::GeoPoint wrapped{std::clamp(position.latitude_deg, -90.0, 90.0),
                              geo::wrapped_degrees(position.longitude_deg)};
  const double height_m = height_m_(wrapped);
  const std::uint8_t given = material_ ? material_(wrapped) : std::uint8_t{0};
  const std::uint8_t material = given <= kMaxMaterial ? given : std::uint8_t{0};
  return {height_m, height_m == 0.0 ? 1.0 : 0.0, material};
}

inline std::size_t AnalyticTerrain::surfaces(const PositionRun& positions, Interpolation interpolation,
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

// Terrain store with one view for all regions.
class FixedTerrainStore final : public TerrainStore {
 public:
  explicit FixedTerrainStore(TerrainViewPointer view) : view_(std::move(view)) {}
  TerrainViewPointer prepare(const TerrainRegion& /*region*/) override { return view_; }

 private:
  TerrainViewPointer view_;
};

// Built-in terrain: 400 m plus three patterns of sine waves over the whole earth, 0 to 1170 m MSL.
// Wavelengths at the equator are about 9, 28 and 120 km. Heights below 0 m become 0 m, which is sea.
// One evaluation takes 8 sines and no geodesic.
inline AnalyticTerrain::Height built_in_hills() {
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
