// Vector loops of the map image: sampling of the polar grid, impulse response, speckle.
// Determinism: all targets (instruction sets) of the library Highway give equal bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "model/hrm/patch_geometry.hpp"
#include "model/physics/clutter.hpp"

namespace yars::model::hrm::simd {

// One row of the map and its position relative to the aircraft.
struct MapRow {
  int begin = 0, end = 0;      // pixels [begin, end) of the row are drawn; `begin` is a multiple of 16
  float first_right_m = 0.0F;  // centre of pixel 0, to the right of the line of sight to the map's centre
  float pixel_m = 0.0F;
  float ahead_m = 0.0F;  // from the aircraft to the row, along that line of sight
  float scale = 1.0F;    // factor on the cross section per square metre
};

// pixel[i] = `scale` times the cross section per m^2 at the pixel, interpolated bilinearly on the polar grid.
// Pixels [begin, end) whose left column the sector does not draw keep their values.
// Precondition: pixels lie within the grid. `cross_section_m2` has one strip more, which may be read.
void draw_row(const PolarGrid& grid, const float* cross_section_m2, const MapRow& row, float* pixel);

// Pixels of a block: adjacent pixels of a row that the impulse response computes together.
inline constexpr std::size_t kBlock = 16;

// to[i] = weights[0] * from[i] + sum over k > 0 of weights[k] * (from[i - k * stride] + from[i + k * stride]).
// `weights` is one half of a symmetric convolution kernel, from its centre outwards. `count` is a multiple of kBlock.
void smooth(std::size_t count, const float* from, std::ptrdiff_t stride, std::span<const float> weights, float* to);

// For one block: to[i] = from[i] if from[i] exceeds `limit`, else 0. Returns true if any entry exceeds `limit`.
bool keep_above(const float* from, float limit, float* to);

// For one block: to[i + k * stride] += weights[k] * from[i].
void spread(const float* from, std::ptrdiff_t stride, std::span<const float> weights, float* to);

// For one block: to[i + k] += middle[k] * from[i] for |k| <= radius * kBlock. `middle` points to the centre of the
// convolution kernel, which has a block of zeros beyond each end.
void spread_along(const float* from, std::size_t radius, const float* middle, float* to);

// Speckle loops follow. Each `count` is a multiple of 16.

// Draws complex Gaussian numbers of mean square 1: real and imaginary parts have variance 1/2 each. Method: Box-Muller
// transform of one 32-bit draw per cell.
void draw_gaussian(std::size_t count, physics::NoiseState state, float* real, float* imaginary);

// Interpolation between two neighbouring cells of a row:
// field[i] = first[i] * cells[cell[i]] + second[i] * cells[cell[i] + 1].
// Requirement: `cell` rises by 0 or 1 from entry to entry. 17 entries of `cells` from each cell[i] on may be read.
struct Neighbours {
  const std::int32_t* cell;
  const float* first;
  const float* second;
};
void interpolate(std::size_t count, const Neighbours& where, const float* cells, float* field);

// One row of cells, interpolated along the row to pixels, and its weight. Each look has `count` real parts, then
// `count` imaginary parts.
struct WeightedField {
  const float* numbers;
  float weight;
};
// mean[i] = mean over the looks of |near.weight * near.numbers[i] + far.weight * far.numbers[i]|^2, complex numbers.
// `near` and `far`: the rows of cells before and after the row of pixels, in order of row number.
void intensity(std::size_t count, int looks, WeightedField near, WeightedField far, float* mean);

}  // namespace yars::model::hrm::simd
