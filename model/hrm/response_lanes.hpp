// Sums over neighbours, by vectors (Highway, chosen at run time; equal bits on every target).
#pragma once

#include <cstddef>
#include <span>

namespace yars::model::hrm::lanes {

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

}  // namespace yars::model::hrm::lanes
