// Deterministic noise from an integer hash: no tables, no state, equal bits on every run. Space is continuous;
// one lattice cell is 1 unit wide. Gradient noise after Perlin (2002, "Improving noise"), with its own hash.
#pragma once

#include <cstdint>

#include "lib/geo/frames.hpp"

namespace yars::random {

// 32 well mixed bits from lattice coordinates and a seed.
std::uint32_t lattice_hash(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed);

// Smooth noise, about [-1, 1], mean 0, zero at lattice points.
double gradient_noise(geo::Vector3 point, std::uint32_t seed);

// Sum of octaves, each half the wavelength and `persistence` times the amplitude of the one before; about [-1, 1].
double fractal_noise(geo::Vector3 point, std::uint32_t seed, int octaves, double persistence);

// Ridged sum: crests where the noise passes zero; octaves are rough on crests and calm in valleys. [0, 1].
double ridged_noise(geo::Vector3 point, std::uint32_t seed, int octaves);

// 0 below `low`, 1 above `high`, smooth between.
double smooth_step(double low, double high, double value);

// A number in [0, 1) from a hash.
constexpr double share_of(std::uint32_t hash) {
  return static_cast<double>(hash) / 4294967296.0;
}

}  // namespace yars::random
