// Cartesian frames. Names are target-from-source; axes, zeros and senses are fixed in docs/conventions.md.
#pragma once

#include <array>

#include "lib/geo/geodesic.hpp"
#include "lib/geo/height.hpp"

namespace yars::geo {

struct Vector3 {
  double x = 0.0, y = 0.0, z = 0.0;
};

// Earth-centred, earth-fixed metres: x through (0, 0), z through the north pole.
Vector3 ecef_from_geodetic(GeoPoint point, HeightAboveEllipsoid height);

// East, north, up metres at an origin on the ellipsoid.
class LocalTangentFrame {
 public:
  LocalTangentFrame(GeoPoint origin, HeightAboveEllipsoid height);
  Vector3 enu_from_ecef(Vector3 ecef) const;
  Vector3 enu_from_geodetic(GeoPoint point, HeightAboveEllipsoid height) const;

 private:
  Vector3 origin_;
  std::array<Vector3, 3> rows_;
};

}  // namespace yars::geo
