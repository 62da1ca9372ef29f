// Terrain view that is smooth between posts, for patch maps with pixels smaller than the spacing of posts.
// Method: nodes divide each interval between posts in a box. A cubic Hermite interpolation with limited slopes, along
//   rows, then along columns, gives the heights of the nodes. Between nodes the ground is bilinear.
// Slope at a post: mean height difference over the two adjacent intervals (of a row or column), at most three times the
// smaller, 0 if their signs differ.
// Heights therefore stay between those of the four surrounding posts. Level water stays level; heights of posts do not
// change. A void post is left out, as in bilinear interpolation. Source: Fritsch and Carlson 1980;
// docs/decisions/0021-smooth-ground-and-every-post-in-patch-maps.md.
#pragma once

#include <vector>

#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain {

// Parameters of a smooth view.
struct SmoothParameters {
  GeoBox box;              // area of the map
  double spacing_m = 0.0;  // [m] requested spacing of nodes
  double posts_m = 0.0;    // [m] cells with rows or columns at most this far apart stay bilinear
  // Minimum number of parts of a post interval, 1 to 64; fewer parts flatten crests. A cell that would get over 2^23
  // nodes has fewer parts.
  int min_parts = 6;
  std::vector<GeoBox> bilinear_boxes{};  // boxes in which the ground stays bilinear, because objects stand on it
};

// Returns a view of the same ground with nodes in the box. Only bilinear sampling uses the nodes. Returns `view` itself
// if no cell in the box needs nodes: each has rows or columns at most posts_m apart. Also returns `view` itself if
// spacing_m is not positive, or if the box extends beyond 88 degrees of latitude.
TerrainViewPointer smooth_between_posts(const TerrainViewPointer& view, const SmoothParameters& parameters);

}  // namespace yars::model::terrain
