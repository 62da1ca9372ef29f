// Shadows of scene triangles by ray casting: a triangle that crosses the ray from the radar to a point hides the point.
// Used by reference.hpp.
// Frame: origin at the radar; y horizontal towards the map's centre, x to the right of y, z up [m]. Rays are straight.
// Accuracy: double precision. A triangle 2 cm or less in front of a point does not hide the point.
// Acceleration: a direction from the radar is a point (x/y, z/y). Each cell of a grid over these points lists the
// triangles that may cover the cell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lib/geo/frames.hpp"

namespace yars::model::hrm {

// Vector in the radar's frame [m].
using Point3 = geo::Vector3;

// Triangles that can hide points from the radar.
class Occluders {
 public:
  using Corners = std::array<Point3, 3>;

  // Ignores triangles with a corner behind the radar or at most 1 m ahead of it.
  explicit Occluders(std::vector<Corners> triangles = {});

  // True if a triangle hides the point. A point behind the radar is not hidden.
  bool hide(Point3 point) const;

 private:
  // One axis of the grid: a range of x/y or of z/y, divided into cells of equal size.
  struct Span {
    double low = 0.0, scale = 0.0;  // minimum of x/y or z/y; cells per unit
    int cells = 1;
    int cell(double value) const;
  };
  void measure();  // sets extent and resolution of the grid from the triangles
  // Calls visit(cell) for the cells within the triangle's bounding box.
  template <class Visit>
  void visit_cells(const Corners& corners, const Visit& visit) const;

  std::vector<Corners> triangles_;
  Span across_, upward_;
  std::vector<std::uint32_t> begin_;    // by cell: first index in entries_; one more element marks the end
  std::vector<std::uint32_t> entries_;  // indices into triangles_
};

}  // namespace yars::model::hrm
