// Helpers of the tests of flight models. expect_consistent() checks that records are valid, and that the velocity is
// the derivative of the position.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "databuffer/messages/validation.hpp"
#include "flightmodel/motion.hpp"
#include "lib/geo/frames.hpp"
#include "lib/geo/geodesy.hpp"

namespace yars::flightmodel {

inline geo::GeoPoint point_of(const databuffer::Ownship& ownship) {
  return {ownship.latitude_deg, ownship.longitude_deg};
}

inline geo::Vector3 ecef_of(const databuffer::Ownship& ownship) {
  return geo::ecef_from_geodetic(point_of(ownship), geo::HeightAboveEllipsoid::metres(ownship.altitude_msl_m));
}

inline double ground_speed_of(const databuffer::Ownship& ownship) {
  return std::hypot(ownship.velocity_north_mps, ownship.velocity_east_mps);
}

inline double distance_m(geo::GeoPoint from, geo::GeoPoint to) {
  return geo::geodesic_inverse(from, to).distance.metres();
}

inline bool same_sample(const FlightSample& a, const FlightSample& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

// Error [m/s] of the velocity of `middle`: its difference from the mean velocity between `before` and `after`, in the
// local tangent frame of `middle`. The three samples are dt_s apart.
inline double velocity_error_mps(const databuffer::Ownship& before, const databuffer::Ownship& middle,
                                 const databuffer::Ownship& after, double dt_s) {
  const geo::LocalTangentFrame frame(point_of(middle), geo::HeightAboveEllipsoid::metres(middle.altitude_msl_m));
  const geo::Vector3 from = frame.enu_from_ecef(ecef_of(before));
  const geo::Vector3 to = frame.enu_from_ecef(ecef_of(after));
  const double east = (to.x - from.x) / (2.0 * dt_s) - middle.velocity_east_mps;
  const double north = (to.y - from.y) / (2.0 * dt_s) - middle.velocity_north_mps;
  const double up = (to.z - from.z) / (2.0 * dt_s) + middle.velocity_down_mps;
  return std::sqrt(east * east + north * north + up * up);
}

// Steps the model by dt_s for duration_s. Expects valid records and velocity errors below tolerance_mps. Returns the
// last sample.
inline FlightSample expect_consistent(FlightModel& model, double duration_s, double dt_s, double tolerance_mps) {
  const auto dt = geo::Duration::seconds(dt_s);
  FlightSample before = model.step({});
  FlightSample middle = model.step(dt);
  double worst_mps = 0.0;
  for (double time_s = 2.0 * dt_s; time_s < duration_s; time_s += dt_s) {
    const FlightSample after = model.step(dt);
    const auto own_fault = databuffer::validate(after.ownship);
    EXPECT_EQ(own_fault, std::nullopt) << *own_fault;
    const auto nav_fault = databuffer::validate(after.nav);
    EXPECT_EQ(nav_fault, std::nullopt) << *nav_fault;
    worst_mps = std::max(worst_mps, velocity_error_mps(before.ownship, middle.ownship, after.ownship, dt_s));
    before = middle;
    middle = after;
  }
  EXPECT_LT(worst_mps, tolerance_mps);
  return middle;
}

}  // namespace yars::flightmodel
