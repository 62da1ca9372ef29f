// Statistics of clutter, the return of ground and sea: speckle and thermal noise of a sweep; texture that is fixed to
// the ground. Speckle: random fluctuation of a cell's power, because the returns of its many scatterers interfere.
// Inputs: noise key and index of a resolution cell; number of looks; geodetic position for texture.
// Outputs: 32 random bits; levels of speckle and texture, of mean 1.
// Accuracy: variance of texture within 1 % of 1/shape for shapes >= 1.
// Threads: pure functions. Equal inputs give equal bits on every machine and in every order.
// Source: docs/spec/physics.md#speckle.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "lib/geo/geodesy.hpp"
#include "lib/random/counter_rng.hpp"
#include "model/physics/sweep_geometry.hpp"

namespace yars::model::physics {

// State of the counter-based noise of one sweep. A number depends on seed, scan, sweep, cell and draw alone.
// The generator uses only integers, so every algorithm, vector width and build draws equal bits.
// The generator is not cryptographic: three multiplications with xor-shifts between them.
// Source: constants by C. Wellons, "hash prospector", lowbias32.
struct NoiseState {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
};

// Prime near 2^32 / golden ratio. Its first thousands of multiples differ in their upper bits.
inline constexpr std::uint32_t kGoldenSection = 0x9e3779b1U;

NoiseState make_noise_state(const NoiseKey& key);

// Speckle of L looks: the mean of L exponential variates, which is a gamma variate of mean 1 and variance 1/L.
// The upper bits of noise_bits() select one of the levels, which are equally probable. Each is the mean of its
// interval.
inline constexpr unsigned kSpeckleBits = 12;
inline constexpr std::size_t kSpeckleLevels = 1U << kSpeckleBits;
using SpeckleLevels = std::array<float, kSpeckleLevels>;

// Variance is within 0.1 % of 1/looks. `looks` is in [1, kMaxLooks] (receiver.hpp). The levels stay for the life of the
// process.
const SpeckleLevels& speckle_levels(int looks);

// Distance between the numbers of two resolution cells. The noise of every picture depends on it.
inline constexpr std::uint32_t kCellStride = 8;

// 32 random bits of a resolution cell.
inline std::uint32_t noise_bits(NoiseState state, std::uint32_t cell) {
  const std::uint32_t bits = random::lowbias32((cell * kCellStride) ^ state.first) ^ state.second;
  const std::uint32_t keyed = bits * kGoldenSection;
  return keyed ^ (keyed >> 15U);
}

// Speckle of a cell where a share of the mean power is steady. Its difference from 1 is smaller, so that the variance /
// mean^2 is (1 - share^2) / looks, as of a constant signal in Gaussian noise (Rice).
inline float with_steady(float speckle, double share) {
  const double held = std::clamp(share, 0.0, 1.0);
  return static_cast<float>(1.0 + (static_cast<double>(speckle) - 1.0) * std::sqrt(1.0 - held * held));
}

// Cells of speckle along a sweep. Samples of one cell fluctuate together. Two rulers of the pulse length L, with random
// places in each sweep, cut the sweep into cells. Samples at the distance D share one with the probability (1 - D/L)^2:
// the correlation of the power of a rectangular pulse in a matched receiver.
struct SpeckleCells {
  // Marks of a ruler per sample, and where the two rulers begin. The default gives each sample its own cell.
  float per_sample = 0.5F, first = 0.0F, second = 0.5F;
};
SpeckleCells speckle_cells(double spacing_m, double pulse_length_m, NoiseState state);

inline std::uint32_t cell_of(std::uint32_t sample, SpeckleCells cells) {
  const float along = (static_cast<float>(static_cast<std::int32_t>(sample)) + 0.5F) * cells.per_sample;
  return static_cast<std::uint32_t>(along + cells.first) + static_cast<std::uint32_t>(along + cells.second);
}

// Cells of about equal size on the earth. Each cell has its own random bits, which do not change between scans. A cell
// has no straight edges, so that a picture shows no lattice: the grid has kPartsPerCell parts along an edge of a cell,
// and each part belongs, by chance, to the cell around it or to the next one.
// Rows have equal height in latitude. The number of columns follows the cosine of each degree's middle latitude, and of
// each row's beyond kPolar_deg.
struct GroundGrid {
  double rows_per_degree = 0.0;       // of parts
  std::array<double, 180> columns{};  // parts round the earth, for each degree of latitude from the south pole
};
inline constexpr std::uint32_t kPartsPerCell = 4;
// Beyond this latitude the cosine changes by more than a tenth in half a degree.
inline constexpr double kPolar_deg = 84.0;
// Separates the bits that choose a part's cell from those of the cell.
inline constexpr std::uint32_t kPartKey = 0x5bd1e995U;

// [m] length of one degree of latitude on the grid: 60 NM, within 0.6 % of the ellipsoid's. The texture of every
// picture depends on this value.
inline constexpr double kGridMetresPerDegree = 60.0 * geo::kMetresPerNauticalMile;

// Grid of cells with the edge `edge_m` > 0. Edges are within 2 % of `edge_m` below 60 degrees of latitude, and within
// 10 % up to the last kilometres before a pole.
GroundGrid make_ground_grid(double edge_m);

// Texture that moves over the ground and changes: that of the sea, whose cells move with the waves. Each cell gets
// other bits once a life, and each at a time of its own, so that the sea's statistics are the same at all times.
struct TextureDrift {
  std::int32_t row = 0, column = 0;            // whole parts of the grid, in [0, kPeriod), that the texture has moved
  double row_part = 0.0, column_part = 0.0;    // the rest, in [0, 1)
  std::uint32_t age = 0;                       // sim time in 256ths of a life
  bool moves = false;                          // false: as the ground
  static constexpr double kPeriod = 16777216;  // [parts] at most 2^24 parts of 1/4 m are 4,000 km
};
// `north_m` and `east_m`: way of the texture; the position has the cell that was there before.
TextureDrift make_texture_drift(const GroundGrid& grid, double north_m, double east_m, double lives);
// Bits of the cell that is at a position after a drift.
std::uint32_t drifted_bits(const GroundGrid& grid, geo::GeoPoint position, const TextureDrift& drift);
// Factor of the number of a cell's life on the number that is hashed, and key of the time at which it begins. Any odd
// number serves.
inline constexpr std::uint32_t kLifeSection = 0x85ebca6bU;

// 32 random bits of the cell at a position. The longitude is any finite number; the latitude is within +-90 degrees.
std::uint32_t ground_bits(const GroundGrid& grid, geo::GeoPoint position);

// Texture of K-distributed clutter: a gamma variate of mean 1 and variance 1/shape, fixed to the ground.
// With speckle of L looks, the power has variance / mean^2 = (1 + 1/shape)(1 + 1/L) - 1.
// Eight random bits of a cell select one of 256 levels of equal probability. Each level is the mean of its interval.
// Source: Ward, Tough, Watts, "Sea Clutter", 2nd ed., 4.2 (compound K); Abramowitz and Stegun 6.5 (incomplete gamma).
inline constexpr std::size_t kTextureLevels = 256;
using TextureLevels = std::array<float, kTextureLevels>;

// All levels are 1 for a shape of 0 (no texture). Variance is within 1 % of 1/shape for shapes >= 1, 3 % for >= 0.3.
TextureLevels make_texture_levels(double shape);

// Regularized lower incomplete gamma function P(shape, x), shape > 0, x >= 0. Error about 1e-12.
double incomplete_gamma(double shape, double x);

// Edge of the texture cells [m]: the smallest power of two >= pulse length, sample spacing and 1 m.
double texture_cell_m(double pulse_length_m, double spacing_m);

}  // namespace yars::model::physics
