#include "model/rbm/sub_beams.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lib/geo/earth.hpp"
#include "lib/radar/fidelity.hpp"
#include "model/physics/receiver.hpp"
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
constexpr physics::BeamSlice kNoPoints{.left_rad = 0.0, .right_rad = 0.0};

// Square of the distance between the aircraft's positions in two sweeps.
double squared_distance_m2(const physics::SweepGeometry& from, const physics::SweepGeometry& to) {
  constexpr double kMetresPerDegree = geo::kMeanEarthRadius_m * geo::kRadiansPerDegree;
  const double north_m = kMetresPerDegree * (to.apex.latitude_deg - from.apex.latitude_deg);
  const double east_m = kMetresPerDegree * geo::wrapped_degrees(to.apex.longitude_deg - from.apex.longitude_deg) *
                        std::cos(to.apex.latitude_deg * geo::kRadiansPerDegree);
  const double up_m = to.altitude.metres() - from.altitude.metres();
  return north_m * north_m + east_m * east_m + up_m * up_m;
}
}  // namespace

SubBeams::SubBeams(std::unique_ptr<Algorithm> ray, const physics::RadarParameters& parameters)
    : ray_(std::move(ray)), beamwidth_deg_(parameters.azimuth_beamwidth_deg) {
  const int count = std::clamp(parameters.fidelity.sub_beams, 1, radar::kMaxSubBeams);
  // Rays fit into the circle, so their spacing is at most the bundle's width over their number.
  circle_ = static_cast<int>(std::ceil(360.0 * count / (kSubBeamsWidth * beamwidth_deg_) - kRounding));
  point_stride_ = static_cast<std::size_t>((count + kPointRays - 1) / kPointRays);
  const std::size_t samples = sample_count(parameters);
  Ray empty;
  empty.power.resize(samples + simd::kPad);
  empty.lit.resize(samples);
  rays_.resize(static_cast<std::size_t>(count) + 2, empty);
  point_rays_.resize(rays_.size() / point_stride_ + 1, empty);
  beam_.reserve(rays_.size());
  weighted_.reserve(rays_.size());
}

void SubBeams::begin_pass() {
  for (Ray& ray : rays_) ray.current = false;
}

// Selects the rays in the beam of a sweep and their weights.
void SubBeams::set_beam(geo::Bearing azimuth) {
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
    beam_.push_back({&ray_of(number, first, last), offset_deg(number) * geo::kRadiansPerDegree,
                     std::exp(-physics::kTwoWayExponent * offset * offset)});
    sum += beam_.back().weight;
  }
  for (Member& member : beam_) member.weight /= sum;
}

// The ray of a number: the one that is kept, else one that is not among `first` to `last`. Numbers wrap at north.
SubBeams::Ray& SubBeams::ray_of(int number, int first, int last) {
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

bool SubBeams::is_current(const Ray& ray, const physics::SweepGeometry& geometry) const {
  if (!ray.current) return false;
  const physics::SweepGeometry& then = ray.geometry;
  const double max_move_m = kMaxMove * geometry.range.metres() / static_cast<double>(ray.lit.size());
  return then.elevation.radians() == geometry.elevation.radians() && then.range.metres() == geometry.range.metres() &&
         then.bars_above.radians() == geometry.bars_above.radians() &&
         then.bars_below.radians() == geometry.bars_below.radians() &&
         std::abs((geometry.sim_time - then.sim_time).seconds()) <= kRayLifetime.seconds() &&
         squared_distance_m2(then, geometry) <= max_move_m * max_move_m;
}

// Azimuths at which a ray with points collects them.
physics::BeamSlice SubBeams::slice_of(std::size_t member) const {
  const double half_width_rad = static_cast<double>(point_stride_) * std::numbers::pi / circle_;
  physics::BeamSlice slice;
  if (member >= point_stride_) slice.left_rad = -half_width_rad;
  if (member + point_stride_ < beam_.size()) slice.right_rad = half_width_rad;
  slice.beam_rad = -beam_[member].offset_rad;
  slice.factor = 1.0 / beam_[member].weight;
  return slice;
}

void SubBeams::measure_ray(Ray& ray, const physics::SweepGeometry& geometry, const physics::Environment& environment) {
  ray.geometry = geometry;
  ray.pending = ray_->measure(geometry, environment, {ray.power.data(), ray.lit.size()});
  ray_->lit(ray.lit);
}

// Makes the ray of a member current, or replaces it by one with points.
void SubBeams::measure_member(std::size_t member, const physics::SweepGeometry& geometry,
                              const physics::Environment& environment, bool points_in_beam) {
  Ray& ray = *beam_[member].ray;
  physics::SweepGeometry ray_geometry = geometry;
  ray_geometry.azimuth = geo::Bearing::degrees(ray.number * (360.0 / circle_));
  if (points_in_beam && member % point_stride_ == point_stride_ / 2) {
    ray_geometry.slice = slice_of(member);
    if (ray_->has_points(ray_geometry, environment)) {
      beam_[member].ray = &point_rays_[member / point_stride_];
      return measure_ray(*beam_[member].ray, ray_geometry, environment);
    }
  }
  if (is_current(ray, geometry)) return;
  ray_geometry.slice = kNoPoints;
  measure_ray(ray, ray_geometry, environment);
  ray.current = true;
}

std::size_t SubBeams::measure(const physics::SweepGeometry& geometry, const physics::Environment& environment,
                              std::span<float> power) {
  set_beam(geometry.azimuth);
  const bool points = ray_->has_points(geometry, environment);
  std::size_t pending = 0;
  for (std::size_t member = 0; member < beam_.size(); ++member) {
    measure_member(member, geometry, environment, points);
    pending += beam_[member].ray->pending;
  }
  weighted_.clear();
  for (const Member& member : beam_) weighted_.push_back({member.ray->power.data(), static_cast<float>(member.weight)});
  simd::weighted_sum(power.size(), weighted_, power.data());
  return pending;
}

void SubBeams::lit(std::span<std::uint8_t> mask) const {
  const auto nearest = std::min_element(beam_.begin(), beam_.end(), [](const Member& a, const Member& b) {
    return std::abs(a.offset_rad) < std::abs(b.offset_rad);
  });
  const std::vector<std::uint8_t>& lit = nearest->ray->lit;
  std::copy_n(lit.begin(), std::min(lit.size(), mask.size()), mask.begin());
}

bool SubBeams::has_points(const physics::SweepGeometry& geometry, const physics::Environment& environment) {
  return ray_->has_points(geometry, environment);
}

void SubBeams::form_video(const physics::PowerWindow& window, geo::Length range, int gain, const physics::NoiseKey& key,
                          std::span<std::uint8_t> video) {
  ray_->form_video(window, range, gain, key, video);
}

namespace {
std::unique_ptr<Algorithm> make_ray(const physics::RadarParameters& parameters) {
  switch (parameters.fidelity.algorithm) {
    case radar::Algorithm::reference:
      return std::make_unique<Reference>(parameters);
    case radar::Algorithm::report_1996:
      return std::make_unique<Report1996>(parameters);
    case radar::Algorithm::standard:
      break;
  }
  return std::make_unique<Standard>(parameters);
}
}  // namespace

std::unique_ptr<Algorithm> make_algorithm(const physics::RadarParameters& parameters) {
  std::unique_ptr<Algorithm> ray = make_ray(parameters);
  if (parameters.fidelity.sub_beams <= 1) return ray;
  return std::make_unique<SubBeams>(std::move(ray), parameters);
}

}  // namespace yars::model::rbm
