// Counter-based noise: the number depends on (seed, scan, sweep, sample) alone, so any thread may compute it in any
// order. Integers only: every algorithm, lane count and build draws the same bits. Quality is that of a picture, not
// of cryptography: two rounds of multiply and xor-shift (constants: C. Wellons, "hash prospector", lowbias32).
#pragma once

#include <cstdint>

#include "model/rbm/look.hpp"

namespace yars::model::rbm {

struct NoiseState {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
};

inline constexpr int kLooksPerGroup = 4;  // two draws of 32 bits give four numbers; one logarithm serves them all
inline constexpr std::uint32_t kDrawsPerCell = 8;

NoiseState make_noise_state(const NoiseKey& key);

// 32 random bits for a resolution cell and one of its draws [0, kDrawsPerCell).
inline std::uint32_t noise_bits(NoiseState state, std::uint32_t cell, std::uint32_t draw) {
  std::uint32_t x = (cell * kDrawsPerCell + draw) ^ state.first;
  x ^= x >> 16U;
  x *= 0x7feb352dU;
  x ^= x >> 15U;
  x *= 0x846ca68bU;
  x ^= (x >> 16U) ^ state.second;
  x *= 0x9e3779b1U;
  x ^= x >> 15U;
  return x;
}

// Returns that one pulse covers fluctuate together: resolution cells [1/sample] and the cell of a sample.
inline float cells_per_sample(double spacing_m, double pulse_length_m) {
  return static_cast<float>(pulse_length_m > spacing_m ? spacing_m / pulse_length_m : 1.0);
}
inline std::uint32_t resolution_cell(std::uint32_t sample, float cells) {
  return static_cast<std::uint32_t>((static_cast<float>(static_cast<std::int32_t>(sample)) + 0.5F) * cells);
}

}  // namespace yars::model::rbm
