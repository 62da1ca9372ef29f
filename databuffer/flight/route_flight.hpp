// Flight along a route of waypoints, and the parser of the route file.
// Inputs: route text; steps of sim time.
// Outputs: Ownship and Nav.
// Errors: a malformed line, neighbouring waypoints closer than 100 m, or fewer than two waypoints; the error names the
// line.
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

// Waypoint of a route. One a line: `LAT LON ALT_FT KT` (degrees, degrees, feet above mean sea level, knots).
// `#` begins a comment. A last line `loop` closes the route to its first waypoint. Altitude and speed apply to the leg
// that ends at the waypoint.
struct Waypoint {
  geo::GeoPoint point;
  geo::AltitudeMsl altitude;
  geo::Speed ground_speed;
};

struct Route {
  std::vector<Waypoint> waypoints;  // at least two, neighbours at least 100 m apart
  bool loop = false;

  // Index of the next waypoint. After the last one of a route without loop it is the number of waypoints.
  std::size_t after(std::size_t waypoint) const;
};

// `name`: file name for errors.
error::Expected<Route> parse_route(std::string_view text, std::string_view name);

inline constexpr geo::Angle kBankLimit = geo::Angle::degrees(30.0);  // usual limit of airliners and ferry flights
inline constexpr double kRollRate_dps = 15.0;
inline constexpr geo::Speed kClimbLimit = geo::Speed::metres_per_second(20.0);  // 3,900 ft/min
inline constexpr double kAcceleration_mps2 = 2.0;  // [m/s^2] limit of the change of speed and of climb

// Flies great-circle legs with coordinated turns of at most 30 deg bank and limited roll rate. A turn begins before the
// waypoint, so that it ends on the next leg. Climb rate, and acceleration of speed and climb, are limited. After a
// repositioning it flies to the end of the nearest leg. After the last waypoint of a route without loop it flies
// straight on.
// Guidance: the leg is approached along a circle tangent to it. The turn rate is proportional to the difference
// between the track and the direction of that circle.
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
  std::optional<Leg> next_;  // none: this is the last leg
  Leg::Fix fix_;             // position of the aircraft relative to the leg
};

}  // namespace yars::databuffer::flight
