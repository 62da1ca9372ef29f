#include "model/hrm/patch_geometry.hpp"

#include <cmath>

namespace yars::model::hrm {

PatchGeometry::PatchGeometry(const PatchOrder& order, const radar::Fidelity& fidelity, double elevation_m)
    : apex_(order.apex),
      altitude_m_(order.altitude.metres()),
      plane_msl_m_(elevation_m),
      distance_m_(0.0),
      window_m_(order.window.metres()),
      earth_(0.0) {
  const geo::GeodesicInverse way = geo::geodesic_inverse(order.apex, order.centre);
  distance_m_ = way.distance.metres();
  up_ = way.azimuth_at_start;
  earth_ = rbm::effective_earth(fidelity, apex_, up_);
}

MapPoint PatchGeometry::point_of(geo::GeoPoint place) const {
  const geo::GeodesicInverse way = geo::geodesic_inverse(apex_, place);
  const double turn_rad = (way.azimuth_at_start - up_).radians();
  const double distance_m = way.distance.metres();
  return {distance_m * std::sin(turn_rad), distance_m * std::cos(turn_rad) - distance_m_};
}

geo::GeoPoint PatchGeometry::place_of(MapPoint point) const {
  const double ahead_m = point.up_m + distance_m_;
  const geo::Bearing azimuth = up_ + geo::Angle::radians(std::atan2(point.right_m, ahead_m));
  return geo::geodesic_direct(apex_, azimuth, geo::Length::metres(std::hypot(point.right_m, ahead_m)));
}

double PatchGeometry::height_on_sight_m(double distance_m, double tangent) const {
  const double angle_rad = distance_m * earth_.curvature();
  const double sine = std::sin(angle_rad);
  const double chord_m = angle_rad > 0.0 ? earth_.radius_m() * sine : distance_m;
  // tangent = (height cos - drop - altitude) / (chord + height sin)
  const double above_m = altitude_m_ + earth_.drop_m(distance_m);
  return (above_m + tangent * chord_m) / (std::cos(angle_rad) - tangent * sine) - plane_msl_m_;
}

double PatchGeometry::slant_range_m() const {
  return std::hypot(distance_m_, above_plane_m(distance_m_));
}

double PatchGeometry::sin_grazing() const {
  return earth_.sight(altitude_m_ - plane_msl_m_, distance_m_, 0.0).sin_grazing;
}

double laid_over_m(double distance_m, double height_m, double above_level_m) {
  const double square = distance_m * distance_m + height_m * (height_m - 2.0 * above_level_m);
  return square > 0.0 ? std::sqrt(square) : 0.0;
}

}  // namespace yars::model::hrm
