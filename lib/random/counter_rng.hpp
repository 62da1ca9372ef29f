// Counter-based random numbers: pure functions of a seed, a count and a draw, without state.
// Inputs: three integers of 64 bits.
// Outputs: the same number on every run, for any order of calls and any number of threads.
// Source: SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators"); Box and Muller 1958.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace yars::random {

// A number of the normal distribution with mean 0 and variance 1. `draw` distinguishes the numbers of one count.
inline double standard_normal(std::uint64_t seed, std::uint64_t count, std::uint64_t draw) {
  // The finalizer of SplitMix64. Other constants change every number.
  const auto mixed = [](std::uint64_t bits) {
    bits += 0x9e3779b97f4a7c15U;
    bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9U;
    bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebU;
    return bits ^ (bits >> 31U);
  };
  // Uniform in (0, 1). 0 is excluded because the logarithm is taken.
  const auto uniform = [](std::uint64_t bits) { return (static_cast<double>(bits >> 12U) + 0.5) * 0x1.0p-52; };
  const std::uint64_t first = mixed(mixed(mixed(seed) ^ count) ^ draw);
  // Box and Muller; the second number of the pair is not used.
  return std::sqrt(-2.0 * std::log(uniform(first))) * std::cos(2.0 * std::numbers::pi * uniform(mixed(first)));
}

}  // namespace yars::random
