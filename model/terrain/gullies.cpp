#include "model/terrain/gullies.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/geo/quantity.hpp"
#include "model/terrain/noise.hpp"

namespace yars::model::terrain {

namespace {

constexpr double kMetresPerDegree = 111195.0;  // [m] of a sphere of 6371 km: shape only, no navigation

constexpr double kLevel = 1e-3;   // [m/m] flatter ground has no downhill to speak of: no gullies
constexpr double kGentle = 0.02;  // [m/m] slopes below hardly gather water: plains stay plain
constexpr double kRock = 0.45;    // [m/m] slopes beyond cut little deeper

struct Wave {
  double cosine = 0.0;  // +1 on a spur, -1 in a gully
  double sine = 0.0;
};

// cos and sin of 2 pi t for |t| <= 1, to 3e-5, without the maths library: equal bits everywhere.
Wave wave_of(double turns) {
  const double half = std::numbers::pi * (turns - std::floor(turns + 0.5));  // [-pi/2, pi/2]
  const double square = half * half;
  const double sine = half * (1 - square / 6 * (1 - square / 20 * (1 - square / 42 * (1 - square / 72))));
  const double cosine = 1 - square / 2 * (1 - square / 12 * (1 - square / 30 * (1 - square / 56 * (1 - square / 90))));
  return {cosine * cosine - sine * sine, 2 * sine * cosine};
}

// Scattered points lie one to a square, in rows along parallels; a row has as many squares as fit round it, so
// that they are evenly spaced at every latitude.
struct Row {
  double north;       // of the place, from the row's south edge, in rows
  double column_deg;  // width of a square
  std::int32_t index;
};

Row row_at(double row_position, std::int32_t index, double row_deg) {
  const double middle_deg = std::clamp((index + 0.5) * row_deg - 90.0, -90.0, 90.0);
  const double columns = std::max(1.0, std::floor(360.0 * std::cos(middle_deg * geo::kRadiansPerDegree) / row_deg));
  return {row_position - index, 360.0 / columns, index};
}

// Adds the packet of one square: `column_position` is the place in squares from the antimeridian.
struct Sum {
  Wave wave;
  double weight = 0.0;
};
void add_packet(const Row& row, double column, double column_position, double east_per_column, Slope across,
                std::uint32_t seed, Sum& sum) {
  const double columns = 360.0 / row.column_deg;
  const double wrapped = column < 0 ? column + columns : (column >= columns - 0.5 ? column - columns : column);
  const std::uint32_t hash = lattice_hash(static_cast<std::int32_t>(std::floor(wrapped + 0.5)), row.index, 0, seed);
  const double east = (column_position - column - static_cast<double>(hash & 0xFFFFU) / 65536.0) * east_per_column;
  const double north = row.north - static_cast<double>(hash >> 16U) / 65536.0;
  const double reach = 1.0 - (east * east + north * north);
  if (reach <= 0.0) return;
  const double weight = reach * reach;
  const Wave wave = wave_of(east * across.east + north * across.north);
  sum.wave.cosine += weight * wave.cosine;
  sum.wave.sine += weight * wave.sine;
  sum.weight += weight;
}

// The packets around a place, for stripes across the unit vector `across`.
Wave packets(double latitude_deg, double longitude_deg, double wavelength_m, Slope across, std::uint32_t seed) {
  const double row_deg = wavelength_m / kMetresPerDegree;
  const double parallel = std::cos(latitude_deg * geo::kRadiansPerDegree);
  const double row_position = (latitude_deg + 90.0) / row_deg;
  const auto middle_row = static_cast<std::int32_t>(std::floor(row_position));
  Sum sum;
  for (std::int32_t index = middle_row - 1; index <= middle_row + 1; ++index) {
    const Row row = row_at(row_position, index, row_deg);
    const double column_position = (longitude_deg + 180.0) / row.column_deg;
    const double middle_column = std::floor(column_position);
    for (const double step : {-1.0, 0.0, 1.0})
      add_packet(row, middle_column + step, column_position, row.column_deg / row_deg * parallel, across, seed, sum);
  }
  const double strength = std::sqrt(sum.wave.cosine * sum.wave.cosine + sum.wave.sine * sum.wave.sine);
  // Where packets cancel, the pattern fades instead of jumping.
  const double scale = 1.0 / std::max(strength, 0.3 * sum.weight + 1e-9);
  return {sum.wave.cosine * scale, sum.wave.sine * scale};
}

}  // namespace

double Gullies::relief_m(double latitude_deg, double longitude_deg, Slope base) const {
  double relief = 0.0;
  Slope slope = base;
  std::uint32_t seed = seed_;
  for (const GullyOctave& octave : octaves_) {
    ++seed;
    const double steepness = std::sqrt(slope.east * slope.east + slope.north * slope.north);
    if (steepness < kLevel) break;
    const Slope across{-slope.north / steepness, slope.east / steepness};
    const Wave wave = packets(latitude_deg, longitude_deg, octave.wavelength_m, across, seed);
    const double cut = steepness * steepness / (steepness + kGentle) / (1.0 + steepness / kRock);
    const double depth_m = octave.depth * octave.wavelength_m * cut;
    // Gullies cut deeper than spurs rise.
    relief += depth_m * (wave.cosine - 0.25);
    const double side = -depth_m * wave.sine * 2.0 * std::numbers::pi / octave.wavelength_m;
    slope.east += side * across.east;
    slope.north += side * across.north;
  }
  return relief;
}

}  // namespace yars::model::terrain
