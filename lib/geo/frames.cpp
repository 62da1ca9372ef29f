#include "lib/geo/frames.hpp"

#include <GeographicLib/Geocentric.hpp>
#include <cmath>

namespace yars::geo {

Vector3 ecef_from_geodetic(GeoPoint point, HeightAboveEllipsoid height) {
  Vector3 ecef;
  GeographicLib::Geocentric::WGS84().Forward(point.latitude_deg, point.longitude_deg, height.metres(), ecef.x, ecef.y,
                                             ecef.z);
  return ecef;
}

GeodeticPosition geodetic_from_ecef(Vector3 ecef) {
  GeodeticPosition position;
  double height_m = 0.0;
  GeographicLib::Geocentric::WGS84().Reverse(ecef.x, ecef.y, ecef.z, position.point.latitude_deg,
                                             position.point.longitude_deg, height_m);
  position.height = HeightAboveEllipsoid::metres(height_m);
  return position;
}

LocalTangentFrame::LocalTangentFrame(GeoPoint origin, HeightAboveEllipsoid height)
    : origin_(ecef_from_geodetic(origin, height)) {
  const double sin_lat = std::sin(origin.latitude_deg * kRadiansPerDegree);
  const double cos_lat = std::cos(origin.latitude_deg * kRadiansPerDegree);
  const double sin_lon = std::sin(origin.longitude_deg * kRadiansPerDegree);
  const double cos_lon = std::cos(origin.longitude_deg * kRadiansPerDegree);
  rows_ = {Vector3{-sin_lon, cos_lon, 0.0}, Vector3{-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat},
           Vector3{cos_lat * cos_lon, cos_lat * sin_lon, sin_lat}};
}

Vector3 LocalTangentFrame::enu_from_ecef_direction(Vector3 ecef) const {
  return {dot(rows_[0], ecef), dot(rows_[1], ecef), dot(rows_[2], ecef)};
}

Vector3 LocalTangentFrame::ecef_from_enu_direction(Vector3 enu) const {
  return enu.x * rows_[0] + enu.y * rows_[1] + enu.z * rows_[2];
}

Vector3 LocalTangentFrame::enu_from_ecef(Vector3 ecef) const {
  return enu_from_ecef_direction(ecef - origin_);
}

Vector3 LocalTangentFrame::enu_from_geodetic(GeoPoint point, HeightAboveEllipsoid height) const {
  return enu_from_ecef(ecef_from_geodetic(point, height));
}

}  // namespace yars::geo
