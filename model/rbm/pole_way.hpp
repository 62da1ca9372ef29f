// How a ray passes the nearer pole, and how long a piece of it may be there to count as straight in latitude and
// longitude. The ray is a straight line in the plane of the pole: its way past the pole is right within 20 m for 320
// NM.
#pragma once

#include "lib/geo/bearing.hpp"
#include "lib/geo/geodesic.hpp"

namespace yars::model::rbm {

class PoleWay {
 public:
  // `bend_m`: how far a piece may lie from the straight way between its ends; `shortest_m`: no piece is shorter.
  PoleWay(geo::GeoPoint apex, geo::Bearing azimuth, double bend_m, double shortest_m);

  // [m] that a piece beginning this far along the ray may be long. It turns by less than a degree of longitude, but
  // for the shortest ones.
  double straight_m(double along_m) const;
  // The least of that between two distances along the ray.
  double least_straight_m(double from_m, double to_m) const;

 private:
  double straight_at(double to_pole_m) const;

  double nearest_m_;  // along the ray, where the pole is nearest; negative: behind
  double offset_m_;   // of the pole from the ray there
  double bend_m_, shortest_m_;
};

}  // namespace yars::model::rbm
