#include "model/terrain/landscape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "model/terrain/landscape_lattice.hpp"
#include "model/terrain/noise.hpp"

namespace yars::model::terrain {

namespace {

constexpr double kEarthRadiusKm = 6371.0;  // [km] sphere: shape only, no navigation
constexpr double kDeepSeaM = -150.0;       // [m] ground below does not reach the surface by any gully's spur

constexpr GullyOctave kValleys[] = {{9000, 0.27}, {4300, 0.24}};
constexpr GullyOctave kGullies[] = {{2000, 0.17}, {980, 0.12}, {500, 0.08}};

double smooth_step(double low, double high, double value) {
  const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double bell(double offset, double half_width) {
  const double t = offset / half_width;
  return std::exp(-t * t);
}

geo::Vector3 at_wavelength(geo::Vector3 point_km, double wavelength_km) {
  return {point_km.x / wavelength_km, point_km.y / wavelength_km, point_km.z / wavelength_km};
}

// A chain of mountains along a line of equal way inland.
struct Range {
  double axis_km;  // way inland of its middle; negative: at sea, its tops are islands
  double half_width_km;
  double crest_m;
  std::uint32_t layer;  // of the noise
};
constexpr Range kRanges[] = {{20, 12, 1250, 70}, {96, 27, 3000, 90}, {210, 40, 2300, 110}, {-30, 9, 680, 130}};

// Sea is exactly 0 m and land at least 1 m: zero means water to the radar.
std::int16_t post_of(double height_m) {
  return height_m <= 0.0 ? std::int16_t{0} : static_cast<std::int16_t>(std::clamp(std::round(height_m), 1.0, 9000.0));
}

}  // namespace

Landscape::Landscape(std::uint64_t seed)
    : seed_(static_cast<std::uint32_t>(seed ^ (seed >> 32U)) * 4096U),
      valleys_(seed_ + 2048U, kValleys),
      gullies_(seed_ + 3072U, kGullies) {}

double Landscape::broad_height_m(geo::GeoPoint place) const {
  const double latitude = place.latitude_deg * geo::kRadiansPerDegree;
  const double longitude = place.longitude_deg * geo::kRadiansPerDegree;
  const geo::Vector3 at{kEarthRadiusKm * std::cos(latitude) * std::cos(longitude),
                        kEarthRadiusKm * std::cos(latitude) * std::sin(longitude), kEarthRadiusKm * std::sin(latitude)};
  const auto noise = [&](geo::Vector3 point, double wavelength_km, std::uint32_t layer, int octaves = 1) {
    return fractal_noise(at_wavelength(point, wavelength_km), seed_ + layer, octaves, 0.5);
  };
  // Bend space a little: what is straight in noise becomes winding.
  const geo::Vector3 bent{at.x + 9.0 * noise(at, 55, 10, 3), at.y + 9.0 * noise(at, 55, 20, 3),
                          at.z + 9.0 * noise(at, 55, 30, 3)};
  // Way inland from the coast's general line, negative at sea.
  const double inland_km = 260.0 * (noise(bent, 1100, 40) + 0.45 * noise(bent, 430, 41) + 0.16 * noise(bent, 170, 42));
  // The coast itself wanders about that line, here in beaches, there in capes; inlets reach in.
  const double rugged = smooth_step(-0.3, 0.4, noise(at, 130, 43));
  const double inlets = smooth_step(0.42, 0.8, ridged_noise(at_wavelength(bent, 85), seed_ + 44, 3));
  const double coast_km =
      inland_km + (9.0 + 26.0 * rugged) * noise(bent, 62, 50, 6) - 22.0 * inlets * bell(inland_km, 28.0);
  // Shelf, coastal plain and the slow rise behind it.
  double height_m =
      coast_km < 0 ? 14.0 * coast_km : 95.0 * (1.0 - std::exp(-coast_km / 14.0)) + 1.6 * std::min(coast_km, 90.0);
  // Ranges follow the general line at their own distance and with their own gaps.
  const double wander_km = 26.0 * noise(at, 120, 60, 3);
  for (const Range& range : kRanges) {
    const double envelope = bell(inland_km - range.axis_km - wander_km, range.half_width_km);
    if (envelope < 1e-3) continue;
    const double presence = 0.45 + 0.75 * smooth_step(-0.45, 0.35, noise(at, 95, range.layer, 2));
    height_m += range.crest_m * envelope * presence *
                (0.28 + 1.05 * ridged_noise(at_wavelength(bent, 34), seed_ + range.layer + 5, 4));
  }
  // Low hills here and there.
  const double hilly = smooth_step(2.0, 25.0, coast_km) * smooth_step(-0.1, 0.5, noise(at, 60, 160, 2));
  return height_m + 190.0 * hilly * ridged_noise(at_wavelength(bent, 17), seed_ + 150, 4);
}

Cell Landscape::cell(CellPlace place, int rows, int columns) const {
  LandscapeLattice lattice(place, [this](geo::GeoPoint at) { return broad_height_m(at); });
  lattice.cut(valleys_);
  std::vector<std::int16_t> posts;
  posts.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  for (int row = 0; row < rows; ++row) {
    lattice.choose_row(row, rows - 1);
    for (int column = 0; column < columns; ++column) {
      const LandscapeLattice::Ground ground = lattice.at_column(column, columns - 1);
      // Deep under the sea nothing shows: spare the gullies.
      const bool sea = ground.height_m < kDeepSeaM;
      posts.push_back(post_of(
          sea ? 0.0 : ground.height_m + gullies_.relief_m(ground.latitude_deg, ground.longitude_deg, ground.slope)));
    }
  }
  return Cell(place, rows, columns, std::move(posts));
}

}  // namespace yars::model::terrain
