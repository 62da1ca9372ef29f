// Clutter statistics: counter-based noise of a sweep, and texture that is fixed to the ground.
#pragma once

#include <array>
#include <cstdint>

#include "lib/geo/geodesy.hpp"
#include "lib/random/counter_rng.hpp"
#include "model/physics/sweep_geometry.hpp"

namespace yars::model::physics {

// Counter-based noise: the number depends on (seed, scan, sweep, sample) alone, so any thread may compute it in any
// order. Integers only: every algorithm, lane count and build draws the same bits. Quality is that of a picture, not
// of cryptography: two rounds of multiply and xor-shift (constants: C. Wellons, "hash prospector", lowbias32).
struct NoiseState {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
};

inline constexpr int kLooksPerGroup = 4;  // two draws of 32 bits give four numbers; one logarithm serves them all
inline constexpr std::uint32_t kDrawsPerCell = 8;

// 2^32 / golden ratio, odd: multiples of it differ in their upper bits for thousands of counts.
inline constexpr std::uint32_t kGoldenSection = 0x9e3779b1U;

NoiseState make_noise_state(const NoiseKey& key);

// 32 random bits for a resolution cell and one of its draws [0, kDrawsPerCell).
inline std::uint32_t noise_bits(NoiseState state, std::uint32_t cell, std::uint32_t draw) {
  const std::uint32_t bits = random::lowbias32((cell * kDrawsPerCell + draw) ^ state.first) ^ state.second;
  const std::uint32_t keyed = bits * kGoldenSection;
  return keyed ^ (keyed >> 15U);
}

// Returns that one pulse covers fluctuate together: resolution cells [1/sample] and the cell of a sample.
inline float cells_per_sample(double spacing_m, double pulse_length_m) {
  return static_cast<float>(pulse_length_m > spacing_m ? spacing_m / pulse_length_m : 1.0);
}
inline std::uint32_t resolution_cell(std::uint32_t sample, float cells) {
  return static_cast<std::uint32_t>((static_cast<float>(static_cast<std::int32_t>(sample)) + 0.5F) * cells);
}

// The earth cut into cells of about one size, each with random bits of its own: what stays on the ground from scan to
// scan is keyed by them. Rows of equal latitude; the columns of a row follow the cosine at the middle of its degree.
struct GroundGrid {
  double rows_per_degree = 0.0;
  std::array<double, 180> columns{};  // cells round the earth, by whole degrees of latitude from the south pole
};

// Length of one degree of latitude on the grid: 60 NM, 0.1 % below the mean. Its value places every cell: a change
// changes the speckle of every picture.
inline constexpr double kGridMetresPerDegree = 60.0 * geo::kMetresPerNauticalMile;

// Cells of this edge [m] (> 0), within 2 % of it below 60 degrees of latitude.
GroundGrid make_ground_grid(double edge_m);

// 32 random bits of the cell that holds a place. Any longitude; latitude within +-90 degrees.
std::uint32_t ground_bits(const GroundGrid& grid, geo::GeoPoint place);

// The slow part of K clutter: a gamma variate of mean 1 and variance 1/shape that stays on the ground. Times speckle of
// L looks the variance over the mean squared is (1 + 1/shape)(1 + 1/L) - 1. Cheap in a loop: eight bits of the ground
// cell pick one of 256 values of equal probability, each the mean of its share, so that the mean is 1 exactly.
// Source: Ward, Tough, Watts, "Sea Clutter", 2nd ed., 4.2 (compound K); Abramowitz and Stegun 6.5 (incomplete gamma).
inline constexpr std::size_t kTextureLevels = 256;
using TextureLevels = std::array<float, kTextureLevels>;

// All 1 for a shape of 0: no texture. Variance within 1 % of 1/shape for shapes of 1 and more, 3 % from 0.3 on.
TextureLevels make_texture_levels(double shape);

// Regularized lower incomplete gamma function P(shape, x), shape > 0, x >= 0; to about 1e-12.
double incomplete_gamma(double shape, double x);

// Edge [m] of the cells in which texture is drawn: the power of two that holds the pulse and the sample, so that a
// place keeps its cell while the samples move over it.
double texture_cell_m(double pulse_length_m, double spacing_m);

}  // namespace yars::model::physics
