#include "model/rbm/point_return.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/fidelity.hpp"
#include "lib/radar/world.hpp"
#include "model/physics/ray.hpp"

namespace yars::model::rbm {

namespace {
// Echoes that are kept, a power of 2. A dense town has some hundreds in the beam.
constexpr std::size_t kEchoes = 8192;
// [noise] Weaker echoes are left out by `standard`: a thousand of them raise the noise by less than 0.005 dB.
constexpr double kNegligible = 1e-6;

// An angle in [-2 pi, 2 pi], wrapped to [-pi, pi].
double wrapped_rad(double angle_rad) {
  constexpr double kPi = std::numbers::pi;
  return angle_rad > kPi ? angle_rad - 2.0 * kPi : angle_rad < -kPi ? angle_rad + 2.0 * kPi : angle_rad;
}
}  // namespace

PointReturn::PointReturn(const physics::RadarParameters& parameters)
    : parameters_(parameters.geometry),
      beam_(parameters.beam),
      interpolation_(parameters.interpolation),
      fast_(parameters.algorithm != radar::Algorithm::reference),
      pulse_smear_(parameters.fidelity.pulse_smear),
      has_movers_(!parameters.world.movers.empty()),
      receivers_(parameters),
      movers_(parameters),
      mover_sights_(parameters, parameters.world.movers.size() + physics::kMaxTraffic),
      gas_(parameters),
      surface_(parameters),
      tables_(surface_),
      echoes_(kEchoes),
      points_(parameters.samples),
      smeared_(parameters.samples),
      first_(parameters.samples) {
  rays_.reserve(radar::kMaxSubBeams + 2);
}

void PointReturn::use_movers(const physics::RadarParameters& parameters) {
  has_movers_ = !parameters.world.movers.empty();
  movers_.use_movers(parameters);
  // The lines of sight are kept by number, and each number may be another mover from here on.
  mover_sights_ = MoverSights(parameters, parameters.world.movers.size() + physics::kMaxTraffic);
}

void PointReturn::use_sea(const physics::RadarParameters& parameters) {
  movers_.use_sea(parameters);
  ++view_number_;  // the powers of the echoes are those of another sea
}

bool PointReturn::may_return(const physics::SweepGeometry& geometry, const physics::Environment& environment) const {
  if (has_movers_ || !environment.traffic.empty()) return true;
  if (environment.scenes == nullptr || environment.scenes->scatterers().empty()) return false;
  const SceneRay ray(geometry);
  const auto scenes = environment.scenes->scatterers();
  return std::any_of(scenes.begin(), scenes.end(), [&](const scene::Scatterers* scene) { return ray.reaches(*scene); });
}

void PointReturn::add(const physics::SweepGeometry& geometry, const physics::Environment& environment,
                      std::span<const RayGround* const> rays, std::span<float> power,
                      std::vector<physics::SteadyPower>& steady) {
  if (receiver_.range_m != geometry.range.metres()) receiver_ = receivers_.at(geometry.range);
  const double spacing_m = geometry.range.metres() / static_cast<double>(points_.size());
  const double pulse_samples = pulse_smear_ ? receiver_.pulse_length_m / spacing_m : 0.0;
  if (pulse_samples != smeared_samples_) {
    smeared_samples_ = pulse_samples;
    smear_ = physics::make_pulse_smear(pulse_samples);
  }
  set_rays(geometry, rays);
  const Sweep sweep{geometry,
                    environment,
                    receiver_,
                    physics::point_smear_gain(pulse_samples),
                    spacing_m,
                    wrapped_rad(geometry.azimuth.radians()),
                    fast_ ? kNegligible * receiver_.noise : 0.0};
  add_movers(sweep);
  smear_into(power, &steady);
  if (environment.scenes != nullptr) add_scenes(sweep, *environment.scenes);
  smear_into(power, nullptr);
}

void PointReturn::set_rays(const physics::SweepGeometry& geometry, std::span<const RayGround* const> rays) {
  distance_m_ = rays.front()->distance_m;
  rays_.clear();
  for (const RayGround* ground : rays) {
    const physics::SweepGeometry& ray = ground->geometry;
    const auto [north_m, east_m, up_m] = physics::displacement(ray, geometry);
    const double ahead_m = north_m * std::cos(ray.azimuth.radians()) + east_m * std::sin(ray.azimuth.radians());
    rays_.push_back({ground, ahead_m, up_m, ahead_m != 0.0 || up_m != 0.0});
  }
  const auto offset_rad = [&](const RayGround* ray) { return (ray->geometry.azimuth - geometry.azimuth).radians(); };
  first_ray_rad_ = offset_rad(rays.front());
  const double width_rad = offset_rad(rays.back()) - first_ray_rad_;
  rays_per_rad_ = width_rad > 0.0 ? static_cast<double>(rays.size() - 1) / width_rad : 0.0;
}

// The rays to the left and to the right of an azimuth. Beyond the outermost rays it is that ray alone.
PointReturn::Neighbours PointReturn::rays_at(double offset_rad) const {
  const auto last = static_cast<double>(rays_.size() - 1);
  const double steps = std::clamp((offset_rad - first_ray_rad_) * rays_per_rad_, 0.0, last);
  const auto left = static_cast<std::size_t>(steps);
  return {left, std::min(left + 1, rays_.size() - 1), steps - static_cast<double>(left)};
}

// The target as a ray sees it. `about`: about how many samples are nearer.
PointReturn::Seen PointReturn::seen_by(const Shade& ray, const Target& target, std::size_t about) const {
  Seen seen{*ray.ground, target, 0};
  if (ray.moved && target.distance_m + ray.ahead_m > 0.0) {
    seen.target.distance_m = target.distance_m + ray.ahead_m;
    seen.target.per_metre = 1.0 / seen.target.distance_m;
    seen.target.tangent = (target.tangent * target.distance_m + ray.climb_m) * seen.target.per_metre;
  }
  seen.nearer = physics::samples_nearer(distance_m_, seen.target.distance_m, about);
  return seen;
}

// Maximum tangent of all ground nearer than a target.
double PointReturn::horizon_before(const Sweep& sweep, const Seen& seen) const {
  const RayGround& ground = seen.ground;
  const std::size_t nearer = seen.nearer;
  if (nearer == 0 || nearer >= distance_m_.size() || std::isnan(ground.samples[nearer].slope)) {
    const auto earth = physics::effective_earth(parameters_, ground.geometry);
    const physics::GroundWalk walk(ground.geometry, earth, sweep.environment.terrain, interpolation_);
    return walk.horizon_before(distance_m_, seen.target.distance_m,
                               [&](std::size_t sample) { return ground.samples[sample].horizon; });
  }
  const RayGround::Sample& before = ground.samples[nearer - 1];
  const double ground_m =
      before.peak_m + ground.samples[nearer].slope * (seen.target.distance_m - distance_m_[nearer - 1]);
  return std::max(before.horizon, seen.tangent_of(ground_m));
}

// A mover is hidden along its own azimuth: a hill may hide it from the rays on both sides of it, or from neither.
void PointReturn::add_movers(const Sweep& sweep) {
  const physics::SweepGeometry& geometry = sweep.geometry;
  const terrain::TerrainView& terrain = sweep.environment.terrain;
  const auto earth = physics::effective_earth(parameters_, geometry);
  mover_sights_.enter(geometry, terrain);
  for (const physics::Echo& echo : movers_.echoes(geometry, sweep.receiver, earth, sweep.environment)) {
    if (echo.power <= sweep.negligible) continue;
    if (!mover_sights_.clear(echo.number, echo.position, echo.above_ground_m, terrain)) continue;
    // A mover nearer than the first sample on the ground is added to that sample.
    const double shown_m = parameters_.slant_range ? echo.slant_range_m : echo.distance_m;
    put(*rays_[rays_at(echo.offset_rad).nearest()].ground, physics::nearest_sample(distance_m_, shown_m),
        sweep.point_smear_gain * echo.power);
  }
}

void PointReturn::add_scenes(const Sweep& sweep, const scene::SceneView& scenes) {
  const View view{sweep.geometry.apex, sweep.geometry.altitude, sweep.geometry.range, sweep.geometry.elevation, &scenes,
                  scenes.generation()};
  if (!(view == view_)) ++view_number_;
  view_ = view;
  const SceneRay ray(sweep.geometry);
  scatterers_before_ = 0;
  for (const scene::Scatterers* scene : scenes.scatterers()) {
    if (ray.reaches(*scene)) add_standing(sweep, ray.in(*scene), *scene);
    scatterers_before_ += scene->levels[scene->level_for(sweep.spacing_m)].scatterers.size();
  }
}

// Adds the scatterers within the range and within point_interval().
void PointReturn::add_standing(const Sweep& sweep, const SceneRay::InScene& ray, const scene::Scatterers& scene) {
  const scene::ScattererLevel& level = scene.levels[scene.level_for(sweep.spacing_m)];
  const physics::AzimuthInterval interval =
      physics::point_interval(sweep.geometry.sharpened_cell, sweep.receiver.azimuth_beamwidth_rad);
  const double sin_left = std::sin(interval.left_rad), cos_left = std::cos(interval.left_rad);
  const double sin_right = std::sin(interval.right_rad), cos_right = std::cos(interval.right_rad);
  const double range_m = sweep.geometry.range.metres();
  const auto meets = [&](const scene::Ball& ball) {
    const geo::Vector3 to_point = ball.middle - ray.apex;
    const double ahead_m = dot(to_point, ray.ahead), right_m = dot(to_point, ray.right);
    const double farthest_m = range_m + ball.radius_m;
    return ahead_m >= -ball.radius_m && dot(to_point, to_point) <= farthest_m * farthest_m &&
           right_m * cos_left - ahead_m * sin_left >= -ball.radius_m &&
           ahead_m * sin_right - right_m * cos_right >= -ball.radius_m;
  };
  level.tree.search(meets, [&](std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t i = first; i < end; ++i) add_scatterer(sweep, ray, level, i);
  });
}

void PointReturn::add_scatterer(const Sweep& sweep, const SceneRay::InScene& ray, const scene::ScattererLevel& level,
                                std::uint32_t index) {
  const scene::Scatterer& scatterer = level.scatterers[index];
  const std::uint64_t number = scatterers_before_ + index;
  const std::uint64_t key = (view_number_ << 32U) | (number + 1);
  Echo& echo = echoes_[number % kEchoes];
  if (echo.key != key) echo = find(sweep, ray, scatterer, key);
  if (!(echo.distance_m < sweep.geometry.range.metres())) return;
  const auto extent_m = static_cast<double>(scatterer.extent_m);
  const double offset_rad = wrapped_rad(echo.azimuth_rad - sweep.azimuth_rad);
  const double gain = physics::point_azimuth_gain(sweep.geometry.sharpened_cell, sweep.receiver.azimuth_beamwidth_rad,
                                                  offset_rad, extent_m * echo.per_metre);
  const auto is_negligible = [&] { return echo.power >= 0.0 && gain * echo.power <= sweep.negligible; };
  if (!(gain > 0.0) || is_negligible()) return;
  const Neighbours rays = rays_at(offset_rad);
  const Target target{echo.distance_m, echo.per_metre, echo.tangent, static_cast<double>(scatterer.middle_msl_m)};
  const auto lit_by = [&](std::size_t number_of_ray) {
    const Seen seen = seen_by(rays_[number_of_ray], target, echo.nearer);
    echo.nearer = seen.nearer;
    return lit_fraction(sweep, scatterer, seen);
  };
  double lit = lit_by(rays.left);
  if (rays.right_weight > 0.0) lit += rays.right_weight * (lit_by(rays.right) - lit);
  if (!(lit > 0.0)) return;
  if (echo.power < 0.0) echo.power = power_of(sweep, ray, level, scatterer, echo);
  // Whether the power was known before must not change the sweep.
  if (is_negligible()) return;
  spread(*rays_[rays.nearest()].ground, echo, extent_m, sweep.point_smear_gain * lit * gain * echo.power);
}

// Earth and sight are those in the scatterer's own azimuth, so that they are the same in each sweep.
PointReturn::Echo PointReturn::find(const Sweep& sweep, const SceneRay::InScene& ray, const scene::Scatterer& scatterer,
                                    std::uint64_t key) const {
  const geo::Vector3 at{static_cast<double>(scatterer.east_m), static_cast<double>(scatterer.north_m),
                        static_cast<double>(scatterer.up_m)};
  const geo::Vector3 to_point = at - ray.apex;
  const double chord2 = dot(to_point, to_point);
  Echo echo{key};
  echo.azimuth_rad = std::atan2(dot(to_point, ray.east), dot(to_point, ray.north));
  const geo::Bearing azimuth = geo::Bearing::radians(echo.azimuth_rad);
  const double radius_m = geo::radius_of_curvature(sweep.geometry.apex.latitude_deg, azimuth).metres();
  // Length of the arc over the chord, to the third order.
  echo.distance_m = std::sqrt(chord2) * (1.0 + chord2 / (24.0 * radius_m * radius_m));
  echo.per_metre = 1.0 / echo.distance_m;
  const auto middle_m = static_cast<double>(scatterer.middle_msl_m);
  const physics::EffectiveEarth earth =
      physics::effective_earth(parameters_, sweep.geometry.apex, sweep.geometry.altitude, azimuth);
  echo.tangent = earth.tangent(sweep.geometry.altitude.metres(), echo.distance_m, middle_m);
  echo.nearer = physics::samples_nearer(distance_m_, echo.distance_m);
  echo.shown_m = parameters_.slant_range
                     ? earth.slant_range_m(sweep.geometry.altitude.metres(), echo.distance_m, middle_m)
                     : echo.distance_m;
  echo.power = -1.0;
  return echo;
}

double PointReturn::power_of(const Sweep& sweep, const SceneRay::InScene& ray, const scene::ScattererLevel& level,
                             const scene::Scatterer& scatterer, const Echo& echo) const {
  const double altitude_m = sweep.geometry.altitude.metres();
  const auto middle_m = static_cast<double>(scatterer.middle_msl_m);
  const physics::EffectiveEarth earth = physics::effective_earth(
      parameters_, sweep.geometry.apex, sweep.geometry.altitude, geo::Bearing::radians(echo.azimuth_rad));
  const physics::Sight sight = earth.sight(altitude_m, echo.distance_m, middle_m);
  const double gain = physics::two_way_gain(beam_, sweep.receiver.elevation_beamwidth_rad,
                                            sweep.geometry.elevation.radians(), sight.elevation_rad);
  const double loss = gas_.two_way_transmission(earth, altitude_m, echo.distance_m, middle_m);
  const double lobes = movers_.sea_mirror().works() ? lobe_factor(sweep, scatterer, echo, earth) : 1.0;
  return physics::received(
      sweep.receiver,
      physics::returned_power(cross_section_m2(level, scatterer, ray, sight), lobes * loss * gain, sight.slant_range_m),
      sight.slant_range_m);
}

// Only a scatterer over water has lobes. `water` of its own position stands for that of the reflection.
double PointReturn::lobe_factor(const Sweep& sweep, const scene::Scatterer& scatterer, const Echo& echo,
                                const physics::EffectiveEarth& earth) const {
  const geo::GeoPoint position = geo::geodesic_direct(sweep.geometry.apex, geo::Bearing::radians(echo.azimuth_rad),
                                                      geo::Length::metres(echo.distance_m));
  const terrain::Surface below = sweep.environment.terrain.surface_at(position, radar::Interpolation::nearest);
  if (!(below.water > 0.5)) return 1.0;
  const double sea_m = std::isnan(below.elevation_m) ? 0.0 : below.elevation_m;
  const double low_m = std::max(0.0, static_cast<double>(scatterer.min_msl_m) - sea_m);
  const double high_m = std::max(low_m, static_cast<double>(scatterer.max_msl_m) - sea_m);
  return movers_.sea_mirror().lobe_factor(earth, sweep.geometry.altitude.metres(), echo.distance_m,
                                          0.5 * (low_m + high_m), high_m - low_m);
}

double PointReturn::cross_section_m2(const scene::ScattererLevel& level, const scene::Scatterer& scatterer,
                                     const SceneRay::InScene& ray, const physics::Sight& sight) const {
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

// Fraction [0, 1] of a scatterer's vertical extent that is above the horizon of all nearer ground.
double PointReturn::lit_fraction(const Sweep& sweep, const scene::Scatterer& scatterer, const Seen& seen) const {
  const double lowest = seen.tangent_of(static_cast<double>(scatterer.min_msl_m));
  const double highest = seen.tangent_of(static_cast<double>(scatterer.max_msl_m));
  // If ground up to the last nearer sample hides the scatterer, the path beyond that sample need not be tested.
  if (seen.nearer > 0 && highest <= seen.ground.samples[seen.nearer - 1].horizon) return 0.0;
  const double horizon = horizon_before(sweep, seen);
  if (horizon >= highest) return 0.0;
  return horizon <= lowest ? 1.0 : (highest - horizon) / (highest - lowest);
}

// Adds the power of a target to a sample. A number of samples past the last one is ignored.
void PointReturn::put(const RayGround& ground, std::size_t sample, double power) {
  if (sample >= points_.size()) return;
  points_[sample] += ground.transmission.empty() ? power : power * ground.transmission[sample];
  first_ = std::min(first_, sample);
  end_ = std::max(end_, sample + 1);
}

// Distributes power evenly over the interval of length `extent_m` about the echo's range. Each sample gets the part
// of the interval that is nearer to its centre than to the centre of any other sample.
void PointReturn::spread(const RayGround& ground, const Echo& echo, double extent_m, double power) {
  const double from_m = echo.shown_m - 0.5 * extent_m, to_m = echo.shown_m + 0.5 * extent_m;
  const std::size_t first = physics::nearest_sample(distance_m_, from_m, echo.nearer);
  const std::size_t last = std::min(physics::nearest_sample(distance_m_, to_m, echo.nearer), distance_m_.size() - 1);
  if (first >= last) return put(ground, first, power);
  const double power_per_m = power / extent_m;
  double begin_m = from_m;
  for (std::size_t i = first; i <= last; ++i) {
    const double end_m = i == last ? to_m : 0.5 * (distance_m_[i] + distance_m_[i + 1]);
    put(ground, i, power_per_m * (end_m - begin_m));
    begin_m = end_m;
  }
}

// Spreads the power of the targets over the pulse, and adds it to the samples.
void PointReturn::smear_into(std::span<float> power, std::vector<physics::SteadyPower>* steady) {
  if (first_ >= end_) return;
  const auto reach = static_cast<std::size_t>(smear_.reach);
  const std::size_t begin = first_ - std::min(first_, reach), end = std::min(end_ + reach, power.size());
  for (std::size_t i = first_; i < end_; ++i) {
    if (points_[i] == 0.0) continue;
    const std::size_t from = std::max(i, reach) - reach, to = std::min(i + reach + 1, power.size());
    for (std::size_t j = from; j < to; ++j) smeared_[j] += smear_.weights[j + reach - i] * points_[i];
    points_[i] = 0.0;
  }
  for (std::size_t i = begin; i < end; ++i) {
    const auto added = static_cast<float>(smeared_[i]);
    power[i] += added;
    if (steady != nullptr && added > 0.0F) steady->push_back({static_cast<std::uint32_t>(i), added});
    smeared_[i] = 0.0;
  }
  first_ = points_.size();
  end_ = 0;
}

}  // namespace yars::model::rbm
