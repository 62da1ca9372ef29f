#include "lib/random/counter_rng.hpp"

#include <algorithm>
#include <cmath>

#include "lib/geo/frames.hpp"

namespace yars::random {

namespace {

// Weight of the upper corner at the fraction t of a lattice cell (Perlin 2002).
double fade(double t) {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}
double mix(double a, double b, double t) {
  return a + t * (b - a);
}
// Floor by conversion to an integer. On targets without SSE 4.1, std::floor is a slower library call. |value| must be
// below 2^31.
std::int32_t floor_of(double value) {
  const auto whole = static_cast<std::int32_t>(value);
  return whole - static_cast<std::int32_t>(value < static_cast<double>(whole));
}

// Dot product of the gradient of a lattice corner with the offset from the corner. Each component of the gradient is in
// [-1, 1] and uses ten bits of the hash.
double corner_value(std::uint32_t hash, double x, double y, double z) {
  constexpr double kStep = 2.0 / 1023.0;
  return (static_cast<double>(hash & 1023U) * kStep - 1.0) * x +
         (static_cast<double>((hash >> 10U) & 1023U) * kStep - 1.0) * y +
         (static_cast<double>((hash >> 20U) & 1023U) * kStep - 1.0) * z;
}

}  // namespace

std::uint32_t lattice_hash(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) {
  const std::uint64_t plane =
      static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32U | static_cast<std::uint32_t>(y);
  const std::uint64_t layer = static_cast<std::uint64_t>(seed) << 32U | static_cast<std::uint32_t>(z);
  return static_cast<std::uint32_t>(splitmix64_rounds(plane + kGoldenGamma * layer) >> 32U);
}

double gradient_noise(geo::Vector3 point, std::uint32_t seed) {
  const std::int32_t x = floor_of(point.x);
  const std::int32_t y = floor_of(point.y);
  const std::int32_t z = floor_of(point.z);
  const geo::Vector3 in{point.x - x, point.y - y, point.z - z};
  const double weight_x = fade(in.x);
  const auto edge = [&](int up_y, int up_z) {
    return mix(corner_value(lattice_hash(x, y + up_y, z + up_z, seed), in.x, in.y - up_y, in.z - up_z),
               corner_value(lattice_hash(x + 1, y + up_y, z + up_z, seed), in.x - 1, in.y - up_y, in.z - up_z),
               weight_x);
  };
  const double weight_y = fade(in.y);
  constexpr double kGain = 1.6;  // scales usual extremes to about 1; another value changes all made-up landscapes
  return kGain * mix(mix(edge(0, 0), edge(1, 0), weight_y), mix(edge(0, 1), edge(1, 1), weight_y), fade(in.z));
}

double smooth_step(double low, double high, double value) {
  const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double fractal_noise(geo::Vector3 point, std::uint32_t seed, int octaves, double persistence) {
  double sum = 0.0;
  double amplitude = 1.0;
  double total = 0.0;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += amplitude * gradient_noise(point, seed + static_cast<std::uint32_t>(octave));
    total += amplitude;
    amplitude *= persistence;
    point *= 2.0;
  }
  return sum / total;
}

double ridged_noise(geo::Vector3 point, std::uint32_t seed, int octaves) {
  double sum = 0.0;
  double total = 0.0;
  double amplitude = 1.0;
  double octave_weight = 1.0;
  for (int octave = 0; octave < octaves; ++octave) {
    // 1 where the noise is 0; 0 where its magnitude exceeds 1 / 1.6.
    double crest =
        std::max(0.0, 1.0 - 1.6 * std::abs(gradient_noise(point, seed + static_cast<std::uint32_t>(octave))));
    crest *= crest;
    sum += amplitude * octave_weight * crest;
    total += amplitude;
    octave_weight = std::min(1.0, 1.5 * crest);
    amplitude *= 0.5;
    point *= 2.0;
  }
  return sum / total;
}

}  // namespace yars::random
