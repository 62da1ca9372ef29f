// Sums over neighbours, by vectors (Highway, chosen at run time; equal bits on every target).
#pragma once

#include <cstddef>
#include <span>

namespace yars::model::hrm::lanes {

// to[i] += sum over k of weights[k] * (from[i - (first + k) * stride] + from[i + (first + k) * stride]); `count` is a
// multiple of sixteen.
void add_neighbours(std::size_t count, const float* from, std::ptrdiff_t stride, std::ptrdiff_t first,
                    std::span<const float> weights, float* to);

// to[i] = weight * from[i].
void scale(std::size_t count, const float* from, float weight, float* to);

// to[i] = from[i] where it is greater than the limit, else 0. True if any is.
bool keep_above(std::size_t count, const float* from, float limit, float* to);

}  // namespace yars::model::hrm::lanes
