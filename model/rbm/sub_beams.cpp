#include "model/rbm/sub_beams.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/radar/fidelity.hpp"
#include "model/physics/receiver.hpp"
#include "model/rbm/reference.hpp"
#include "model/rbm/report_1996.hpp"
#include "model/rbm/standard.hpp"

namespace yars::model::rbm {

namespace {
// [beamwidths] Half width of the bundle of rays. Outside it the two-way gain is below 5 % of the maximum.
constexpr double kHalfSpan = 0.75;
}  // namespace

SubBeams::SubBeams(std::unique_ptr<Algorithm> ray, const physics::RadarParameters& parameters)
    : ray_(std::move(ray)), power_(sample_count(parameters)), lit_(power_.size()) {
  const int count = std::clamp(parameters.fidelity.sub_beams, 1, radar::kMaxSubBeams);
  double sum = 0.0;
  std::vector<double> weights;
  for (int k = 0; k < count; ++k) {
    // [beamwidths] from the beam's centre. Each ray is at the middle of one of `count` equal parts of the bundle.
    const double offset = kHalfSpan * ((2.0 * k + 1.0) / count - 1.0);
    weights.push_back(std::exp(-physics::kTwoWayExponent * offset * offset));
    sum += weights.back();
    rays_.push_back({geo::Angle::degrees(offset * parameters.azimuth_beamwidth_deg), 0.0F, {}});
  }
  const double half_step_rad = kHalfSpan / count * parameters.azimuth_beamwidth_deg * geo::kRadiansPerDegree;
  for (std::size_t k = 0; k < rays_.size(); ++k) {
    rays_[k].weight = static_cast<float>(weights[k] / sum);
    physics::BeamSlice& slice = rays_[k].slice;
    if (k > 0) slice.left_rad = -half_step_rad;
    if (k + 1 < rays_.size()) slice.right_rad = half_step_rad;
    slice.beam_rad = -rays_[k].offset.radians();
    slice.factor = sum / weights[k];
  }
}

std::size_t SubBeams::measure(const physics::SweepGeometry& geometry, const physics::Environment& environment,
                              std::span<float> power) {
  std::fill(power.begin(), power.end(), 0.0F);
  std::size_t pending = 0;
  for (std::size_t k = 0; k < rays_.size(); ++k) {
    const Ray& ray = rays_[k];
    physics::SweepGeometry ray_geometry = geometry;
    ray_geometry.azimuth = geometry.azimuth + ray.offset;
    ray_geometry.slice = ray.slice;
    pending += ray_->measure(ray_geometry, environment, power_);
    if (k == rays_.size() / 2) ray_->lit(lit_);
    for (std::size_t i = 0; i < power.size(); ++i) power[i] += ray.weight * power_[i];
  }
  return pending;
}

void SubBeams::lit(std::span<std::uint8_t> mask) const {
  std::copy_n(lit_.begin(), std::min(lit_.size(), mask.size()), mask.begin());
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
