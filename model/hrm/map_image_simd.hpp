// Loops of the picture: rows drawn from the polar grid, impulse response, speckle.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "model/hrm/patch_geometry.hpp"
#include "model/physics/clutter.hpp"

namespace yars::model::hrm::simd {

// The fan drawn onto the rows of the map, by vectors (Highway, chosen at run time; equal bits on every target).
struct MapRow {
  int columns = 0;             // pixels
  float first_right_m = 0.0F;  // of the first pixel
  float pixel_m = 0.0F;
  float ahead_m = 0.0F;  // of the row: from the aircraft, along the line of sight
  float scale = 1.0F;    // on what is found, besides 1 / (width of a column * spacing)
};

// pixel[i] = fan per square metre at the pixel, bilinear, times the scale. Pixels lie within the grid.
void draw_row(const PolarGrid& grid, const float* fan, const MapRow& row, float* pixel);

// Sums over neighbours, by vectors (Highway, chosen at run time; equal bits on every target).
inline constexpr std::size_t kBlock = 16;

// to[i] = weights[0] * from[i] + sum over k > 0 of weights[k] * (from[i - k * stride] + from[i + k * stride]); `count`
// is a multiple of a block.
void smooth(std::size_t count, const float* from, std::ptrdiff_t stride, std::span<const float> weights, float* to);

// to[i] = from[i] where it is greater than the limit, else 0, for a block. True if any is.
bool keep_above(const float* from, float limit, float* to);

// to[i + k * stride] += weights[k] * from[i], for a block.
void spread(const float* from, std::ptrdiff_t stride, std::span<const float> weights, float* to);

// to[i + k] += kernel[middle + k] * from[i], for a block and every k that is less than `reach` blocks away or as far;
// the kernel is so long, and a block more on either side.
void spread_along(const float* from, std::size_t reach, const float* middle, float* to);

// The loops of speckle, by vectors (Highway, chosen at run time; equal bits on every target). Counts are multiples of
// sixteen.

// Real and imaginary parts of variance 1/2 each: mean square 1. One draw of 32 bits a cell, after Box and Muller.
void draw_gaussian(std::size_t count, physics::NoiseState state, float* real, float* imaginary);

// Two neighbours of a row, and their weights.
struct Neighbours {
  const std::int32_t* cell;  // the first
  const float* first;
  const float* second;
};
void interpolate(std::size_t count, const Neighbours& where, const float* cells, float* field);

// A row of the field, by look, real and imaginary, each `count` long; and what it weighs.
struct WeightedField {
  const float* numbers;
  float weight;
};
// Mean over the looks of the squares of the weighted sum.
void intensity(std::size_t count, int looks, WeightedField near, WeightedField far, float* mean);

}  // namespace yars::model::hrm::simd
