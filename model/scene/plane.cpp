#include "model/scene/plane.hpp"

#include <cmath>

namespace yars::model::scene {

geo::GeoPoint Plane::place_of(PlanePoint point) const {
  const double distance_m = std::hypot(point.east_m, point.north_m);
  if (distance_m == 0.0) return origin_;
  return geo::geodesic_direct(origin_, geo::Bearing::radians(std::atan2(point.east_m, point.north_m)),
                              geo::Length::metres(distance_m));
}

PlanePoint Plane::point_of(geo::GeoPoint place) const {
  const geo::GeodesicInverse way = geo::geodesic_inverse(origin_, place);
  const double distance_m = way.distance.metres();
  const double azimuth_rad = way.azimuth_at_start.radians();
  return {distance_m * std::sin(azimuth_rad), distance_m * std::cos(azimuth_rad)};
}

LocalMap::LocalMap(const Plane& from, PlanePoint middle) : middle_(middle), to_(from.place_of(middle)) {
  constexpr double kStep_m = 256.0;  // half a tile: exact on its edges' middles
  const auto slope = [&](double east, double north, PlanePoint& moved, double& latitude, double& longitude) {
    const geo::GeoPoint ahead = from.place_of({middle.east_m + kStep_m * east, middle.north_m + kStep_m * north});
    const geo::GeoPoint behind = from.place_of({middle.east_m - kStep_m * east, middle.north_m - kStep_m * north});
    const PlanePoint a = to_.point_of(ahead), b = to_.point_of(behind);
    moved = {(a.east_m - b.east_m) / (2 * kStep_m), (a.north_m - b.north_m) / (2 * kStep_m)};
    latitude = (ahead.latitude_deg - behind.latitude_deg) / (2 * kStep_m);
    longitude = geo::wrapped_degrees(ahead.longitude_deg - behind.longitude_deg) / (2 * kStep_m);
  };
  slope(1.0, 0.0, east_, latitude_.east_m, longitude_.east_m);
  slope(0.0, 1.0, north_, latitude_.north_m, longitude_.north_m);
}

}  // namespace yars::model::scene
