// SIMD parts of smooth ground (smooth_view.hpp): limited cubic from posts to nodes, bilinear sampling between nodes.
// Units: heights [m MSL], NaN = void; offsets from the cell's south-west corner [deg].
// Arrays: kRunSlack spare entries after the last.
// Accuracy: every vector width gives the same bits (Highway, target chosen at run time).
#pragma once

#include <cstddef>

#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain::smooth {

// Grid of nodes, row by row from the south-west.
struct Nodes {
  const float* height_m = nullptr;
  int rows = 0, columns = 0;  // at least 2
  // row = offset north [deg] * rows_per_degree - first_row; likewise for columns.
  float rows_per_degree = 0.0F, first_row = 0.0F;
  float columns_per_degree = 0.0F, first_column = 0.0F;
};

// Bilinear between nodes; a void is left out and the other weights are scaled. Entries of positions outside the grid of
// nodes are not changed. Returns true if there are none such.
bool heights(const Nodes& nodes, const float* north_deg, const float* east_deg, std::size_t count, float* elevation_m);

// Heights of three successive posts, as arrays; those of `before` and `after` may be NaN.
struct Neighbours {
  const float *before, *here, *after;
};
// slope[i] = limited slope at `here`, in metres per interval of posts.
void limited_slopes(std::size_t count, const Neighbours& posts, float* slope);

// Heights and slopes at the two ends of an interval, as arrays.
struct Interval {
  const float *near, *far, *near_slope, *far_slope;
};
// height[i] = the cubic at `share`, in [0, 1), of the interval from near to far. If one end is void: the other end.
void between(std::size_t count, const Interval& ends, float share, float* height);

}  // namespace yars::model::terrain::smooth
