// One leg of a route: a geodesic from a place to a waypoint, and where an aircraft is with respect to it. Exact on
// the ellipsoid, also across poles and the antimeridian and beyond either end.
#pragma once

#include "lib/geo/geodesic.hpp"

namespace yars::databuffer::flight {

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

}  // namespace yars::databuffer::flight
