// Default algorithm of the real beam map, in float, with SIMD vectors of the machine's width (library Highway).
// The fidelity's `geodesic_knots` selects how the positions of samples are computed (ray.hpp). The default is a Taylor
// series of the geodesic, replaced near a pole by interpolation between exact positions. The drop of the ground by the
// earth's curvature is a truncated series (sweep_simd.cpp).
// Accuracy against Reference, without noise: shadow differs in at most 0.5 % of the samples. Over test hills, video
// differs by at most 0.5 of 255 gray levels RMS. Over real terrain, samples with different shadow increase this
// difference (tests/model/rbm/standard_test.cpp). Results are equal bit by bit for any number of threads and any vector
// width.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "lib/radar/fidelity.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/ground_return.hpp"
#include "model/physics/rain_simd.hpp"
#include "model/physics/ray.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/line_of_sight.hpp"
#include "model/rbm/scene_ray.hpp"
#include "model/rbm/slant_axis.hpp"
#include "model/rbm/sweep_simd.hpp"

namespace yars::model::rbm {

class Standard : public Algorithm {
 public:
  explicit Standard(const physics::RadarParameters& parameters);

  void use_weather(const physics::RadarParameters& parameters) override;
  std::size_t measure(const physics::SweepGeometry& geometry, const physics::Environment& environment,
                      std::span<float> power) override;
  void lit(std::span<std::uint8_t> mask) const override;
  bool has_points() const override { return true; }
  void describe(RayGround& ground) const override;
  void form_video(const physics::PowerWindow& window, geo::Length range, int gain, const physics::NoiseKey& key,
                  std::span<std::uint8_t> video) override;

 private:
  // Array of one value per sample, with kPad more entries before the first sample and kPad after the last.
  struct Padded {
    Padded(std::size_t samples, float fill) : values(samples + 2 * simd::kPad, fill) {}
    float* data() { return values.data() + simd::kPad; }
    const float* data() const { return values.data() + simd::kPad; }
    std::span<float> first(std::size_t count) { return {data(), count}; }
    memory::CacheAlignedVector<float> values;
  };

  void update_distances(geo::Length range);
  std::size_t read_terrain(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain);
  void add_rain(const physics::SweepGeometry& geometry, const physics::EffectiveEarth& earth,
                const physics::Receiver& receiver);
  void add_covers(const physics::SweepGeometry& geometry, const scene::SceneView& scenes);
  bool is_straight(std::size_t i, const float* peak_m) const;
  physics::GasSamples::Coefficients gas_loss(const physics::SweepGeometry& geometry);
  simd::SweepConstants sweep_constants(const physics::SweepGeometry& geometry, const physics::EffectiveEarth& earth,
                                       const physics::Receiver& receiver) const;

  const physics::Receiver& receiver_at(geo::Length range);
  const float* time_control(const physics::Receiver& receiver);
  void hold_steady(const physics::PowerWindow& window, const physics::simd::VideoInputs& inputs);

  radar::Fidelity fidelity_;
  physics::GeometryParameters geometry_parameters_;
  physics::Receivers receivers_;
  physics::Ground ground_;
  physics::RainSamples rain_;
  physics::GasPath gas_;
  physics::GasSamples gas_samples_;
  SceneCovers scene_covers_;
  SlantAxis slant_axis_;
  physics::Receiver receiver_;  // result of the last receiver_at()
  std::size_t count_;
  float max_straight_m_;             // distance between samples up to which ground may be straight for point targets
  bool has_crests_ = false;          // crest_ is that of the sweep
  bool has_peaks_ = false;           // peak_ is that of the sweep
  double spaced_range_m_ = 0.0;      // [m] range for which distance_m_ was computed; 0: none
  double controlled_range_m_ = 0.0;  // range for which time_control_ was computed; 0: none
  double smeared_samples_ = -1.0;    // pulse length [samples] of smear_weights_; -1: none
  std::ptrdiff_t smear_reach_ = 0;   // [samples] smear_weights_ has offsets -smear_reach_ to smear_reach_
  std::array<float, 2 * physics::PulseSmear::kMaxRadius + 1> smear_weights_{};
  std::vector<double> distance_m_;
  Padded distance_, one_step_inverse_, midway_weight_, cell_inverse_;
  physics::PositionSampler sampler_;
  physics::PositionArrays positions_;
  RayCrests ray_crests_;
  Padded elevation_, water_, peak_, near_, near_back_, crest_;
  Padded tangent_, near_tangent_, before_, horizon_;
  Padded power_, power_per_gamma_, variate_, time_control_;
  Padded steady_;  // power of point targets; 0 outside hold_steady()
};

}  // namespace yars::model::rbm
