// Coarser grids of a cell, co-sited with it: every factor-th post of a dimension, so that both edges stay.
// means: box mean over half the new spacing to either side (a post exactly there counts half), voids left out. Posts
//   of an edge take only posts of that edge and a corner only itself: neighbours with equal edges stay equal. Sea
//   (0 m) stays where more than half is sea; any other mean is at least one unit away from 0, with its sign.
// peaks: the highest post less than one new spacing away in each dimension: bilinear interpolation between peaks is
//   never below the original surface. They see their own cell alone: neighbours' peaks may differ along the edge.
// A post is void only where all posts that it takes are.
#pragma once

#include "model/terrain/cell.hpp"

namespace yars::model::terrain {

struct ReducedCell {
  Cell means;
  Cell peaks;
};

// Every 2^reduction-th post; a dimension whose intervals do not divide so often is reduced as far as they do.
// Requires reduction >= 0.
ReducedCell reduce(const Cell& cell, int reduction);

// Requires factors >= 1 that divide the intervals of their dimension.
ReducedCell reduce_by(const Cell& cell, int row_factor, int column_factor);

// How often the intervals between so many posts (>= 2) can be halved.
int halvings(int posts);

// `posts` along a dimension after that many halvings, as far as they go.
int reduced_posts(int posts, int reduction);

}  // namespace yars::model::terrain
