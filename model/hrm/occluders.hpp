// Ray casting for shadows: triangles that can hide a point from the radar. Used by reference.hpp.
// Frame: origin at the radar; x to the right of the line of sight to the map, y ahead, z up [m]. Rays are straight.
// Accuracy: double precision. A triangle less than 2 cm in front of a point does not hide the point.
// Acceleration: a grid over x/y and z/y lists the triangles that may cover each direction.
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

  bool hide(Point3 point) const;

 private:
  // One axis of the grid: a range of x/y or of z/y, divided into cells of equal size.
  struct Span {
    double low = 0.0, scale = 0.0;  // minimum of x/y or z/y; cells per unit
    int cells = 1;
    int cell(double value) const;
  };
  void measure();  // sets the extent and the resolution of the grid
  // Calls visit(cell) for the cells within the triangle's bounding box.
  template <class Visit>
  void visit_cells(const Corners& corners, const Visit& visit) const;

  std::vector<Corners> triangles_;
  Span across_, upward_;
  std::vector<std::uint32_t> begin_;    // by cell: first index in entries_; one more element marks the end
  std::vector<std::uint32_t> entries_;  // indices into triangles_
};

}  // namespace yars::model::hrm
