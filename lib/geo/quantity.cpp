#include "lib/geo/quantity.hpp"

#include <cmath>

namespace yars::geo {

double wrapped_degrees(double degrees) {
  const double turned = std::remainder(degrees, 360.0);
  return turned >= 180.0 ? turned - 360.0 : turned;
}

Bearing Bearing::degrees(double value) {
  double turned = std::fmod(value, 360.0);
  if (turned < 0.0) turned += 360.0;
  // For a tiny negative input the sum above rounds to 360 degrees, which is north.
  return Bearing(turned >= 360.0 ? 0.0 : turned);
}

Bearing Bearing::radians(double value) {
  return degrees(value / kRadiansPerDegree);
}

Angle operator-(Bearing to, Bearing from) {
  return Angle::degrees(wrapped_degrees(to.degrees_ - from.degrees_));
}

}  // namespace yars::geo
