#include "databuffer/bridges/dead_reckoning.hpp"

#include <algorithm>
#include <cmath>

#include "databuffer/flight/motion.hpp"

namespace yars::databuffer::bridges {

namespace {

struct Way {
  geo::GeoPoint point;
  geo::Angle meridian_turn;  // by which north, there, is turned against north here
};

Way way_over_ground(const Ownship& from, double north_m, double east_m) {
  const double distance_m = std::hypot(north_m, east_m);
  const geo::GeoPoint point{from.latitude_deg, from.longitude_deg};
  if (distance_m == 0.0) return {point, {}};
  const auto azimuth = geo::Bearing::radians(std::atan2(east_m, north_m));
  const flight::Motion motion{point, geo::AltitudeMsl::metres(from.altitude_msl_m), azimuth, {}, {}};
  const auto there =
      geo::GeodesicRay(point, azimuth).place(flight::surface_distance(motion, geo::Length::metres(distance_m)));
  return {there.point, there.azimuth - azimuth};
}

}  // namespace

Ownship dead_reckoned(const ExternalSample& sample, geo::Duration after) {
  const double t = after.seconds();
  const geo::Vector3 a = sample.acceleration_mps2.value_or(geo::Vector3{});
  const Ownship& from = sample.ownship;
  Ownship there = from;
  const Way way = way_over_ground(from, from.velocity_north_mps * t + 0.5 * a.x * t * t,
                                  from.velocity_east_mps * t + 0.5 * a.y * t * t);
  there.latitude_deg = way.point.latitude_deg;
  there.longitude_deg = way.point.longitude_deg;
  there.altitude_msl_m -= from.velocity_down_mps * t + 0.5 * a.z * t * t;
  const double north_mps = from.velocity_north_mps + a.x * t;
  const double east_mps = from.velocity_east_mps + a.y * t;
  const double cos_turn = std::cos(way.meridian_turn.radians());
  const double sin_turn = std::sin(way.meridian_turn.radians());
  there.velocity_north_mps = north_mps * cos_turn - east_mps * sin_turn;
  there.velocity_east_mps = north_mps * sin_turn + east_mps * cos_turn;
  there.velocity_down_mps += a.z * t;
  const AttitudeRates rates = sample.rates.value_or(AttitudeRates{});
  const double heading_deg = from.heading_deg + rates.heading_dps * t + way.meridian_turn.degrees();
  there.heading_deg = geo::Bearing::degrees(heading_deg).degrees();
  there.pitch_deg = std::clamp(from.pitch_deg + rates.pitch_dps * t, -90.0, 90.0);
  there.roll_deg = geo::wrapped_degrees(from.roll_deg + rates.roll_dps * t);
  return there;
}

}  // namespace yars::databuffer::bridges
