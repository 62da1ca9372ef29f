// Terrain view that is smooth between posts, for patch maps with finer pixels than the posts.
// Method: nodes divide each interval of posts in a box. A limited cubic (Hermite) along rows, then along columns,
//   gives the heights of the nodes. Between nodes the ground is bilinear.
// Slope at a post: mean of the two adjacent differences, at most three times the smaller, 0 if their signs differ.
// Heights therefore stay between those of the four posts around. Level water stays level; posts keep their heights.
// Voids: next to a void the known post counts, as in bilinear interpolation.
// Source: Fritsch and Carlson 1980; docs/decisions/0021-smooth-ground-and-every-post-in-patch-maps.md.
#pragma once

#include <vector>

#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain {

// Parameters of a smooth view.
struct SmoothParameters {
  GeoBox box;                   // area of the map
  double spacing_m = 0.0;       // [m] requested spacing of nodes
  double posts_m = 0.0;         // [m] cells with posts this close, or closer, stay bilinear
  int min_parts = 6;            // minimum parts of an interval, 1 to 64; fewer flatten its crests
  std::vector<GeoBox> plain{};  // boxes in which the ground stays bilinear, because objects stand on it
};

// A view of the same ground with nodes in the box. Returns `view` itself if the posts are close enough, the ground has
// no posts, or the box is near a pole. Only bilinear sampling uses the nodes.
TerrainViewPointer smooth_between_posts(const TerrainViewPointer& view, const SmoothParameters& order);

}  // namespace yars::model::terrain
