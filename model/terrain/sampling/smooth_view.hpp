// Terrain view that is smooth between posts, for patch maps whose pixels are finer than the posts.
// Method: nodes divide each interval between posts in a box. A cubic Hermite interpolation with limited slopes, along
//   rows, then along columns, gives the heights of the nodes. Between nodes the ground is bilinear.
// Slope at a post: mean of the two adjacent differences, at most three times the smaller, 0 if their signs differ.
// Heights therefore stay between the heights of the four surrounding posts. Level water stays level, and the heights of
// posts do not change. A void post is left out, as in bilinear interpolation. Source: Fritsch and Carlson 1980;
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
  int min_parts = 6;       // minimum number of parts of a post interval, 1 to 64; fewer parts flatten crests
  std::vector<GeoBox> bilinear_boxes{};  // boxes in which the ground stays bilinear, because objects stand on it
};

// Returns a view of the same ground with nodes in the box. Only bilinear sampling uses the nodes. Returns `view` itself
// if no cell in the box needs nodes: each has rows or columns at most posts_m apart. Also returns `view` itself if
// spacing_m is not positive, or if the box extends beyond 88 degrees of latitude.
TerrainViewPointer smooth_between_posts(const TerrainViewPointer& view, const SmoothParameters& parameters);

}  // namespace yars::model::terrain
