// Triangles that stand between the radar and what lies behind them, exact in double: the radar is the origin, rays are
// straight. A grid over the directions holds, cell by cell, every triangle that may cover one of its directions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lib/geo/frames.hpp"

namespace yars::model::hrm {

// Metres from the radar: x to the right of the map's line of sight, y ahead along it, z up.
using Point3 = geo::Vector3;

class Occluders {
 public:
  using Corners = std::array<Point3, 3>;

  // Triangles with a corner that is not ahead of the radar are left out.
  explicit Occluders(std::vector<Corners> triangles = {});

  // True if a triangle lies between the radar and the point, nearer than it by more than 2 cm.
  bool hide(Point3 point) const;

 private:
  struct Span {
    double least = 0.0, scale = 0.0;
    int cells = 1;
    int cell(double value) const;
  };
  void measure();
  // Calls visit(cell) for those that the triangle may cover.
  template <class Visit>
  void visit_cells(const Corners& corners, const Visit& visit) const;

  std::vector<Corners> triangles_;
  Span across_, upward_;
  std::vector<std::uint32_t> begin_;  // of each cell in entries_, and the end
  std::vector<std::uint32_t> entries_;
};

}  // namespace yars::model::hrm
