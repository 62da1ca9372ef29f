#include "model/terrain/gullies.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/geo/quantity.hpp"
#include "model/terrain/noise.hpp"

namespace yars::model::terrain {

namespace {

constexpr double kMetresPerDegree = 111195.0;  // [m] of a sphere of 6371 km: shape only, no navigation

struct Octave {
  double wavelength_m;  // from gully to gully
  double depth;         // [m] of relief to either side, per metre of wavelength and unit of slope
};
constexpr Octave kOctaves[] = {{9000, 0.27}, {4300, 0.21}, {2000, 0.16}, {980, 0.12}, {500, 0.08}};

constexpr double kGentle = 0.02;  // [m/m] slopes below hardly gather water: plains stay plain
constexpr double kRock = 0.45;    // [m/m] slopes beyond cut little deeper

struct Wave {
  double cosine = 0.0;  // +1 on a spur, -1 in a gully
  double sine = 0.0;
};

// The packets around a place for stripes across unit vector (east, north).
Wave packets(double latitude_deg, double longitude_deg, double wavelength_m, Slope across, std::uint32_t seed) {
  const double row_deg = wavelength_m / kMetresPerDegree;
  const double east_m_per_deg = kMetresPerDegree * std::cos(latitude_deg * geo::kRadiansPerDegree);
  const double row_position = (latitude_deg + 90.0) / row_deg;
  const auto middle_row = static_cast<std::int32_t>(std::floor(row_position));
  const double turns_per_metre = 1.0 / wavelength_m;
  Wave sum;
  double total = 0.0;
  for (std::int32_t row = middle_row - 1; row <= middle_row + 1; ++row) {
    // Each row of points has as many columns as fit round its parallel: even spacing at every latitude.
    const double row_latitude_deg = std::clamp((row + 0.5) * row_deg - 90.0, -90.0, 90.0);
    const double columns =
        std::max(1.0, std::floor(360.0 * std::cos(row_latitude_deg * geo::kRadiansPerDegree) / row_deg));
    const double column_deg = 360.0 / columns;
    const double column_position = (longitude_deg + 180.0) / column_deg;
    const double middle_column = std::floor(column_position);
    for (int step = -1; step <= 1; ++step) {
      const double column = middle_column + step;
      const double round_trip = column < 0 ? column + columns : (column >= columns ? column - columns : column);
      const std::uint32_t hash = lattice_hash(static_cast<std::int32_t>(round_trip), row, 0, seed);
      const double jitter_east = static_cast<double>(hash & 0xFFFFU) / 65536.0;
      const double jitter_north = static_cast<double>(hash >> 16U) / 65536.0;
      const double east_m = (column_position - column - jitter_east) * column_deg * east_m_per_deg;
      const double north_m = (row_position - row - jitter_north) * wavelength_m;
      const double reach = 1.0 - (east_m * east_m + north_m * north_m) * turns_per_metre * turns_per_metre;
      if (reach <= 0.0) continue;
      const double weight = reach * reach;
      const double phase = 2.0 * std::numbers::pi * turns_per_metre * (east_m * across.east + north_m * across.north);
      sum.cosine += weight * std::cos(phase);
      sum.sine += weight * std::sin(phase);
      total += weight;
    }
  }
  const double strength = std::sqrt(sum.cosine * sum.cosine + sum.sine * sum.sine);
  const double scale = 1.0 / std::max(strength, 0.3 * total + 1e-9);
  return {sum.cosine * scale, sum.sine * scale};
}

}  // namespace

double Gullies::relief_m(double latitude_deg, double longitude_deg, Slope base) const {
  double relief = 0.0;
  Slope slope = base;
  std::uint32_t seed = seed_;
  for (const Octave& octave : kOctaves) {
    ++seed;
    const double steepness = std::sqrt(slope.east * slope.east + slope.north * slope.north);
    if (steepness < 1e-4) break;
    const Slope across{-slope.north / steepness, slope.east / steepness};
    const Wave wave = packets(latitude_deg, longitude_deg, octave.wavelength_m, across, seed);
    // Steeper slopes cut deeper, up to where rock stands by itself.
    const double cut = steepness * steepness / (steepness + kGentle) / (1.0 + steepness / kRock);
    const double depth_m = octave.depth * octave.wavelength_m * cut;
    relief += depth_m * (wave.cosine - 0.25);
    const double side = -depth_m * wave.sine * 2.0 * std::numbers::pi / octave.wavelength_m;
    slope.east += side * across.east;
    slope.north += side * across.north;
  }
  return relief;
}

}  // namespace yars::model::terrain
