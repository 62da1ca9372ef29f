#include "databuffer/flight/leg.hpp"

#include <cmath>

namespace yars::databuffer::flight {

namespace {

constexpr int kMostApproximations = 8;
constexpr double kFootTolerance = 1e-3;  // [m]

}  // namespace

Leg::Leg(geo::GeoPoint from, geo::GeoPoint to) : Leg(from, geo::geodesic_inverse(from, to)) {}

Leg::Leg(geo::GeoPoint from, const geo::GeodesicInverse& inverse)
    : ray_(from, inverse.azimuth_at_start),
      length_(inverse.distance),
      course_at_start_(inverse.azimuth_at_start),
      course_at_end_(inverse.azimuth_at_end) {}

Leg::Fix Leg::fix(geo::GeoPoint place, geo::Length near) const {
  Fix fix{near, {}, {}};
  for (int approximation = 0; approximation < kMostApproximations; ++approximation) {
    // Seen from the foot, the place must lie square to the leg: what lies along it moves the foot.
    const auto foot = ray_.place(fix.along);
    const auto seen = geo::geodesic_inverse(foot.point, place);
    const geo::Angle angle = seen.azimuth_at_start - foot.azimuth;
    const geo::Length missing = seen.distance * std::cos(angle.radians());
    fix.across = seen.distance * std::sin(angle.radians());
    fix.course = seen.azimuth_at_end - angle;
    fix.along = fix.along + missing;
    if (std::abs(missing.metres()) < kFootTolerance) break;
  }
  return fix;
}

}  // namespace yars::databuffer::flight
