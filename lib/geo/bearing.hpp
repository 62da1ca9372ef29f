// A direction over ground: a point on the circle, clockwise from true north. Bearings are not added to each
// other; their difference is an Angle wrapped to [-180, 180) degrees.
#pragma once

#include "lib/geo/quantity.hpp"

namespace yars::geo {

class Bearing {
 public:
  constexpr Bearing() = default;
  static Bearing degrees(double value);
  static Bearing radians(double value);
  double degrees() const { return degrees_; }  // [deg] [0, 360)
  double radians() const { return degrees_ * kRadiansPerDegree; }

  friend Bearing operator+(Bearing bearing, Angle turn) { return degrees(bearing.degrees_ + turn.degrees()); }
  friend Bearing operator-(Bearing bearing, Angle turn) { return degrees(bearing.degrees_ - turn.degrees()); }
  friend Angle operator-(Bearing to, Bearing from);
  friend bool operator==(Bearing a, Bearing b) { return a.degrees_ == b.degrees_; }

 private:
  constexpr explicit Bearing(double degrees) : degrees_(degrees) {}
  double degrees_ = 0.0;
};

// Wraps to [-180, 180) degrees; accurate for any finite input.
double wrapped_degrees(double degrees);

}  // namespace yars::geo
