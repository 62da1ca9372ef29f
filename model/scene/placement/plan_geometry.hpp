// Plane geometry of a scene seen from above: projection planes, polygon clipping, triangle subdivision, bounding
// rectangles.
// Units: metres; x east, y north unless stated.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "lib/geo/frames.hpp"
#include "lib/geo/geodesy.hpp"

namespace yars::model::scene {

// Linear approximation of the transform between two azimuthal equidistant planes. The origin of the second plane is the
// point `middle` of the first plane, within 20 km of the first plane's origin.
// Accuracy: to_local() within 1 mm up to 300 m from `middle`; position_of() within 10 mm in a square of 128 m about
// `middle`, below 80 degrees of latitude. Both functions take a point of the first plane.
class LocalMap {
 public:
  LocalMap(const geo::AzimuthalEquidistant& from, geo::PlanePoint middle);

  const geo::AzimuthalEquidistant& plane() const { return to_; }  // the plane about `middle`
  geo::PlanePoint to_local(geo::PlanePoint point) const {
    const double e = point.x_m - middle_.x_m, n = point.y_m - middle_.y_m;
    return {e * east_.x_m + n * north_.x_m, e * east_.y_m + n * north_.y_m};
  }
  geo::GeoPoint position_of(geo::PlanePoint point) const {
    const double e = point.x_m - middle_.x_m, n = point.y_m - middle_.y_m;
    const geo::GeoPoint o = to_.origin();
    return {o.latitude_deg + e * latitude_.x_m + n * latitude_.y_m,
            o.longitude_deg + e * longitude_.x_m + n * longitude_.y_m};
  }

 private:
  geo::PlanePoint middle_;
  geo::AzimuthalEquidistant to_;
  geo::PlanePoint east_, north_;          // one metre east, one metre north of the first plane, in the second plane
  geo::PlanePoint latitude_, longitude_;  // [deg/m] change per metre east (x) and north (y) of the first plane
};

// Convex polygon seen from above, clipped by lines along the axes (Sutherland and Hodgman 1974).
class PlanPolygon {
 public:
  using Axis = double geo::Vector3::*;

  PlanPolygon() = default;
  explicit PlanPolygon(const std::array<geo::Vector3, 3>& corners) : corners_(3) {
    std::copy(corners.begin(), corners.end(), at_.begin());
  }

  // Minimum and maximum along an axis; zeros for an empty polygon.
  std::pair<double, double> bounds(Axis axis) const {
    if (corners_ == 0) return {0.0, 0.0};
    const auto less = [axis](const geo::Vector3& a, const geo::Vector3& b) { return a.*axis < b.*axis; };
    const auto [min, max] = std::minmax_element(at_.begin(), at_.begin() + corners_, less);
    return {(*min).*axis, (*max).*axis};
  }
  // Part of the polygon with coordinates in [min, max] along an axis.
  PlanPolygon between(Axis axis, double min, double max) const {
    return beyond(axis, min, 1.0).beyond(axis, max, -1.0);
  }
  // Area seen from above [m^2]; positive for counter-clockwise corners.
  double area() const {
    double twice = 0.0;
    for (std::ptrdiff_t i = 1; i + 1 < corners_; ++i)
      twice += cross(corner(i) - corner(0), corner(i + 1) - corner(0)).z;
    return 0.5 * twice;
  }

 private:
  const geo::Vector3& corner(std::ptrdiff_t i) const { return at_[static_cast<std::size_t>(i)]; }
  // Part of the polygon with sign * (coordinate - line) >= 0. `sign` is 1 or -1.
  PlanPolygon beyond(Axis axis, double line, double sign) const {
    PlanPolygon cut;
    const auto put = [&cut](const geo::Vector3& at) { cut.at_[static_cast<std::size_t>(cut.corners_++)] = at; };
    for (std::ptrdiff_t i = 0; i < corners_; ++i) {
      const geo::Vector3 from = corner(i), to = corner(i + 1 < corners_ ? i + 1 : 0);
      const double from_m = sign * (from.*axis - line), to_m = sign * (to.*axis - line);
      if (from_m >= 0.0) put(from);
      if ((from_m >= 0.0) != (to_m >= 0.0)) put(from + (from_m / (from_m - to_m)) * (to - from));
    }
    return cut;
  }

  std::array<geo::Vector3, 16> at_{};  // four cuts of a triangle give at most seven corners; rounding adds few
  std::ptrdiff_t corners_ = 0;
};

using Corners3 = std::array<geo::Vector3, 3>;

// Edge of a triangle, with its length seen from above.
struct PlanEdge {
  std::size_t from = 0;  // number of the edge's first corner
  double length_m = 0.0;
};

// Longest edge of a triangle seen from above.
inline PlanEdge longest_plan_edge(const Corners3& corners) {
  PlanEdge longest;
  for (std::size_t i = 0; i < 3; ++i) {
    const geo::Vector3 edge = corners[(i + 1) % 3] - corners[i];
    const double length_m = std::hypot(edge.x, edge.y);
    if (length_m > longest.length_m) longest = {i, length_m};
  }
  return longest;
}

// True if surely no edge of a triangle, seen from above, is longer than `max_m`. False if one is, or may be by
// rounding. Cheaper than longest_plan_edge(), and true for most triangles of a scene.
inline bool has_no_longer_edge(const Corners3& corners, double max_m) {
  constexpr double kRounding = 1e-12;  // above that of the squares and of longest_plan_edge()
  const double max_m2 = max_m * max_m * (1.0 - kRounding);
  for (std::size_t i = 0; i < 3; ++i) {
    const geo::Vector3 edge = corners[(i + 1) % 3] - corners[i];
    if (!(edge.x * edge.x + edge.y * edge.y <= max_m2)) return false;
  }
  return true;
}

// Bisects triangles at their longest edge, seen from above, until no edge is too long. Neighbours bisect a shared edge
// at the same point, so there are no cracks.
class TriangleCutter {
 public:
  // Calls visit(piece) for each piece. No edge of a piece is longer than `max_edge_m`.
  template <class Visit>
  void cut(const Corners3& corners, double max_edge_m, const Visit& visit) {
    pieces_.assign(1, corners);
    while (!pieces_.empty()) {
      const Corners3 piece = pieces_.back();
      pieces_.pop_back();
      if (has_no_longer_edge(piece, max_edge_m)) {
        visit(piece);
        continue;
      }
      const PlanEdge edge = longest_plan_edge(piece);
      if (edge.length_m <= max_edge_m) {
        visit(piece);
        continue;
      }
      const geo::Vector3 &a = piece[edge.from], &b = piece[(edge.from + 1) % 3], &c = piece[(edge.from + 2) % 3];
      const geo::Vector3 middle = 0.5 * (a + b);
      pieces_.push_back({a, middle, c});
      pieces_.push_back({middle, b, c});
    }
  }

 private:
  std::vector<Corners3> pieces_;
};

// Rectangle of minimum area around a set of points. One of its sides lies on an edge of the points' convex hull. The
// search therefore tries every edge of the hull (Freeman and Shapira, CACM 18, 1975).
struct Footprint {
  geo::PlanePoint middle;
  double length_m = 0.0;  // longer side
  double width_m = 0.0;
  double direction_rad = 0.0;  // direction of the longer side, counter-clockwise from x, [0, pi)
};

// Returns the footprint of `points`, all zeros if there are none. Sorts `points` and removes duplicates.
Footprint footprint_of(std::vector<geo::PlanePoint>& points);

}  // namespace yars::model::scene
