#include "model/rbm/scene_return.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/geo/earth.hpp"
#include "lib/geo/frames.hpp"
#include "lib/radar/fidelity.hpp"
#include "model/physics/environment.hpp"
#include "model/physics/sweep_geometry.hpp"

namespace yars::model::rbm {

namespace {
constexpr double kMargin_m = 1000.0;  // covers the deviation of a geodesic from the vertical plane through its start
// Echoes that are kept, a power of 2. A dense town has some hundreds in the beam.
constexpr std::size_t kEchoes = 8192;
// [noise] Weaker echoes are left out by `standard`: a thousand of them raise the noise by less than 0.005 dB.
constexpr double kNegligible = 1e-6;

// Slope along the sweep: central difference; beside a void and at the ends of the sweep, the one-sided difference.
double along_slope(const SceneReturn::Ground& ground, std::size_t index) {
  const auto known = [&](std::size_t at) { return !std::isnan(ground.height_m[at]); };
  const std::size_t near = index > 0 && known(index - 1) ? index - 1 : index;
  const std::size_t far = index + 1 < ground.height_m.size() && known(index + 1) ? index + 1 : index;
  const double run_m = ground.distance_m[far] - ground.distance_m[near];
  return run_m > 0.0 ? (ground.height_m[far] - ground.height_m[near]) / run_m : 0.0;
}

// An angle in [-2 pi, 2 pi], wrapped to [-pi, pi].
double wrapped_rad(double angle_rad) {
  constexpr double kPi = std::numbers::pi;
  return angle_rad > kPi ? angle_rad - 2.0 * kPi : angle_rad < -kPi ? angle_rad + 2.0 * kPi : angle_rad;
}

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

SceneReturn::SceneReturn(const physics::RadarParameters& parameters, std::size_t samples)
    : tables_(physics::SceneSurface(parameters)),
      parameters_(parameters.geometry),
      gas_(parameters),
      echoes_(kEchoes),
      surface_(parameters),
      ground_(samples),
      beam_(parameters.beam),
      fast_(parameters.fidelity.algorithm != radar::Algorithm::reference) {}

bool SceneReturn::enter(const physics::SweepGeometry& geometry, const scene::SceneView* scenes) {
  if (scenes == nullptr || scenes->scatterers().empty()) return false;
  const auto sea_level = geo::HeightAboveEllipsoid::metres(0.0);
  const geo::LocalTangentFrame level(geometry.apex, sea_level);
  const double azimuth_rad = geometry.azimuth.degrees() * geo::kRadiansPerDegree;
  apex_ = geo::ecef_from_geodetic(geometry.apex, sea_level);
  ahead_ = level.ecef_from_enu_direction({std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0});
  right_ = level.ecef_from_enu_direction({std::cos(azimuth_rad), -std::sin(azimuth_rad), 0.0});
  north_ = level.ecef_from_enu_direction({0.0, 1.0, 0.0});
  east_ = level.ecef_from_enu_direction({1.0, 0.0, 0.0});
  const View view{geometry.apex, geometry.altitude, geometry.range, geometry.elevation, scenes, scenes->generation()};
  if (!(view == view_)) ++view_number_;
  view_ = view;
  const auto all = scenes->scatterers();
  return std::any_of(all.begin(), all.end(),
                     [&](const scene::Scatterers* scene) { return in_range(*scene, geometry); });
}

bool SceneReturn::in_range(const scene::Scatterers& scene, const physics::SweepGeometry& geometry) const {
  // The chord is shorter than the distance over ground, so no scene in range is missed.
  return length(scene.frame.enu_from_ecef(apex_)) <= geometry.range.metres() + scene.reach_m;
}

// True if the ray passes over the scene, or at most kMargin_m beside it.
bool SceneReturn::under_ray(const scene::Scatterers& scene) const {
  const Ray ray = ray_in(scene);
  const double ahead_m = -dot(ray.apex, ray.ahead), right_m = -dot(ray.apex, ray.right);
  return ahead_m >= -scene.reach_m && std::abs(right_m) <= scene.reach_m + kMargin_m;
}

SceneReturn::Ray SceneReturn::ray_in(const scene::Scatterers& scene) const {
  return {scene.frame.enu_from_ecef(apex_), scene.frame.enu_from_ecef_direction(ahead_),
          scene.frame.enu_from_ecef_direction(right_), scene.frame.enu_from_ecef_direction(north_),
          scene.frame.enu_from_ecef_direction(east_)};
}

void SceneReturn::apply(const physics::SweepGeometry& geometry, const physics::Receiver& receiver,
                        const physics::GroundWalk& walk, const scene::SceneView& scenes, double pulse_samples) {
  const double spacing_m = geometry.range.metres() / static_cast<double>(ground_.power.size());
  const Sweep sweep{&geometry,
                    &receiver,
                    &walk.earth(),
                    &walk,
                    physics::point_smear_gain(pulse_samples),
                    spacing_m,
                    wrapped_rad(geometry.azimuth.radians())};
  for (const scene::Scatterers* scene : scenes.scatterers())
    if (in_range(*scene, geometry)) cover_ground(sweep, *scene);
  scatterers_before_ = 0;
  for (const scene::Scatterers* scene : scenes.scatterers()) {
    if (in_range(*scene, geometry)) add_standing(sweep, *scene);
    scatterers_before_ += scene->levels[scene->level_for(spacing_m)].scatterers.size();
  }
}

// Mixes the return of covers (flat faces on the ground, summed over squares of a grid) into the power of lit samples.
// The new power of a sample is the weighted mean of its old power and the power that it would have with the cover's
// gamma. The weight of the second power is the covered fraction of the square that contains the sample.
void SceneReturn::cover_ground(const Sweep& sweep, const scene::Scatterers& scene) {
  const std::size_t number = scene.level_for(sweep.spacing_m);
  const scene::ScattererLevel& level = scene.levels[number];
  if (level.covers.empty() || !under_ray(scene)) return;
  const double side_m = scene::kScattererSides_m[number];
  const RayOverPlane ray(*sweep.geometry, scene.position);
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
    ground_.power[i] += fraction * (covered_power(sweep, i, sum_m2 / area_m2) - ground_.power[i]);
  }
}

// Power that a sample would have with reflectivity `gamma` and the slopes of the ground.
double SceneReturn::covered_power(const Sweep& sweep, std::size_t sample, double gamma) const {
  const physics::Sight sight =
      sweep.earth->sight(sweep.geometry->altitude.metres(), ground_.distance_m[sample], ground_.height_m[sample]);
  const double slope = along_slope(ground_, sample);
  const double cross_slope = ground_.cross_slope[sample];
  const double normal = std::sqrt(1.0 + slope * slope + cross_slope * cross_slope);
  const double sin_local = std::clamp((slope * sight.cos_grazing + sight.sin_grazing) / normal, 0.0, 1.0);
  const double sigma_m2 =
      gamma * sin_local * physics::illuminated_area_m2(*sweep.receiver, sight.slant_range_m, sin_local);
  const double gain = physics::two_way_gain(beam_, sweep.receiver->elevation_beamwidth_rad,
                                            sweep.geometry->elevation.radians(), sight.elevation_rad);
  const double loss = gas_.two_way_transmission(*sweep.earth, sweep.geometry->altitude.metres(),
                                                ground_.distance_m[sample], ground_.height_m[sample]);
  return physics::received(*sweep.receiver, physics::returned_power(sigma_m2, loss * gain, sight.slant_range_m),
                           sight.slant_range_m);
}

// Calls `visit` for groups of scatterers that may lie within the range and within point_interval().
template <class Visit>
void SceneReturn::visit_standing(const physics::SweepGeometry& geometry, const physics::Receiver& receiver,
                                 const scene::Scatterers& scene, const scene::ScattererLevel& level,
                                 const Visit& visit) const {
  const Ray ray = ray_in(scene);
  const physics::AzimuthInterval interval = physics::point_interval(geometry.slice, receiver.azimuth_beamwidth_rad);
  if (!(interval.left_rad < interval.right_rad)) return;
  const double sin_left = std::sin(interval.left_rad), cos_left = std::cos(interval.left_rad);
  const double sin_right = std::sin(interval.right_rad), cos_right = std::cos(interval.right_rad);
  const double range_m = geometry.range.metres();
  const auto meets = [&](const scene::Ball& ball) {
    const geo::Vector3 to_point = ball.middle - ray.apex;
    const double ahead_m = dot(to_point, ray.ahead), right_m = dot(to_point, ray.right);
    const double farthest_m = range_m + ball.radius_m;
    return ahead_m >= -ball.radius_m && dot(to_point, to_point) <= farthest_m * farthest_m &&
           right_m * cos_left - ahead_m * sin_left >= -ball.radius_m &&
           ahead_m * sin_right - right_m * cos_right >= -ball.radius_m;
  };
  level.tree.search(meets, visit);
}

void SceneReturn::add_standing(const Sweep& sweep, const scene::Scatterers& scene) {
  const scene::ScattererLevel& level = scene.levels[scene.level_for(sweep.spacing_m)];
  const Ray ray = ray_in(scene);
  visit_standing(*sweep.geometry, *sweep.receiver, scene, level, [&](std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t i = first; i < end; ++i) add_scatterer(sweep, ray, level, i);
  });
}

bool SceneReturn::has_standing(const physics::SweepGeometry& geometry, const physics::Receiver& receiver,
                               const scene::SceneView* scenes) {
  if (!enter(geometry, scenes)) return false;
  const double spacing_m = geometry.range.metres() / static_cast<double>(ground_.power.size());
  bool found = false;
  for (const scene::Scatterers* scene : scenes->scatterers()) {
    if (found) break;
    if (in_range(*scene, geometry))
      visit_standing(geometry, receiver, *scene, scene->levels[scene->level_for(spacing_m)],
                     [&](std::uint32_t first, std::uint32_t end) { found = found || first < end; });
  }
  return found;
}

void SceneReturn::add_scatterer(const Sweep& sweep, const Ray& ray, const scene::ScattererLevel& level,
                                std::uint32_t index) {
  const scene::Scatterer& scatterer = level.scatterers[index];
  const std::uint64_t number = scatterers_before_ + index;
  const std::uint64_t key = (view_number_ << 32U) | (number + 1);
  Echo& echo = echoes_[number % kEchoes];
  if (echo.key != key) echo = find(sweep, ray, scatterer, key);
  if (!(echo.distance_m < sweep.geometry->range.metres())) return;
  const auto extent_m = static_cast<double>(scatterer.extent_m);
  const double gain =
      physics::point_azimuth_gain(sweep.geometry->slice, sweep.receiver->azimuth_beamwidth_rad,
                                  wrapped_rad(echo.azimuth_rad - sweep.azimuth_rad), extent_m / echo.distance_m);
  const double negligible = fast_ ? kNegligible * sweep.receiver->noise : 0.0;
  const auto is_negligible = [&] { return echo.power >= 0.0 && gain * echo.power <= negligible; };
  if (!(gain > 0.0) || is_negligible()) return;
  echo.nearer = physics::samples_nearer(ground_.distance_m, echo.distance_m, echo.nearer);
  const double lit = lit_fraction(sweep, scatterer, echo);
  if (!(lit > 0.0)) return;
  if (echo.power < 0.0) echo.power = power_of(sweep, ray, level, scatterer, echo);
  // Whether the power was known before must not change the sweep.
  if (is_negligible()) return;
  spread(echo, extent_m, sweep.point_smear_gain * lit * gain * echo.power);
}

// Earth and sight are those in the scatterer's own azimuth, so that they are the same in each sweep.
SceneReturn::Echo SceneReturn::find(const Sweep& sweep, const Ray& ray, const scene::Scatterer& scatterer,
                                    std::uint64_t key) const {
  const geo::Vector3 at{static_cast<double>(scatterer.east_m), static_cast<double>(scatterer.north_m),
                        static_cast<double>(scatterer.up_m)};
  const geo::Vector3 to_point = at - ray.apex;
  const double chord2 = dot(to_point, to_point);
  Echo echo{key};
  echo.azimuth_rad = std::atan2(dot(to_point, ray.east), dot(to_point, ray.north));
  const geo::Bearing azimuth = geo::Bearing::radians(echo.azimuth_rad);
  const double radius_m = geo::radius_of_curvature(sweep.geometry->apex.latitude_deg, azimuth).metres();
  // Length of the arc over the chord, to the third order.
  echo.distance_m = std::sqrt(chord2) * (1.0 + chord2 / (24.0 * radius_m * radius_m));
  echo.tangent =
      physics::effective_earth(parameters_, sweep.geometry->apex, azimuth)
          .tangent(sweep.geometry->altitude.metres(), echo.distance_m, static_cast<double>(scatterer.middle_msl_m));
  echo.nearer = physics::samples_nearer(ground_.distance_m, echo.distance_m);
  echo.power = -1.0;
  return echo;
}

double SceneReturn::power_of(const Sweep& sweep, const Ray& ray, const scene::ScattererLevel& level,
                             const scene::Scatterer& scatterer, const Echo& echo) const {
  const double altitude_m = sweep.geometry->altitude.metres();
  const auto middle_m = static_cast<double>(scatterer.middle_msl_m);
  const physics::EffectiveEarth earth =
      physics::effective_earth(parameters_, sweep.geometry->apex, geo::Bearing::radians(echo.azimuth_rad));
  const physics::Sight sight = earth.sight(altitude_m, echo.distance_m, middle_m);
  const double gain = physics::two_way_gain(beam_, sweep.receiver->elevation_beamwidth_rad,
                                            sweep.geometry->elevation.radians(), sight.elevation_rad);
  const double loss = gas_.two_way_transmission(earth, altitude_m, echo.distance_m, middle_m);
  return physics::received(
      *sweep.receiver,
      physics::returned_power(cross_section_m2(level, scatterer, ray, sight), loss * gain, sight.slant_range_m),
      sight.slant_range_m);
}

double SceneReturn::cross_section_m2(const scene::ScattererLevel& level, const scene::Scatterer& scatterer,
                                     const Ray& ray, const physics::Sight& sight) const {
  const double east = ray.apex.x - static_cast<double>(scatterer.east_m);
  const double north = ray.apex.y - static_cast<double>(scatterer.north_m);
  const double plan_m = std::hypot(east, north);  // distance to the apex seen from above
  if (!(plan_m > 0.0)) return 0.0;
  if (fast_)
    return static_cast<double>(
        simd::cross_section_m2(level.facings_of(scatterer), tables_,
                               {static_cast<float>(east / plan_m), static_cast<float>(north / plan_m),
                                static_cast<float>(sight.cos_grazing), static_cast<float>(sight.sin_grazing)}));
  double sum_m2 = 0.0;
  for (const scene::Facing& facing : level.facings_of(scatterer)) {
    const auto e = static_cast<double>(facing.east_m2), n = static_cast<double>(facing.north_m2);
    const double towards_m2 = (e * east + n * north) / plan_m;
    const double facing_m2 = towards_m2 * sight.cos_grazing + static_cast<double>(facing.up_m2) * sight.sin_grazing;
    if (!(facing_m2 > 0.0)) continue;
    const bool wall = facing.wall && towards_m2 > 0.0;
    sum_m2 += facing_m2 * (wall ? surface_.wall_gamma(facing.material, (n * east - e * north) / plan_m, towards_m2)
                                : surface_.gamma(facing.material));
  }
  return sum_m2;
}

// Maximum tangent of all ground nearer than a scatterer.
double SceneReturn::horizon_before(const Sweep& sweep, const scene::Scatterer& scatterer, const Echo& echo) const {
  const std::size_t nearer = echo.nearer;
  if (nearer == 0 || nearer >= ground_.straight.size() || ground_.straight[nearer] == 0)
    return sweep.walk->horizon_before(ground_.distance_m, echo.distance_m,
                                      [&](std::size_t sample) { return ground_.horizon[sample]; });
  const double near_m = ground_.distance_m[nearer - 1], near_peak_m = ground_.peak_m[nearer - 1];
  const double fraction = (echo.distance_m - near_m) / (ground_.distance_m[nearer] - near_m);
  const double ground_m = near_peak_m + fraction * (ground_.peak_m[nearer] - near_peak_m);
  const double tangent = echo.tangent + (ground_m - static_cast<double>(scatterer.middle_msl_m)) / echo.distance_m;
  return std::max(ground_.horizon[nearer - 1], tangent);
}

// Fraction [0, 1] of a scatterer's vertical extent that is above the horizon of all nearer ground.
double SceneReturn::lit_fraction(const Sweep& sweep, const scene::Scatterer& scatterer, const Echo& echo) const {
  const auto tangent = [&](float height_m) {
    return echo.tangent + static_cast<double>(height_m - scatterer.middle_msl_m) / echo.distance_m;
  };
  const double lowest = tangent(scatterer.min_msl_m), highest = tangent(scatterer.max_msl_m);
  const std::size_t nearer = echo.nearer;
  // If ground up to the last nearer sample hides the scatterer, the path beyond that sample need not be tested.
  if (nearer > 0 && highest <= ground_.horizon[nearer - 1]) return 0.0;
  const double horizon = horizon_before(sweep, scatterer, echo);
  if (!(highest > lowest)) return highest > horizon ? 1.0 : 0.0;
  return std::clamp((highest - horizon) / (highest - lowest), 0.0, 1.0);
}

// Distributes power evenly over the interval of length `extent_m` about the echo's distance. Each sample gets the part
// of the interval that is nearer to its centre than to the centre of any other sample.
void SceneReturn::spread(const Echo& echo, double extent_m, double power) {
  const std::vector<double>& centre_m = ground_.distance_m;
  const double from_m = echo.distance_m - 0.5 * extent_m, to_m = echo.distance_m + 0.5 * extent_m;
  const std::size_t first = physics::nearest_sample(centre_m, from_m, echo.nearer);
  const std::size_t last = std::min(physics::nearest_sample(centre_m, to_m, echo.nearer), centre_m.size() - 1);
  double begin_m = from_m;
  for (std::size_t i = first; i <= last; ++i) {
    const double end_m = i == last ? to_m : 0.5 * (centre_m[i] + centre_m[i + 1]);
    ground_.power[i] += first == last ? power : power * (end_m - begin_m) / extent_m;
    begin_m = end_m;
  }
}

}  // namespace yars::model::rbm
