#include "model/rbm/beam.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/radar/fidelity.hpp"
#include "lib/radar/world.hpp"
#include "model/physics/clutter.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/texture.hpp"
#include "model/rbm/reference.hpp"
#include "model/rbm/report_1996.hpp"
#include "model/rbm/standard.hpp"

namespace yars::model::rbm {

namespace {
// [samples] A ray is used again within this distance of the position from which it was measured.
constexpr double kMaxMove = 0.5;
// [rays] A number of rays around the horizon that exceeds a whole number by less than this, by rounding, is that
// number.
constexpr double kRounding = 1e-6;
}  // namespace

Beam::Beam(const physics::RadarParameters& parameters) : Beam(make_algorithm(parameters), parameters) {}

Beam::Beam(std::unique_ptr<Algorithm> algorithm, const physics::RadarParameters& parameters)
    : algorithm_(std::move(algorithm)),
      receivers_(parameters),
      pattern_(parameters.beam),
      beamwidth_deg_(parameters.azimuth_beamwidth_deg) {
  if (algorithm_->has_points()) points_.emplace(parameters);
  const int count = std::clamp(parameters.fidelity.sub_beams, 1, radar::kMaxSubBeams);
  // Rays fit into the circle, so their spacing is at most the bundle's width over their number.
  circle_ = static_cast<int>(std::ceil(360.0 * count / (kSubBeamsWidth * beamwidth_deg_) - kRounding));
  const std::size_t kept = count > 1 ? static_cast<std::size_t>(count) + 2 : 1;
  rays_.reserve(kept);
  while (rays_.size() < kept) rays_.emplace_back(sample_count(parameters));
  beam_.reserve(rays_.size());
  weighted_.reserve(rays_.size());
  grounds_.reserve(rays_.size());
  steady_.reserve(sample_count(parameters));
  // Computed here, so that no sweep has to.
  if (parameters.fidelity.noise)
    for (int looks = 1; looks <= physics::kMaxLooks; ++looks) physics::speckle_levels(looks);
}

void Beam::use_world(const physics::RadarParameters& parameters, const radar::WorldChanges& changes) {
  if (changes.movers && points_) points_->use_movers(parameters);
  if (changes.sea && points_) points_->use_sea(parameters);
  if (!changes.sea && !changes.rain) return;
  algorithm_->use_weather(parameters);
  for (Ray& ray : rays_) ray.current = false;
}

double Beam::automatic_gain_db(const physics::SweepGeometry& geometry) {
  if (receiver_.range_m != geometry.range.metres()) receiver_ = receivers_.at(geometry.range);
  return physics::automatic_gain_db(receiver_, pattern_, geometry.altitude, geometry.elevation);
}

int Beam::looks(const physics::SweepGeometry& geometry, geo::Speed ground_speed, geo::Bearing ground_track) {
  if (receiver_.range_m != geometry.range.metres()) receiver_ = receivers_.at(geometry.range);
  const std::optional<physics::AzimuthInterval>& cell = geometry.sharpened_cell;
  const double width_rad = cell ? cell->right_rad - cell->left_rad : receiver_.azimuth_beamwidth_rad;
  return physics::looks_of(receiver_, width_rad, cell ? receiver_.sharpened_dwell_s : receiver_.dwell_s, ground_speed,
                           geometry.azimuth - ground_track);
}

void Beam::begin_pass() {
  for (Ray& ray : rays_) ray.current = false;
  measured_ = 0;
}

// Selects the rays in the beam of a sweep and their weights.
void Beam::set_beam(geo::Bearing azimuth) {
  const double spacing_deg = 360.0 / circle_;
  const double half_span_deg = 0.5 * kSubBeamsWidth * beamwidth_deg_;
  const auto offset_deg = [&](int number) { return number * spacing_deg - azimuth.degrees(); };
  const int first = static_cast<int>(std::ceil((azimuth.degrees() - half_span_deg) / spacing_deg));
  int last = first;
  while (offset_deg(last + 1) < half_span_deg && last + 2 - first < static_cast<int>(rays_.size())) ++last;
  beam_.clear();
  double sum = 0.0;
  for (int number = first; number <= last; ++number) {
    const double offset = offset_deg(number) / beamwidth_deg_;
    beam_.push_back({&ray_of(number, first, last), offset, std::exp(-physics::kTwoWayExponent * offset * offset)});
    sum += beam_.back().weight;
  }
  for (Member& member : beam_) member.weight /= sum;
}

// The ray of a number: the one that is kept, else one that is not among `first` to `last`. Numbers wrap at north.
Beam::Ray& Beam::ray_of(int number, int first, int last) {
  const auto wrapped = [this](int any) { return (any % circle_ + circle_) % circle_; };
  Ray* unused = &rays_.front();
  for (Ray& ray : rays_) {
    if (ray.number == wrapped(number)) return ray;
    if (ray.number < 0 || wrapped(ray.number - first) > last - first) unused = &ray;
  }
  unused->number = wrapped(number);
  unused->current = false;
  return *unused;
}

bool Beam::is_current(const Ray& ray, const physics::SweepGeometry& geometry, bool with_points) const {
  if (!ray.current || (with_points && !ray.described)) return false;
  const physics::SweepGeometry& then = ray.ground.geometry;
  const auto [north_m, east_m, up_m] = physics::displacement(then, geometry);
  const double max_move_m = kMaxMove * geometry.range.metres() / static_cast<double>(ray.lit.size());
  return then.elevation.radians() == geometry.elevation.radians() && then.range.metres() == geometry.range.metres() &&
         then.bars_above.radians() == geometry.bars_above.radians() &&
         then.bars_below.radians() == geometry.bars_below.radians() &&
         std::abs((geometry.sim_time - then.sim_time).seconds()) <= kRayLifetime.seconds() &&
         physics::sea_texture_time(geometry.sim_time) == physics::sea_texture_time(then.sim_time) &&
         north_m * north_m + east_m * east_m + up_m * up_m <= max_move_m * max_move_m;
}

void Beam::measure_ray(Ray& ray, const physics::SweepGeometry& geometry, const physics::Environment& environment,
                       bool with_points) {
  ray.ground.geometry = geometry;
  ray.ground.geometry.azimuth = geo::Bearing::degrees(ray.number * (360.0 / circle_));
  ray.pending = algorithm_->measure(ray.ground.geometry, environment, {ray.power.data(), ray.lit.size()});
  algorithm_->lit(ray.lit);
  ray.described = with_points;
  if (with_points) algorithm_->describe(ray.ground);
  ray.current = true;
  ++measured_;
}

std::size_t Beam::measure_members(const physics::SweepGeometry& geometry, const physics::Environment& environment,
                                  bool with_points, std::span<float> power) {
  set_beam(geometry.azimuth);
  std::size_t pending = 0;
  weighted_.clear();
  for (const Member& member : beam_) {
    if (!is_current(*member.ray, geometry, with_points)) measure_ray(*member.ray, geometry, environment, with_points);
    pending += member.ray->pending;
    weighted_.push_back({member.ray->power.data(), static_cast<float>(member.weight)});
    grounds_.push_back(&member.ray->ground);
  }
  simd::weighted_sum(power.size(), weighted_, power.data());
  return pending;
}

std::size_t Beam::measure(const physics::SweepGeometry& geometry, const physics::Environment& environment,
                          std::span<float> power) {
  const bool with_points = points_ && points_->may_return(geometry, environment);
  std::size_t pending = 0;
  grounds_.clear();
  if (rays_.size() > 1) {
    pending = measure_members(geometry, environment, with_points, power);
  } else {
    RayGround& ground = rays_.front().ground;
    pending = algorithm_->measure(geometry, environment, power);
    ++measured_;
    ground.geometry = geometry;
    if (with_points) algorithm_->describe(ground);
    grounds_.push_back(&ground);
  }
  steady_.clear();
  if (with_points) points_->add(geometry, environment, grounds_, power, steady_);
  return pending;
}

void Beam::lit(std::span<std::uint8_t> mask) const {
  if (rays_.size() == 1) return algorithm_->lit(mask);
  const auto off = [](const Member& member) { return std::abs(member.offset); };
  const auto nearest =
      std::min_element(beam_.begin(), beam_.end(), [&](const Member& a, const Member& b) { return off(a) < off(b); });
  std::copy(nearest->ray->lit.begin(), nearest->ray->lit.end(), mask.begin());
}

std::unique_ptr<Algorithm> make_algorithm(const physics::RadarParameters& parameters) {
  switch (parameters.algorithm) {
    case radar::Algorithm::reference:
      return std::make_unique<Reference>(parameters);
    case radar::Algorithm::report_1996:
      return std::make_unique<Report1996>(parameters);
    case radar::Algorithm::standard:
      break;
  }
  return std::make_unique<Standard>(parameters);
}

}  // namespace yars::model::rbm
