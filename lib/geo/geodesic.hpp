// Geodesics on WGS84; the only caller of GeographicLib. Accuracy: 15 nm (Karney 2013, J. Geodesy 87, 43-55).
#pragma once

#include <array>
#include <cstddef>

#include "lib/geo/bearing.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::geo {

// Where on the ellipsoid: geodetic latitude [-90, 90], longitude [-180, 180], degrees, WGS84.
struct GeoPoint {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
};

struct GeodesicInverse {
  Length distance;
  Bearing azimuth_at_start;
  Bearing azimuth_at_end;
};

GeodesicInverse geodesic_inverse(GeoPoint from, GeoPoint to);
GeoPoint geodesic_direct(GeoPoint from, Bearing azimuth, Length distance);

// A ray from one point along one azimuth; positions along it are exact and cheap (one series each). A value: making
// one allocates nothing, for the radar kernel makes one a sweep.
class GeodesicRay {
 public:
  GeodesicRay(GeoPoint start, Bearing azimuth);

  GeoPoint position(Length distance) const;
  // Position and the azimuth of the ray there.
  struct Place {
    GeoPoint point;
    Bearing azimuth;
  };
  Place place(Length distance) const;

 private:
  struct Line;
  const Line& line() const;
  alignas(std::max_align_t) std::array<std::byte, 1024> storage_;  // a Line, which is plain numbers
};

// Radius of curvature of the ellipsoid at a latitude along an azimuth (Euler): the earth radius that a ray feels.
Length radius_of_curvature(double latitude_deg, Bearing azimuth);

}  // namespace yars::geo
