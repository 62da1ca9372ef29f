// The look-up between the nodes of smooth ground, and how they are made of posts, by vectors (Highway, chosen at run
// time); every width gives the same bits.
#pragma once

#include <cstddef>

#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain::smooth {

// Nodes [m] row by row from the south-west, NaN = void; kRunSlack entries more behind the last.
struct Nodes {
  const float* height_m = nullptr;
  int rows = 0, columns = 0;                     // at least 2
  float rows_a_degree = 0.0F, first_row = 0.0F;  // row = degrees north of the cell's corner * rows_a_degree - first_row
  float columns_a_degree = 0.0F, first_column = 0.0F;
};

// Bilinear between nodes; a void is left out and the other weights are scaled. What lies beyond the nodes keeps what
// elevation_m has. Places [deg] from the cell's corner. True if none does.
bool heights(const Nodes& nodes, const float* north_deg, const float* east_deg, std::size_t count, float* elevation_m);

// Three posts in a row, by column; `before` or `after` may be NaN.
struct Neighbours {
  const float *before, *here, *after;
};
// slope[i] = height a post, limited. Arrays have kRunSlack entries more than `count`.
void limited_slopes(std::size_t count, const Neighbours& posts, float* slope);

// The two ends of an interval and their slopes, by column.
struct Interval {
  const float *near, *far, *near_slope, *far_slope;
};
// height[i] = the cubic at a share [0, 1) of the way from near to far; beside a void the known end.
void between(std::size_t count, const Interval& ends, float share, float* height);

}  // namespace yars::model::terrain::smooth
