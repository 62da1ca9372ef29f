#include "model/rbm/scene_ray.hpp"

#include <algorithm>
#include <cmath>

#include "lib/geo/geodesy.hpp"
#include "model/physics/environment.hpp"

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

namespace {
// Positions along a ray, in metres east and north of a scene's origin. They are computed on a sphere. The error is some
// metres for scenes of some tens of kilometres.
class RayOverPlane {
 public:
  RayOverPlane(const physics::SweepGeometry& geometry, geo::GeoPoint position) {
    const geo::GeodesicInverse path = geo::geodesic_inverse(geometry.apex, position);
    distance_m_ = path.distance.metres();
    const double offset_rad = (geometry.azimuth - path.azimuth_at_start).radians();
    sin_off_ = std::sin(offset_rad);
    cos_off_ = std::cos(offset_rad);
    sin_end_ = std::sin(path.azimuth_at_end.degrees() * geo::kRadiansPerDegree);
    cos_end_ = std::cos(path.azimuth_at_end.degrees() * geo::kRadiansPerDegree);
  }
  double distance_m() const { return distance_m_; }

  struct Point {
    double east_m, north_m;
  };
  Point at(double distance_m) const {
    const double sine = std::sin(distance_m / geo::kMeanEarthRadius_m);
    const double cosine = std::cos(distance_m / geo::kMeanEarthRadius_m);
    const double across_m = geo::kMeanEarthRadius_m * std::asin(sine * sin_off_);
    const double along_m = geo::kMeanEarthRadius_m * std::atan2(sine * cos_off_, cosine) - distance_m_;
    return {along_m * sin_end_ + across_m * cos_end_, along_m * cos_end_ - across_m * sin_end_};
  }

 private:
  double distance_m_, sin_off_, cos_off_, sin_end_, cos_end_;
};
}  // namespace

SceneCovers::SceneCovers(const physics::RadarParameters& parameters, std::size_t samples)
    : surface_(parameters), ground_(samples) {}

double SceneCovers::spacing_m(const physics::SweepGeometry& geometry) const {
  return geometry.range.metres() / static_cast<double>(ground_.power.size());
}

bool SceneCovers::lies_under(const SceneRay& ray, const physics::SweepGeometry& geometry,
                             const scene::Scatterers& scene) const {
  const scene::ScattererLevel& level = scene.levels[scene.level_for(spacing_m(geometry))];
  return !level.covers.empty() && ray.reaches(scene) && ray.crosses(scene);
}

bool SceneCovers::enter(const physics::SweepGeometry& geometry, const scene::SceneView* scenes) {
  if (scenes == nullptr || scenes->scatterers().empty()) return false;
  const SceneRay ray(geometry);
  const auto all = scenes->scatterers();
  return std::any_of(all.begin(), all.end(),
                     [&](const scene::Scatterers* scene) { return lies_under(ray, geometry, *scene); });
}

void SceneCovers::apply(const physics::SweepGeometry& geometry, const scene::SceneView& scenes) {
  const SceneRay ray(geometry);
  for (const scene::Scatterers* scene : scenes.scatterers())
    if (lies_under(ray, geometry, *scene)) cover(geometry, *scene);
}

// Mixes the return of covers (flat faces on the ground, summed over squares of a grid) into the power of lit samples.
// The new power of a sample is the weighted mean of its old power and the power that it would have with the cover's
// gamma. The weight of the second power is the covered fraction of the square that contains the sample.
void SceneCovers::cover(const physics::SweepGeometry& geometry, const scene::Scatterers& scene) {
  const std::size_t number = scene.level_for(spacing_m(geometry));
  const scene::ScattererLevel& level = scene.levels[number];
  const double side_m = scene::kScattererSides_m[number];
  const RayOverPlane ray(geometry, scene.position);
  const double nearest_m = ray.distance_m() - scene.reach_m, farthest_m = ray.distance_m() + scene.reach_m;
  for (std::size_t i = physics::nearest_sample(ground_.distance_m, nearest_m); i < ground_.power.size(); ++i) {
    const double distance_m = ground_.distance_m[i];
    if (distance_m > farthest_m) break;
    if (!(ground_.power[i] > 0.0)) continue;
    const RayOverPlane::Point at = ray.at(distance_m);
    if (at.east_m * at.east_m + at.north_m * at.north_m > scene.reach_m * scene.reach_m) continue;
    const auto found = level.covers.find(scene::square_key(at.east_m, at.north_m, side_m));
    if (found == level.covers.end()) continue;
    double area_m2 = 0.0, sum_m2 = 0.0;
    for (const scene::Facing& facing : level.facings_of(found->second)) {
      area_m2 += static_cast<double>(facing.up_m2);
      sum_m2 += static_cast<double>(facing.up_m2) * surface_.gamma(facing.material);
    }
    const auto fraction = static_cast<double>(found->second.share);
    ground_.power[i] += fraction * (sum_m2 / area_m2 * ground_.power_per_gamma[i] - ground_.power[i]);
  }
}

}  // namespace yars::model::rbm
