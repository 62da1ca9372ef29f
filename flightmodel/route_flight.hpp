// Flight model that follows a route of waypoints, and the parser of the route file.
// Inputs: route text; steps of sim time.
// Outputs: Ownship and Nav.
// Errors: a malformed line, or consecutive waypoints closer than 100 m (the error names the line); fewer than two
// waypoints.
// Source: coordinated turn without wind: turn rate [rad/s] = g tan(bank) / V. g is gravity, V the ground speed.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "flightmodel/motion.hpp"
#include "lib/error/error.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::flightmodel {

// Waypoint of a route. File format: one waypoint per line, `LAT LON ALT_FT KT` (degrees, degrees, feet above mean sea
// level, knots of ground speed). `#` begins a comment. A last line `loop` adds a leg from the last waypoint to the
// first. Altitude and speed apply to the leg that ends at the waypoint.
// Ranges: altitude and speed of values::Reposition (lib/values/requests.idl).
struct Waypoint {
  geo::GeoPoint point;
  geo::AltitudeMsl altitude;
  geo::Speed ground_speed;
};

struct Route {
  std::vector<Waypoint> waypoints;  // at least two, neighbours at least 100 m apart
  bool loop = false;

  // Index of the waypoint after `waypoint`. After the last one: 0 for a loop, otherwise the number of waypoints.
  std::size_t after(std::size_t waypoint) const;
};

// `name`: file name for errors.
error::Expected<Route> parse_route(std::string_view text, std::string_view name);

inline constexpr geo::Angle kBankLimit = geo::Angle::degrees(30.0);  // usual limit of airliners
inline constexpr double kRollRate_dps = 15.0;                        // [deg/s] maximum rate of change of the roll angle
// Maximum rate of climb and descent, 3,900 ft/min.
inline constexpr geo::Speed kClimbLimit = geo::Speed::metres_per_second(20.0);
inline constexpr double kAcceleration_mps2 = 2.0;  // limit of the rate of change of ground speed and of climb rate

// Flight along geodesic legs with coordinated turns.
// Limits: kBankLimit, kRollRate_dps, kClimbLimit, and kAcceleration_mps2 for ground speed and climb rate.
// Turns: a turn begins before the waypoint (lead turn) and ends on the next leg.
// Guidance: far from the leg, the aircraft approaches it at a right angle, then on a circular arc. Near the leg, the
// commanded angle between track and leg is proportional to the distance from the leg.
// The commanded turn rate is proportional to the difference of commanded and actual track, within kBankLimit.
// A flight that is resumed keeps position, altitude, track, speed, climb and roll, and goes on along the nearest leg.
// After a repositioning the aircraft flies directly to the end of the nearest leg; straight and level if it has a
// speed. After the last waypoint of an open route the aircraft continues straight ahead.
class RouteFlight final : public FlightModel {
 public:
  // Flight of one step at most, whatever the clock says: a flight model that was held up for longer goes on from where
  // the aircraft was after this time. Its computation takes 0.04 s, as measured by the test of this limit.
  static constexpr geo::Duration kMaxFlown = geo::Duration::seconds(600.0);

  explicit RouteFlight(Route route);
  FlightSample step(geo::Duration dt) override;
  void reset() override;
  bool reposition(const Placement& placement) override;
  bool resume(const databuffer::Ownship& last, geo::Duration gap) override;

 private:
  std::size_t leg_flown(const Motion& motion) const;
  void fly_to(std::size_t waypoint, geo::GeoPoint from);  // sets leg_, next_, target_, fix_
  std::size_t nearest_leg_end(geo::GeoPoint position) const;
  void advance(double dt_s);
  void change_leg_in_time();
  geo::Length lead() const;      // distance before the waypoint at which the turn begins
  geo::Angle intercept() const;  // commanded angle from the leg to the track, right positive
  geo::Angle commanded_bank() const;
  void change_speeds(double dt_s);
  void move(double dt_s);

  Route route_;
  bool straight_ = false;  // after a repositioning with a speed: the aircraft flies straight, and the route waits
  Motion motion_;
  geo::Angle roll_;
  std::size_t target_ = 1;  // index of the waypoint at the end of leg_
  Leg leg_;
  std::optional<Leg> next_;  // leg after leg_; nullopt if leg_ is the last one
  Leg::Fix fix_;             // position of the aircraft along and across the leg
};

}  // namespace yars::flightmodel
