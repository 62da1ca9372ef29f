// Flight models: the interface, legs along geodesics, the state of a point that flies.
#pragma once

#include <string_view>

#include "databuffer/messages/world_state.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::databuffer::flight {

// A flight model: where an aircraft is after another stretch of sim time. Pure and deterministic.
// It fills all of both records but source_time_ns and epoch, which the caller knows. Latitude and longitude are
// WGS84; altitudes are above mean sea level and taken for heights above the ellipsoid where lengths are scaled
// (an undulation of 100 m changes a velocity by 1.6e-5 of it). Velocity is the derivative of the position, without
// wind; radar altitude is NaN: no model here knows the ground. The navigators know the truth.
struct FlightSample {
  Ownship ownship{};
  Nav nav{};
};

struct Placement {
  geo::GeoPoint point;
  geo::AltitudeMsl altitude;
  geo::Bearing heading;
};

// `dt` where it is a stretch of time ahead, else none.
geo::Duration stretch_ahead(geo::Duration dt);

class FlightModel {
 public:
  virtual ~FlightModel() = default;

  // `dt` after the call before; zero gives the present sample again, and so does what is no stretch of time ahead:
  // less than zero, infinite, not a number.
  virtual FlightSample step(geo::Duration dt) = 0;
  // Back to the start of the flight.
  virtual void reset() = 0;
  // Goes on from another place. False: this source cannot, and flies on as it was.
  virtual bool reposition(const Placement& placement) = 0;
  // Takes up where a predecessor of the same source was `gap` ago; false: this flight is not its. By default it is
  // placed where the predecessor was.
  virtual bool resume(const Ownship& last, geo::Duration gap);
};

// One leg of a route: a geodesic from a place to a waypoint, and where an aircraft is with respect to it. Exact on
// the ellipsoid, also across poles and the antimeridian and beyond either end.
class Leg {
 public:
  Leg(geo::GeoPoint from, geo::GeoPoint to);  // different places

  struct Fix {
    geo::Length along;    // from the start to the foot of the perpendicular; negative before it
    geo::Length across;   // right of the leg positive
    geo::Bearing course;  // of the leg, carried to the place
  };
  // `near` is where the foot is looked for first, for example the one found before. Converges to 1 mm, or takes
  // the eighth approximation when the place is a quarter of the Earth away.
  Fix fix(geo::GeoPoint place, geo::Length near) const;

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

// The state of a point that flies, and the records that say so.
struct Motion {
  geo::GeoPoint point;
  geo::AltitudeMsl altitude;
  geo::Bearing track;
  geo::Speed ground_speed;  // horizontal, at the aircraft's altitude
  geo::Speed climb;         // up positive
};

struct Attitude {
  geo::Bearing heading;
  geo::Angle pitch;
  geo::Angle roll;
};

// How far the point on the ellipsoid below moves while the aircraft, R + h from the centre, covers a distance.
geo::Length surface_distance(const Motion& motion, geo::Length flown);
// The reverse: the speed at altitude of an aircraft over a point that moves at `surface` on the ellipsoid.
geo::Speed speed_at_altitude(const Motion& motion, geo::Speed surface);

// Nose along the flight path, wings as given.
Attitude coordinated_attitude(const Motion& motion, geo::Angle roll);

// `source`: at most 15 characters are kept.
FlightSample sample_of(const Motion& motion, const Attitude& attitude, std::string_view source);

}  // namespace yars::databuffer::flight
