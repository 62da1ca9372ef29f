// A convex polygon seen from above, cut by lines along the axes (Sutherland and Hodgman 1974).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "lib/geo/vector.hpp"

namespace yars::model::scene {

class PlanPolygon {
 public:
  using Axis = double geo::Vector3::*;

  PlanPolygon() = default;
  explicit PlanPolygon(const std::array<geo::Vector3, 3>& corners) : corners_(3) {
    std::copy(corners.begin(), corners.end(), at_.begin());
  }

  // Least and most along an axis; of nothing: zero.
  std::pair<double, double> bounds(Axis axis) const {
    if (corners_ == 0) return {0.0, 0.0};
    const auto less = [axis](const geo::Vector3& a, const geo::Vector3& b) { return a.*axis < b.*axis; };
    const auto [least, most] = std::minmax_element(at_.begin(), at_.begin() + corners_, less);
    return {(*least).*axis, (*most).*axis};
  }
  PlanPolygon between(Axis axis, double least, double most) const {
    return beyond(axis, least, 1.0).beyond(axis, most, -1.0);
  }
  // Positive where corners turn counter-clockwise.
  double area() const {
    double twice = 0.0;
    for (std::ptrdiff_t i = 1; i + 1 < corners_; ++i)
      twice += cross(corner(i) - corner(0), corner(i + 1) - corner(0)).z;
    return 0.5 * twice;
  }

 private:
  const geo::Vector3& corner(std::ptrdiff_t i) const { return at_[static_cast<std::size_t>(i)]; }
  // What is on the side of the line to which `sign` points.
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

  std::array<geo::Vector3, 16> at_{};  // a triangle cut by four lines has seven corners, and rounding adds few
  std::ptrdiff_t corners_ = 0;
};

}  // namespace yars::model::scene
