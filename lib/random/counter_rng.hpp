// Counter-based random numbers, pure functions of a count (the value of a counter), or of a seed and a count; and
// gradient noise in three dimensions, pure functions of a point and a seed. Neither has tables or shared state.
// Inputs of the noise: a point in units of one lattice cell. The magnitude of each coordinate, doubled for each octave
// after the first, must be below 2^31.
// Any thread may draw any number in any order. Every build draws the same bits, except for standard_normal(), which
// uses log and cos of the C library. Noise has equal bits on every run. Use: pictures and noise, not cryptography.
// Source: Perlin 2002, "Improving noise", with a different hash (the finalizer of SplitMix64).
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "lib/geo/frames.hpp"

namespace yars::random {

// 2^64 / golden ratio, rounded to an odd number. Its multiples modulo 2^64 are spread evenly.
inline constexpr std::uint64_t kGoldenGamma = 0x9e3779b97f4a7c15U;

// Finalizer of SplitMix64 without the last shift. A finalizer is the function that mixes the bits of a count. The upper
// 32 bits of the result are well mixed.
// Source: Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators", function mix64variant13.
constexpr std::uint64_t splitmix64_rounds(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9U;
  return (bits ^ (bits >> 27U)) * 0x94d049bb133111ebU;
}

// SplitMix64: 64 random bits for a count.
constexpr std::uint64_t splitmix64(std::uint64_t count) {
  const std::uint64_t bits = splitmix64_rounds(count + kGoldenGamma);
  return bits ^ (bits >> 31U);
}

// Multipliers of the 32-bit finalizer "lowbias32". Source: C. Wellons, "hash prospector".
inline constexpr std::uint32_t kLowbias32First = 0x7feb352dU;
inline constexpr std::uint32_t kLowbias32Second = 0x846ca68bU;

// lowbias32 without the last shift. The upper 16 bits of the result are well mixed.
constexpr std::uint32_t lowbias32_rounds(std::uint32_t bits) {
  bits = (bits ^ (bits >> 16U)) * kLowbias32First;
  return (bits ^ (bits >> 15U)) * kLowbias32Second;
}

// lowbias32: 32 random bits for a count.
constexpr std::uint32_t lowbias32(std::uint32_t count) {
  const std::uint32_t bits = lowbias32_rounds(count);
  return bits ^ (bits >> 16U);
}

// Sequence of random numbers of one seed: SplitMix64 of seed + n * kGoldenGamma for n = 0, 1, 2, ...
class CounterRng {
 public:
  explicit CounterRng(std::uint64_t seed) : count_(seed) {}

  // 64 random bits.
  std::uint64_t word() {
    const std::uint64_t bits = splitmix64(count_);
    count_ += kGoldenGamma;
    return bits;
  }
  // Uniform in [0, 1).
  double uniform() { return static_cast<double>(word() >> 11U) * 0x1.0p-53; }
  // Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  // Uniform whole number in [0, count).
  int below(int count) { return static_cast<int>(uniform() * count); }

 private:
  std::uint64_t count_;
};

// Number from the normal distribution (mean 0, variance 1) for a combination of seed, count and draw. Method: Box and
// Muller.
inline double standard_normal(std::uint64_t seed, std::uint64_t count, std::uint64_t draw) {
  // Uniform in (0, 1). Zero is excluded, because its logarithm is infinite.
  const auto open_uniform = [](std::uint64_t bits) { return (static_cast<double>(bits >> 12U) + 0.5) * 0x1.0p-52; };
  const std::uint64_t first = splitmix64(splitmix64(splitmix64(seed) ^ count) ^ draw);
  return std::sqrt(-2.0 * std::log(open_uniform(first))) *
         std::cos(2.0 * std::numbers::pi * open_uniform(splitmix64(first)));
}

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
