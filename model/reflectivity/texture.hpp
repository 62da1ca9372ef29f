// The slow part of K clutter: a gamma variate of mean 1 and variance 1/shape that stays on the ground. Times speckle of
// L looks the variance over the mean squared is (1 + 1/shape)(1 + 1/L) - 1. Cheap in a loop: eight bits of the ground
// cell pick one of 256 values of equal probability, each the mean of its share, so that the mean is 1 exactly.
// Source: Ward, Tough, Watts, "Sea Clutter", 2nd ed., 4.2 (compound K); Abramowitz and Stegun 6.5 (incomplete gamma).
#pragma once

#include <array>
#include <cstdint>

namespace yars::model::reflectivity {

inline constexpr std::size_t kTextureLevels = 256;
using TextureLevels = std::array<float, kTextureLevels>;

// All 1 for a shape of 0: no texture. Variance within 1 % of 1/shape for shapes of 1 and more, 3 % from 0.3 on.
TextureLevels make_texture_levels(double shape);

// Regularized lower incomplete gamma function P(shape, x), shape > 0, x >= 0; to about 1e-12.
double incomplete_gamma(double shape, double x);

// Edge [m] of the cells in which texture is drawn: the power of two that holds the pulse and the sample, so that a
// place keeps its cell while the samples move over it.
double texture_cell_m(double pulse_length_m, double spacing_m);

}  // namespace yars::model::reflectivity
