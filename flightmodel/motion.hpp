// Flight models: their interface, route legs along geodesics, and conversion of motion to records.
// Inputs: steps of sim time; positions and speeds.
// Outputs: Ownship and Nav without source_time_ns and epoch.
// Frame: latitude and longitude are WGS84, altitude is above mean sea level, velocity is over ground.
// Accuracy: a distance flown is converted to a distance on the ellipsoid by the altitude above mean sea level, not by
// the height above the ellipsoid. Where these differ by 100 m, the relative velocity error is 1.6e-5.
// Threads: pure and deterministic.
#pragma once

#include <optional>
#include <string_view>

#include "databuffer/messages/world_state.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::flightmodel {

// Records of one step. The caller sets source_time_ns and epoch. Velocity is the derivative of the position; there is
// no wind. Radar altitude is NaN, because no model has ground data. Nav has the true position, without errors.
struct FlightSample {
  databuffer::Ownship ownship{};
  databuffer::Nav nav{};
};

// Position and heading at which a repositioned flight continues.
struct Placement {
  geo::GeoPoint point;
  geo::AltitudeMsl altitude;
  geo::Bearing heading;
  // With a speed, the flight goes on straight and level at it, until it is reset or repositioned. Without one the model
  // chooses.
  std::optional<geo::Speed> ground_speed{};
};

// Returns `dt` if it is positive and finite, else zero.
geo::Duration forward_step(geo::Duration dt);

class FlightModel {
 public:
  virtual ~FlightModel() = default;

  // Advances by `dt` and returns the sample. A `dt` that is zero, negative or not finite returns the present sample.
  virtual FlightSample step(geo::Duration dt) = 0;
  // Returns to the start of the flight.
  virtual void reset() = 0;
  // Continues from another position. False: the model does not support it, and its flight is unchanged.
  virtual bool reposition(const Placement& placement) = 0;
  // Continues the flight of an earlier process with the same source. `last`: newest known ownship of that process.
  // `gap`: sim time since `last`. False: the model cannot continue that flight. The default implementation repositions
  // to `last` and ignores `gap`.
  virtual bool resume(const databuffer::Ownship& last, geo::Duration gap);
};

// Leg of a route: a geodesic from one point to another, and the position of an aircraft relative to it. Valid across
// poles and the antimeridian, and beyond either end.
class Leg {
 public:
  Leg(geo::GeoPoint from, geo::GeoPoint to);  // the points must differ

  struct Fix {
    geo::Length along;    // distance from the start to the foot of the perpendicular; negative before the start
    geo::Length across;   // distance of the aircraft from the leg, positive to the right of it
    geo::Bearing course;  // direction parallel to the leg, at the position of the aircraft
  };
  // Position relative to the leg, to 1 mm. `near`: distance along the leg at which the iteration starts, such as the
  // previous result. The iteration ends after at most 8 steps. At a quarter of the Earth's circumference from the leg,
  // 8 steps do not reach 1 mm.
  Fix fix(geo::GeoPoint position, geo::Length near) const;

  geo::GeoPoint point(geo::Length along) const { return ray_.position(along); }
  geo::Length length() const { return length_; }
  geo::Bearing course_at_start() const { return course_at_start_; }
  geo::Bearing course_at_end() const { return course_at_end_; }

 private:
  Leg(geo::GeoPoint from, const geo::GeodesicInverse& inverse);

  geo::GeodesicRay ray_;
  geo::Length length_;
  geo::Bearing course_at_start_;
  geo::Bearing course_at_end_;
};

// State of the aircraft as a moving point.
struct Motion {
  geo::GeoPoint point;
  geo::AltitudeMsl altitude;
  geo::Bearing track;       // direction of the horizontal velocity
  geo::Speed ground_speed;  // horizontal, at the altitude of the aircraft
  geo::Speed climb;         // vertical speed, up positive
};

struct Attitude {
  geo::Bearing heading;  // direction of the nose
  geo::Angle pitch;      // of the nose above the horizontal
  geo::Angle roll;       // right wing down positive
};

// Distance on the ellipsoid that the point below the aircraft moves while the aircraft flies `flown` at its altitude.
geo::Length surface_distance(const Motion& motion, geo::Length flown);
// Speed of the aircraft at its altitude while the point below it moves on the ellipsoid at the speed `surface`.
geo::Speed speed_at_altitude(const Motion& motion, geo::Speed surface);

// Attitude with the nose along the flight path and the given roll.
Attitude coordinated_attitude(const Motion& motion, geo::Angle roll);

// Records of a motion and an attitude. A `source` of more than 15 characters is cut to 15.
FlightSample sample_of(const Motion& motion, const Attitude& attitude, std::string_view source);

}  // namespace yars::flightmodel
