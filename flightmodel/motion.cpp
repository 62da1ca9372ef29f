#include "flightmodel/motion.hpp"

#include <cmath>
#include <limits>

namespace yars::flightmodel {

geo::Duration forward_step(geo::Duration dt) {
  return std::isfinite(dt.seconds()) && dt.seconds() > 0.0 ? dt : geo::Duration();
}

bool FlightModel::resume(const databuffer::Ownship& last, geo::Duration) {
  return reposition({{last.latitude_deg, last.longitude_deg},
                     geo::AltitudeMsl::metres(last.altitude_msl_m),
                     geo::Bearing::degrees(last.heading_deg)});
}

namespace {

constexpr int kMaxIterations = 8;
constexpr double kAlongTolerance_m = 1e-3;  // [m] the iteration ends when its correction is smaller

}  // namespace

Leg::Leg(geo::GeoPoint from, geo::GeoPoint to) : Leg(from, geo::geodesic_inverse(from, to)) {}

Leg::Leg(geo::GeoPoint from, const geo::GeodesicInverse& inverse)
    : ray_(from, inverse.azimuth_at_start),
      length_(inverse.distance),
      course_at_start_(inverse.azimuth_at_start),
      course_at_end_(inverse.azimuth_at_end) {}

// Fixed-point iteration for the foot of the perpendicular from the aircraft to the leg.
Leg::Fix Leg::fix(geo::GeoPoint position, geo::Length near) const {
  Fix fix{near, {}, {}};
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    // At the foot, the line to the aircraft is perpendicular to the leg. From any other point, the component of this
    // line along the leg is the next correction.
    const auto foot = ray_.position_and_azimuth(fix.along);
    const auto to_aircraft = geo::geodesic_inverse(foot.point, position);
    const geo::Angle angle = to_aircraft.azimuth_at_start - foot.azimuth;
    const geo::Length correction = to_aircraft.distance * std::cos(angle.radians());
    fix.across = to_aircraft.distance * std::sin(angle.radians());
    fix.course = to_aircraft.azimuth_at_end - angle;
    fix.along = fix.along + correction;
    if (std::abs(correction.metres()) < kAlongTolerance_m) break;
  }
  return fix;
}

namespace {

// Ratio R / (R + h) of distance on the ellipsoid to distance flown at altitude h. R: radius of curvature of the
// ellipsoid in the direction of the track.
double surface_scale(const Motion& motion) {
  const double radius_m = geo::radius_of_curvature(motion.point.latitude_deg, motion.track).metres();
  return radius_m / (radius_m + motion.altitude.metres());
}

}  // namespace

geo::Length surface_distance(const Motion& motion, geo::Length flown) {
  return flown * surface_scale(motion);
}

geo::Speed speed_at_altitude(const Motion& motion, geo::Speed surface) {
  return surface / surface_scale(motion);
}

Attitude coordinated_attitude(const Motion& motion, geo::Angle roll) {
  const double climb_mps = motion.climb.metres_per_second();
  const double along_mps = motion.ground_speed.metres_per_second();
  return {motion.track, geo::Angle::radians(std::atan2(climb_mps, along_mps)), roll};
}

FlightSample sample_of(const Motion& motion, const Attitude& attitude, std::string_view source) {
  FlightSample sample;
  databuffer::Ownship& ownship = sample.ownship;
  ownship.latitude_deg = motion.point.latitude_deg;
  ownship.longitude_deg = motion.point.longitude_deg;
  ownship.altitude_msl_m = motion.altitude.metres();
  ownship.heading_deg = attitude.heading.degrees();
  ownship.pitch_deg = attitude.pitch.degrees();
  ownship.roll_deg = attitude.roll.degrees();
  ownship.velocity_north_mps = motion.ground_speed.metres_per_second() * std::cos(motion.track.radians());
  ownship.velocity_east_mps = motion.ground_speed.metres_per_second() * std::sin(motion.track.radians());
  ownship.velocity_down_mps = -motion.climb.metres_per_second();
  ownship.radar_altitude_m = std::numeric_limits<double>::quiet_NaN();
  source.copy(ownship.source, sizeof ownship.source - 1);
  databuffer::Nav& nav = sample.nav;
  nav.mission_latitude_deg = nav.ins_latitude_deg = ownship.latitude_deg;
  nav.mission_longitude_deg = nav.ins_longitude_deg = ownship.longitude_deg;
  nav.velocity_north_mps = ownship.velocity_north_mps;
  nav.velocity_east_mps = ownship.velocity_east_mps;
  nav.velocity_down_mps = ownship.velocity_down_mps;
  nav.magnetic_variation_deg = std::numeric_limits<double>::quiet_NaN();
  return sample;
}

}  // namespace yars::flightmodel
