// The loops of speckle, by vectors (Highway, chosen at run time; equal bits on every target). Counts are multiples of
// sixteen.
#pragma once

#include <cstddef>
#include <cstdint>

#include "model/rbm/noise.hpp"

namespace yars::model::hrm::lanes {

// Real and imaginary parts of variance 1/2 each: mean square 1. One draw of 32 bits a cell, after Box and Muller.
void draw_gaussian(std::size_t count, rbm::NoiseState state, float* real, float* imaginary);

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

}  // namespace yars::model::hrm::lanes
