// The azimuthal-equidistant plane about a place: x east, y north in metres; exact by the geodesic, and near a point of
// it by a linear map.
#pragma once

#include "lib/geo/geodesic.hpp"

namespace yars::model::scene {

struct PlanePoint {
  double east_m = 0.0, north_m = 0.0;
};

class Plane {
 public:
  explicit Plane(geo::GeoPoint origin) : origin_(origin) {}
  geo::GeoPoint origin() const { return origin_; }
  geo::GeoPoint place_of(PlanePoint point) const;
  PlanePoint point_of(geo::GeoPoint place) const;

 private:
  geo::GeoPoint origin_;
};

// What a point of one plane is in another, linear about `middle`: off by less than 1 mm within 300 m, for planes whose
// origins lie within 20 km; places off by less than 10 mm (on a plane's own origin, below 80 degrees of latitude).
class LocalMap {
 public:
  LocalMap(const Plane& from, PlanePoint middle);

  const Plane& plane() const { return to_; }  // about the middle
  PlanePoint to_local(PlanePoint point) const {
    const double e = point.east_m - middle_.east_m, n = point.north_m - middle_.north_m;
    return {e * east_.east_m + n * north_.east_m, e * east_.north_m + n * north_.north_m};
  }
  geo::GeoPoint place_of(PlanePoint point) const {
    const double e = point.east_m - middle_.east_m, n = point.north_m - middle_.north_m;
    const geo::GeoPoint o = to_.origin();
    return {o.latitude_deg + e * latitude_.east_m + n * latitude_.north_m,
            o.longitude_deg + e * longitude_.east_m + n * longitude_.north_m};
  }

 private:
  PlanePoint middle_;
  Plane to_;
  PlanePoint east_, north_;          // where a metre east and north go
  PlanePoint latitude_, longitude_;  // [deg/m]
};

}  // namespace yars::model::scene
