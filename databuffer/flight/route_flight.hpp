// Flight along a route of waypoints, and the parser of the route file.
// Inputs: route text; steps of sim time.
// Outputs: Ownship and Nav.
// Errors: a malformed line, successive waypoints closer than 100 m, or text after `loop`. They name the line.
//   Fewer than two waypoints: names the file.
// Source: coordinated turn, turn rate = g tan(bank) / V.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "databuffer/flight/motion.hpp"
#include "lib/error/error.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::databuffer::flight {

// Waypoint of a route, one per line: `LAT LON ALT_FT KT` [deg, deg, ft MSL, kn].
// `#` begins a comment. A last line `loop` adds a leg from the last to the first waypoint.
// Altitude and speed apply to the leg that ends at the waypoint.
struct Waypoint {
  geo::GeoPoint point;
  geo::AltitudeMsl altitude;
  geo::Speed ground_speed;
};

struct Route {
  std::vector<Waypoint> waypoints;  // at least two; successive ones are at least 100 m apart
  bool loop = false;

  // Index of the next waypoint. It is waypoints.size() after the last one of a route without loop.
  std::size_t after(std::size_t waypoint) const;
};

// `name`: file name for errors.
error::Expected<Route> parse_route(std::string_view text, std::string_view name);

inline constexpr geo::Angle kBankLimit = geo::Angle::degrees(30.0);  // usual limit of airliners and ferry flights
inline constexpr double kRollRate_dps = 15.0;                        // [deg/s] limit of the roll rate
inline constexpr geo::Speed kClimbLimit = geo::Speed::metres_per_second(20.0);  // 3,900 ft/min
inline constexpr double kAcceleration_mps2 = 2.0;  // [m/s^2] limit of horizontal and of vertical acceleration

// Flies geodesic legs with coordinated turns. Bank, roll rate, climb rate and acceleration have the limits above.
// A turn begins before the waypoint, so that it ends on the next leg.
// After a repositioning the aircraft flies to the end of the nearest leg.
// After the last waypoint of a route without loop it flies straight on.
// Guidance, far from the leg: the commanded track follows a turn circle towards the leg.
// Guidance, near the leg: the cross-track distance decays with a time constant of 8 s.
// The commanded turn rate is proportional to the track error.
class RouteFlight final : public FlightModel {
 public:
  explicit RouteFlight(Route route);
  FlightSample step(geo::Duration dt) override;
  void reset() override;
  bool reposition(const Placement& placement) override;

 private:
  void fly_to(std::size_t waypoint, geo::GeoPoint from);
  std::size_t nearest_leg_end(geo::GeoPoint position) const;
  void advance(double dt_s);
  void change_leg_in_time();
  geo::Length lead() const;
  geo::Angle intercept() const;
  geo::Angle commanded_bank() const;
  void change_speeds(double dt_s);
  void move(double dt_s);

  Route route_;
  Motion motion_;
  geo::Angle roll_;
  std::size_t target_ = 1;  // waypoint at the end of the leg
  Leg leg_;
  std::optional<Leg> next_;  // leg after leg_; none: leg_ is the last
  Leg::Fix fix_;             // position of the aircraft relative to the leg
};

}  // namespace yars::databuffer::flight
