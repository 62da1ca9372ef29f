// Cartesian frames on WGS84: earth-centred, earth-fixed (ECEF) and local tangent (east, north, up).
// Inputs: positions and heights as types of geodesy.hpp and quantity.hpp. Outputs: vectors in metres.
// Frame: transforms are named target-from-source; docs/conventions.md fixes axes, zeros and signs.
// Threads: no shared mutable state. Source: library GeographicLib (Geocentric).
#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "lib/geo/geodesy.hpp"

namespace yars::geo {

// Vector of three components; zero by default (GLM_FORCE_CTOR_INIT). Each function defines the axes and the unit of its
// vectors.
using Vector3 = glm::dvec3;

// Earth-centred, earth-fixed vector [m]: x through latitude 0, longitude 0; z through the north pole.
Vector3 ecef_from_geodetic(GeoPoint point, HeightAboveEllipsoid height);

// Geodetic latitude and longitude, and height above the ellipsoid.
struct GeodeticPosition {
  GeoPoint point;
  HeightAboveEllipsoid height;
};
// Position and height of a finite ECEF vector [m]. The centre of the Earth gives the latitude of a pole.
GeodeticPosition geodetic_from_ecef(Vector3 ecef);

// Local tangent frame: x east, y north, z up (normal of the ellipsoid), in metres, at an origin with a height
// above the ellipsoid.
class LocalTangentFrame {
 public:
  LocalTangentFrame(GeoPoint origin, HeightAboveEllipsoid height);
  Vector3 enu_from_ecef(Vector3 ecef) const;
  Vector3 enu_from_geodetic(GeoPoint point, HeightAboveEllipsoid height) const;
  // Rotation only, for directions: the origin is not subtracted or added.
  Vector3 enu_from_ecef_direction(Vector3 ecef) const;
  Vector3 ecef_from_enu_direction(Vector3 enu) const;

 private:
  Vector3 origin_;               // [m] ECEF
  std::array<Vector3, 3> rows_;  // unit vectors of east, north and up in ECEF
};

}  // namespace yars::geo
