// Gradient noise in three dimensions: pure functions of a point and a seed, without tables or state.
// Inputs: a point in units of one lattice cell, and a seed. The magnitude of each coordinate, doubled for each octave
// after the first, must be below 2^31.
// Outputs: noise values, with equal bits on every run.
// Source: Perlin 2002, "Improving noise", with a different hash (the finalizer of SplitMix64).
#pragma once

#include <cstdint>

#include "lib/geo/frames.hpp"

namespace yars::random {

// 32-bit hash of lattice coordinates and a seed.
std::uint32_t lattice_hash(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed);

// Gradient noise at a point, about [-1, 1]. The mean is 0, and the value at lattice points is 0.
double gradient_noise(geo::Vector3 point, std::uint32_t seed);

// Sum of at least one octave of gradient noise, divided by the sum of their amplitudes; about [-1, 1]. Each octave has
// half the wavelength and `persistence` times the amplitude of the previous octave.
double fractal_noise(geo::Vector3 point, std::uint32_t seed, int octaves, double persistence);

// Ridged sum of at least one octave, [0, 1], for mountain ridges. An octave is highest where its gradient noise is 0,
// and weak where the previous octave is low.
double ridged_noise(geo::Vector3 point, std::uint32_t seed, int octaves);

// 0 below `low`, 1 above `high`, and 3 t^2 - 2 t^3 between `low` and `high`, with t = (value - low) / (high - low).
double smooth_step(double low, double high, double value);

// The hash as a fraction in [0, 1).
constexpr double unit_fraction(std::uint32_t hash) {
  return static_cast<double>(hash) / 4294967296.0;
}

}  // namespace yars::random
