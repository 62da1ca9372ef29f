// Set of triangles that can hide a point from the radar, for the algorithm `reference`.
// Frame: the radar is the origin; x to the right of the map's line of sight, y ahead, z up [m]. Rays are straight.
// Accuracy: double precision; surfaces nearer to the point than 2 cm do not hide it.
// Acceleration: a grid over the directions lists the triangles that may cover each cell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lib/geo/frames.hpp"

namespace yars::model::hrm {

// Vector in the radar's frame [m].
using Point3 = geo::Vector3;

class Occluders {
 public:
  using Corners = std::array<Point3, 3>;

  // Ignores triangles with a corner less than 1 m ahead of the radar.
  explicit Occluders(std::vector<Corners> triangles = {});

  // True if a triangle hides the point, more than 2 cm in front of it.
  bool hide(Point3 point) const;

 private:
  struct Span {
    double low = 0.0, scale = 0.0;
    int cells = 1;
    int cell(double value) const;
  };
  void measure();
  // Calls visit(cell) for the cells within the triangle's bounding box.
  template <class Visit>
  void visit_cells(const Corners& corners, const Visit& visit) const;

  std::vector<Corners> triangles_;
  Span across_, upward_;
  std::vector<std::uint32_t> begin_;  // first index in entries_ of each cell, and the end
  std::vector<std::uint32_t> entries_;
};

}  // namespace yars::model::hrm
