// Numbers by chance that are the same on every run: from a seed and a count, without a state that somebody must keep.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace yars::random {

// Of a normal distribution with mean 0 and variance 1. `draw` tells the numbers of one count apart.
inline double standard_normal(std::uint64_t seed, std::uint64_t count, std::uint64_t draw) {
  // The finalizer of SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators").
  const auto mixed = [](std::uint64_t bits) {
    bits += 0x9e3779b97f4a7c15U;
    bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9U;
    bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebU;
    return bits ^ (bits >> 31U);
  };
  // In (0, 1), never its ends: a logarithm follows.
  const auto share_of = [](std::uint64_t bits) { return (static_cast<double>(bits >> 12U) + 0.5) * 0x1.0p-52; };
  const std::uint64_t first = mixed(mixed(mixed(seed) ^ count) ^ draw);
  // Box and Muller; the second number is thrown away.
  return std::sqrt(-2.0 * std::log(share_of(first))) * std::cos(2.0 * std::numbers::pi * share_of(mixed(first)));
}

}  // namespace yars::random
