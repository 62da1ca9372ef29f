#include "worldgen/terrain/gullies.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/geo/quantity.hpp"
#include "lib/random/gradient_noise.hpp"

namespace yars::worldgen {

namespace {

constexpr double kMetresPerDegree = 111195.0;  // on a sphere of 6371 km

constexpr double kLevel = 1e-3;   // [m/m] flatter ground has no defined downhill direction, so it has no gullies
constexpr double kGentle = 0.02;  // [m/m] below this slope gullies become shallow, so that plains stay flat
constexpr double kSteep = 0.45;   // [m/m] above this slope the depth of gullies saturates

struct CosineSine {
  double cosine;
  double sine;
};

// cos and sin of an angle in full turns, |turns| <= 1.5; error below 1e-5. The function does not call the maths
// library, so results are equal on all platforms.
CosineSine cosine_sine(double turns) {
  const double half = std::numbers::pi * (turns - static_cast<int>(turns + (turns < 0 ? -0.5 : 0.5)));  // [-pi/2, pi/2]
  const double square = half * half;
  const double sine =
      half *
      (1 - square * (1.0 / 6) * (1 - square * (1.0 / 20) * (1 - square * (1.0 / 42) * (1 - square * (1.0 / 72)))));
  const double cosine =
      1 -
      square * 0.5 *
          (1 - square * (1.0 / 12) * (1 - square * (1.0 / 30) * (1 - square * (1.0 / 56) * (1 - square * (1.0 / 90)))));
  return {cosine * cosine - sine * sine, 2 * sine * cosine};
}

}  // namespace

GullyRow::GullyRow(const Gullies& gullies, double latitude_deg) {
  const double parallel = std::cos(latitude_deg * geo::kRadiansPerDegree);
  octaves_.reserve(gullies.octaves.size());
  for (const GullyOctave& shape : gullies.octaves) {
    Octave octave{shape, gullies.seed + 1 + static_cast<std::uint32_t>(octaves_.size()), {}};
    const double row_deg = shape.wavelength_m / kMetresPerDegree;
    const double position = (latitude_deg + 90.0) / row_deg;
    const auto middle = static_cast<std::int32_t>(std::floor(position));
    for (int step = 0; step < 3; ++step) {
      Band& band = octave.bands[step];
      band.index = middle - 1 + step;
      band.north = position - band.index;
      const double middle_deg = std::clamp((band.index + 0.5) * row_deg - 90.0, -90.0, 90.0);
      band.columns = std::max(1.0, std::floor(360.0 * std::cos(middle_deg * geo::kRadiansPerDegree) / row_deg));
      band.width = 360.0 / band.columns / row_deg * parallel;
    }
    octaves_.push_back(octave);
  }
}

void GullyRow::gather(Band& band, double middle, std::uint32_t seed) {
  band.middle = middle;
  for (int step = 0; step < 3; ++step) {
    const double column = middle - 1.0 + step;
    const double wrapped =
        column < 0 ? column + band.columns : (column >= band.columns ? column - band.columns : column);
    const std::uint32_t hash = random::lattice_hash(static_cast<std::int32_t>(wrapped), band.index, 0, seed);
    band.points[step] = {column + static_cast<double>(hash & 0xFFFFU) / 65536.0,
                         band.north - static_cast<double>(hash >> 16U) / 65536.0};
  }
}

// Sum of the wave packets around a position, with its magnitude normalized to at most 1. The waves advance along the
// unit vector `across`, at right angles to the downhill direction. `turn` [0, 1): longitude of the position from
// the antimeridian, in full turns.
GullyRow::Wave GullyRow::packets(Octave& octave, double turn, Slope across) {
  Wave sum;
  double total = 0.0;
  for (Band& band : octave.bands) {
    const double position = turn * band.columns;
    const double middle = static_cast<std::int32_t>(position);
    if (middle != band.middle) gather(band, middle, octave.seed);
    for (const Band::Point& point : band.points) {
      const double east = (position - point.column) * band.width;
      const double falloff = 1.0 - (east * east + point.north * point.north);
      if (falloff <= 0.0) continue;
      const double weight = falloff * falloff;
      const CosineSine wave = cosine_sine(east * across.east + point.north * across.north);
      sum.cosine += weight * wave.cosine;
      sum.sine += weight * wave.sine;
      total += weight;
    }
  }
  const double strength = std::sqrt(sum.cosine * sum.cosine + sum.sine * sum.sine);
  // Where packets cancel, the pattern fades out continuously.
  const double scale = 1.0 / std::max(strength, 0.3 * total + 1e-9);
  return {sum.cosine * scale, sum.sine * scale};
}

GullyRow::Relief GullyRow::at(double longitude_deg, Slope base) {
  Relief relief{0.0, base};
  Slope& slope = relief.slope;
  const double turn = (longitude_deg + 180.0) / 360.0;
  for (Octave& octave : octaves_) {
    const double steepness = std::sqrt(slope.east * slope.east + slope.north * slope.north);
    if (steepness < kLevel) break;
    const Slope across{-slope.north / steepness, slope.east / steepness};
    const Wave wave = packets(octave, turn, across);
    const double cut = steepness * steepness / (steepness + kGentle) / (1.0 + steepness / kSteep);
    const double depth_m = octave.shape.depth * octave.shape.wavelength_m * cut;
    // The offset makes gullies deeper than spurs are high.
    relief.height_m += depth_m * (wave.cosine - 0.25);
    const double cross_slope = -depth_m * wave.sine * 2.0 * std::numbers::pi / octave.shape.wavelength_m;
    slope.east += cross_slope * across.east;
    slope.north += cross_slope * across.north;
  }
  return relief;
}

}  // namespace yars::worldgen
