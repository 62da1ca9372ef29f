#include "model/rbm/scene_ray.hpp"

#include <cmath>

namespace yars::model::rbm {

namespace {
constexpr double kMargin_m = 1000.0;  // deviation of a geodesic from the vertical plane through its start
}  // namespace

SceneRay::SceneRay(const physics::SweepGeometry& geometry) : range_m_(geometry.range.metres()) {
  const auto sea_level = geo::HeightAboveEllipsoid::metres(0.0);
  const geo::LocalTangentFrame level(geometry.apex, sea_level);
  const double azimuth_rad = geometry.azimuth.radians();
  apex_ = geo::ecef_from_geodetic(geometry.apex, sea_level);
  ahead_ = level.ecef_from_enu_direction({std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0});
  right_ = level.ecef_from_enu_direction({std::cos(azimuth_rad), -std::sin(azimuth_rad), 0.0});
  north_ = level.ecef_from_enu_direction({0.0, 1.0, 0.0});
  east_ = level.ecef_from_enu_direction({1.0, 0.0, 0.0});
}

SceneRay::InScene SceneRay::in(const scene::Scatterers& scene) const {
  return {scene.frame.enu_from_ecef(apex_), scene.frame.enu_from_ecef_direction(ahead_),
          scene.frame.enu_from_ecef_direction(right_), scene.frame.enu_from_ecef_direction(north_),
          scene.frame.enu_from_ecef_direction(east_)};
}

bool SceneRay::reaches(const scene::Scatterers& scene) const {
  // The chord is shorter than the distance over ground, so no scene in range is missed.
  return length(scene.frame.enu_from_ecef(apex_)) <= range_m_ + scene.reach_m;
}

bool SceneRay::crosses(const scene::Scatterers& scene) const {
  const geo::Vector3 apex = scene.frame.enu_from_ecef(apex_);
  const double ahead_m = -dot(apex, scene.frame.enu_from_ecef_direction(ahead_));
  const double right_m = -dot(apex, scene.frame.enu_from_ecef_direction(right_));
  return ahead_m >= -scene.reach_m && std::abs(right_m) <= scene.reach_m + kMargin_m;
}

}  // namespace yars::model::rbm
