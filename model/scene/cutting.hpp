// Triangles cut in two across their longest edge, seen from above, until none is too long. Both triangles of an edge
// cut it in the middle, so that there are no cracks.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "lib/geo/vector.hpp"

namespace yars::model::scene {

using Corners3 = std::array<geo::Vector3, 3>;

struct PlanEdge {
  std::size_t from = 0;  // corner, to the next one
  double length_m = 0.0;
};

inline PlanEdge longest_plan_edge(const Corners3& corners) {
  PlanEdge longest;
  for (std::size_t i = 0; i < 3; ++i) {
    const geo::Vector3 edge = corners[(i + 1) % 3] - corners[i];
    const double length_m = std::hypot(edge.x, edge.y);
    if (length_m > longest.length_m) longest = {i, length_m};
  }
  return longest;
}

class Cutter {
 public:
  // Calls visit(piece) for pieces no edge of which is longer.
  template <class Visit>
  void cut(const Corners3& corners, double most_m, const Visit& visit) {
    pieces_.assign(1, corners);
    while (!pieces_.empty()) {
      const Corners3 piece = pieces_.back();
      pieces_.pop_back();
      const PlanEdge edge = longest_plan_edge(piece);
      if (edge.length_m <= most_m) {
        visit(piece);
        continue;
      }
      const geo::Vector3 a = piece[edge.from], b = piece[(edge.from + 1) % 3], c = piece[(edge.from + 2) % 3];
      const geo::Vector3 middle = 0.5 * (a + b);
      pieces_.push_back({a, middle, c});
      pieces_.push_back({middle, b, c});
    }
  }

 private:
  std::vector<Corners3> pieces_;
};

}  // namespace yars::model::scene
