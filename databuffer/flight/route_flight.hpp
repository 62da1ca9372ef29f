// Flight along a route of waypoints, and the route's file.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "databuffer/flight/motion.hpp"
#include "lib/error/error.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::databuffer::flight {

// A route: waypoints in the order in which they are flown. One a line, `LAT LON ALT_FT KT` (degrees, degrees, feet
// above sea level, knots over ground), `#` begins a comment; a line `loop` at the end goes back to the first.
// Altitude and speed belong to the leg that ends at the waypoint.
struct Waypoint {
  geo::GeoPoint point;
  geo::AltitudeMsl altitude;
  geo::Speed ground_speed;
};

struct Route {
  std::vector<Waypoint> waypoints;  // at least two, neighbours at least 100 m apart
  bool loop = false;

  // Index of the waypoint after this one; the size of the route after the last of a route without loop.
  std::size_t after(std::size_t waypoint) const;
};

// `name` is the file's, for errors: they carry the line.
error::Expected<Route> parse_route(std::string_view text, std::string_view name);

// Flies a route: great-circle legs, coordinated turns (turn rate = g tan(bank) / V) of at most 30 deg bank with a
// limited roll rate, begun early so that they end on the next leg; climbs with limited rate, speed changes with
// limited acceleration. Placed elsewhere, it flies to the end of the nearest leg. After the last waypoint of a
// route without loop it goes straight on.
// Guidance: the leg is met along a circle tangent to it; the turn rate is proportional to what the track misses
// of that circle's direction.
inline constexpr geo::Angle kBankLimit = geo::Angle::degrees(30.0);  // an airliner's and a ferry flight's habit
inline constexpr double kRollRate_dps = 15.0;                        // [deg/s]
inline constexpr geo::Speed kClimbLimit = geo::Speed::metres_per_second(20.0);  // 3,900 ft/min
inline constexpr double kAcceleration_mps2 = 2.0;                               // [m/s^2] of speed and of climb

class RouteFlight final : public FlightModel {
 public:
  explicit RouteFlight(Route route);
  FlightSample step(geo::Duration dt) override;
  void reset() override;
  bool reposition(const Placement& placement) override;

 private:
  void fly_to(std::size_t waypoint, geo::GeoPoint from);
  std::size_t nearest_leg_end(geo::GeoPoint place) const;
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
  std::optional<Leg> next_;  // none: the leg is the last
  Leg::Fix fix_;             // where the aircraft is on the leg
};

}  // namespace yars::databuffer::flight
