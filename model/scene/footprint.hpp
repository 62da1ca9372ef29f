// What a thing covers seen from above: the rectangle of least area around its corners. The hull's edges are tried in
// turn (the least rectangle has a side on one of them: Freeman and Shapira, CACM 18, 1975).
#pragma once

#include <span>
#include <vector>

namespace yars::model::scene {

struct PlanPoint {
  double x_m = 0.0, y_m = 0.0;
};

struct Footprint {
  PlanPoint middle;
  double length_m = 0.0;  // the longer side
  double width_m = 0.0;
  double direction_rad = 0.0;  // of the longer side, counter-clockwise from x, [0, pi)
};

// `points` is reordered; of no points all is zero.
Footprint footprint_of(std::vector<PlanPoint>& points);

}  // namespace yars::model::scene
