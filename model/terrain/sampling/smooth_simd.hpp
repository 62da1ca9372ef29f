// SIMD kernels of smooth ground (smooth_view.hpp): monotone cubic Hermite interpolation from posts to nodes (a finer
// grid), and bilinear interpolation between nodes.
// Units: heights [m MSL], NaN = void; offsets north and east of the cell's south-west corner [deg].
// Arrays: each has kRunSlack spare elements after the last.
// Accuracy: results are bitwise equal for all vector widths (Highway, target chosen at run time).
// Source: Fritsch and Carlson 1980.
#pragma once

#include <cstddef>

#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain::smooth {

// Grid of nodes, row by row from the south-west node.
struct Nodes {
  const float* height_m = nullptr;
  int rows = 0, columns = 0;  // at least 2
  // row = offset north [deg] * rows_per_degree - first_row; likewise for columns.
  float rows_per_degree = 0.0F, first_row = 0.0F;
  float columns_per_degree = 0.0F, first_column = 0.0F;
};

// Bilinear interpolation between the four nodes around each position. Void nodes are left out, and the weights of the
// others are scaled to a sum of 1. If the others have no weight, the result is NaN. A position outside the grid leaves
// its element of `elevation_m` unchanged. Returns true if all positions are inside the grid.
bool heights(const Nodes& nodes, const float* north_deg, const float* east_deg, std::size_t count, float* elevation_m);

// Heights of three successive posts, as arrays. Element i of each belongs to the same triple. NaN: void.
struct Neighbours {
  const float *before, *here, *after;
};
// slope[i] = slope at `here` [m per post interval]: the mean of the differences here - before and after - here. Its
// absolute value is at most 3 times the smaller difference. It is 0 if the signs of the differences differ. Next to a
// void, the known difference replaces the unknown one. The slope is 0 if `here` or both neighbours are void.
void limited_slopes(std::size_t count, const Neighbours& posts, float* slope);

// Heights [m MSL] and slopes [m per interval] at the two ends of an interval between posts, as arrays. near: the
// western or southern end; far: the eastern or northern end.
struct Interval {
  const float *near, *far, *near_slope, *far_slope;
};
// height[i] = cubic Hermite interpolant at `fraction`, in [0, 1), of the interval from near to far. If one end is
// void, height[i] is the height of the other end. If both are void, it is NaN.
void between(std::size_t count, const Interval& ends, float fraction, float* height);

}  // namespace yars::model::terrain::smooth
