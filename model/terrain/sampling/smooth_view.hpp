// Ground that is smooth between posts, for who looks at it more finely than posts lie: every interval of posts in a box
// is divided into parts, whose nodes come once from a limited cubic (Hermite) along the rows and then along the
// columns; between nodes the ground is bilinear. A slope at a post is the mean of the two differences beside it, at
// most three times the smaller one, and none where they differ in sign. So heights stay between those of the four posts
// about a place, and level water stays level (Fritsch and Carlson 1980). Posts keep their heights. A void raises
// nothing: beside it the one post that is known counts, as it does in a bilinear look-up.
#pragma once

#include <vector>

#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain {

struct SmoothOrder {
  GeoBox box;                   // what is looked at
  double spacing_m = 0.0;       // [m] of the nodes, about
  double posts_m = 0.0;         // [m] a cell whose posts are as close as that stays as it is
  int least_parts = 6;          // of an interval: fewer flatten its crests
  std::vector<GeoBox> plain{};  // where the ground stays bilinear: something has been placed on it
};

// The same ground with nodes in the box. The view itself where nothing is to be done: posts are close enough, the
// ground is not made of posts, or the box is near a pole. Other look-ups than bilinear ones go to the view as they are.
TerrainViewPointer smooth_between_posts(const TerrainViewPointer& view, const SmoothOrder& order);

}  // namespace yars::model::terrain
