// Cartesian frames on WGS84: earth-centred (ECEF) and local tangent (east, north, up). Units: metres.
// Functions are named target-from-source; axes, zeros and senses are fixed in docs/conventions.md.
#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "lib/geo/geodesy.hpp"

namespace yars::geo {

// Vector of space; its frame and unit stand where it comes from. Zero by default (GLM_FORCE_CTOR_INIT).
using Vector3 = glm::dvec3;

// Earth-centred, earth-fixed metres: x through (0, 0), z through the north pole.
Vector3 ecef_from_geodetic(GeoPoint point, HeightAboveEllipsoid height);

// Where a finite place is over the ellipsoid; the centre of the Earth counts as below a pole.
struct GeodeticPlace {
  GeoPoint point;
  HeightAboveEllipsoid height;
};
GeodeticPlace geodetic_from_ecef(Vector3 ecef);

// East, north, up metres at an origin on the ellipsoid.
class LocalTangentFrame {
 public:
  LocalTangentFrame(GeoPoint origin, HeightAboveEllipsoid height);
  Vector3 enu_from_ecef(Vector3 ecef) const;
  Vector3 enu_from_geodetic(GeoPoint point, HeightAboveEllipsoid height) const;
  // Of directions: nothing of the origin is in them.
  Vector3 enu_from_ecef_direction(Vector3 ecef) const;
  Vector3 ecef_from_enu_direction(Vector3 enu) const;

 private:
  Vector3 origin_;
  std::array<Vector3, 3> rows_;
};

}  // namespace yars::geo
