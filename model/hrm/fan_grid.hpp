// The grid on which a patch is computed: columns are lines of sight, even in the tangent of their bearing against the
// centre's; rows are even in distance over ground. Shadow and layover run along columns alone. Kept in strips of
// sixteen columns, row by row: a row of a strip is a cache line of floats, and a vector.
#pragma once

#include <cmath>
#include <cstddef>

#include "model/hrm/patch_geometry.hpp"

namespace yars::model::hrm {

inline constexpr int kStripColumns = 16;

struct FanGrid {
  int columns = 0;  // a multiple of kStripColumns
  int rows = 0;
  double first_tangent = 0.0;  // of column 0
  double tangent_step = 0.0;
  double first_distance_m = 0.0;  // of row 0, over ground
  double spacing_m = 0.0;         // between rows
  double centre_distance_m = 0.0;

  int strips() const { return columns / kStripColumns; }
  // An odd number of cache lines: a row across many strips does not meet itself in the cache.
  std::size_t strip_size() const { return static_cast<std::size_t>(rows | 1) * kStripColumns; }
  std::size_t size() const { return strip_size() * static_cast<std::size_t>(strips()); }
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(column / kStripColumns) * strip_size() +
           static_cast<std::size_t>(row) * kStripColumns + static_cast<std::size_t>(column % kStripColumns);
  }
  double tangent(double column) const { return first_tangent + column * tangent_step; }
  double distance_m(double row) const { return first_distance_m + row * spacing_m; }
  // Width [m] of a column at a distance: what a step of the tangent is worth as an arc.
  double width_m(double column, double distance) const {
    const double t = tangent(column);
    return distance * tangent_step / (1.0 + t * t);
  }
};

// How far beyond the window's edges something may lie that returns or shades within it [m].
struct FanMargins {
  double near_m = 0.0;
  double far_m = 0.0;
};

// `cells` a pixel, along and across. Holds the window and the margins, as far as they lie ahead of the aircraft.
FanGrid make_fan_grid(const PatchGeometry& geometry, int pixels, int cells, const FanMargins& margins);

}  // namespace yars::model::hrm
