// Vector loops of the map image: sampling of the polar grid, impulse response, speckle.
// Determinism: Highway targets chosen at run time give equal bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "model/hrm/patch_geometry.hpp"
#include "model/physics/clutter.hpp"

namespace yars::model::hrm::simd {

// One row of the map and its position relative to the aircraft.
struct MapRow {
  int columns = 0;             // pixels
  float first_right_m = 0.0F;  // of the first pixel
  float pixel_m = 0.0F;
  float ahead_m = 0.0F;  // aircraft to the row, along the line of sight to the centre
  float scale = 1.0F;    // factor on the value per square metre
};

// pixel[i] = cross section per m^2 of the polar grid at the pixel, bilinear, times `scale`. Precondition: pixels lie
// within the grid.
void draw_row(const PolarGrid& grid, const float* cross_section_m2, const MapRow& row, float* pixel);

// Entries of a block. The impulse response works on blocks of this size.
inline constexpr std::size_t kBlock = 16;

// to[i] = weights[0] * from[i] + sum over k > 0 of weights[k] * (from[i - k * stride] + from[i + k * stride]). `count`
// is a multiple of kBlock.
void smooth(std::size_t count, const float* from, std::ptrdiff_t stride, std::span<const float> weights, float* to);

// For one block: to[i] = from[i] if it exceeds `limit`, else 0. Returns true if any does.
bool keep_above(const float* from, float limit, float* to);

// For one block: to[i + k * stride] += weights[k] * from[i].
void spread(const float* from, std::ptrdiff_t stride, std::span<const float> weights, float* to);

// For one block: to[i + k] += middle[k] * from[i] for |k| <= reach * kBlock. `middle` is the centre of the kernel,
// which has one further block on either side.
void spread_along(const float* from, std::size_t reach, const float* middle, float* to);

// Speckle loops. Counts are multiples of 16.

// Complex Gaussian numbers of mean square 1: real and imaginary parts have variance 1/2 each. Box-Muller on one 32-bit
// draw a cell.
void draw_gaussian(std::size_t count, physics::NoiseState state, float* real, float* imaginary);

// Interpolation between two neighbouring cells of a row.
struct Neighbours {
  const std::int32_t* cell;  // index of the first cell
  const float* first;
  const float* second;
};
void interpolate(std::size_t count, const Neighbours& where, const float* cells, float* field);

// A row of the field: by look, real and imaginary parts, each `count` long; and its weight.
struct WeightedField {
  const float* numbers;
  float weight;
};
// mean[i] = mean over the looks of the squared magnitude of the weighted sum of both rows.
void intensity(std::size_t count, int looks, WeightedField near, WeightedField far, float* mean);

}  // namespace yars::model::hrm::simd
