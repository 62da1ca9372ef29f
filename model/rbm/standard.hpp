// The default algorithm: float, by vectors of whatever width the machine has. Positions come from a series of the
// geodesic (ray.hpp), curvature from the first terms of its own. Bound against Reference, without noise:
// shadow differs in at most 0.5 % of the samples, video by 0.5 gray levels RMS (tests/model/rbm/standard_test.cpp).
// Equal bits for any number of threads and any width.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "lib/radar/configuration.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/environment.hpp"
#include "model/physics/ground_return.hpp"
#include "model/physics/ray.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/line_of_sight.hpp"
#include "model/rbm/scene_return.hpp"
#include "model/rbm/sweep_simd.hpp"

namespace yars::model::rbm {

class Standard : public Algorithm {
 public:
  explicit Standard(const radar::RadarConfiguration& configuration);

  std::size_t measure(const physics::SweepGeometry& look, const physics::Environment& database,
                      std::span<float> power) override;
  void lit(std::span<std::uint8_t> mask) const override;
  void form_video(const physics::PowerWindow& window, geo::Length range, int gain, const physics::NoiseKey& key,
                  std::span<std::uint8_t> video) override;

 private:
  // Entries for `samples` and kPad either side.
  struct Padded {
    Padded(std::size_t samples, float fill) : values(samples + 2 * simd::kPad, fill) {}
    float* data() { return values.data() + simd::kPad; }
    const float* data() const { return values.data() + simd::kPad; }
    std::span<float> first(std::size_t count) { return {data(), count}; }
    memory::LineVector<float> values;
  };

  void place_samples(const physics::SweepGeometry& look, const physics::EffectiveEarth& earth,
                     const terrain::TerrainView& terrain);
  std::size_t read_terrain(const physics::SweepGeometry& look, const terrain::TerrainView& terrain);
  void add_movers(const physics::SweepGeometry& look, const physics::GroundWalk& walk,
                  const physics::Receiver& receiver, const physics::Environment& database, double pulse_samples);
  void add_rain(const physics::SweepGeometry& look, const physics::EffectiveEarth& earth,
                const physics::Receiver& receiver);
  void see_scenes(const physics::SweepGeometry& look, const physics::GroundWalk& walk,
                  const physics::Receiver& receiver, const scene::SceneView& scenes, double pulse_samples);
  void attenuate(const physics::SweepGeometry& look);
  void read_cross_slopes(const physics::SweepGeometry& look, const terrain::TerrainView& terrain);
  simd::SweepConstants sweep_constants(const physics::SweepGeometry& look, const physics::EffectiveEarth& earth,
                                       const physics::Receiver& receiver) const;

  const physics::Receiver& receiver_at(geo::Length range);
  void use_cells(float cells_per_sample);

  radar::RadarConfiguration configuration_;
  physics::Ground ground_;
  physics::RainPath rain_;
  physics::GasPath gas_;
  physics::GasSamples gas_samples_;
  physics::Movers movers_;
  SceneReturn scene_return_;
  physics::Receiver receiver_;  // of the range last asked for
  std::size_t count_;
  std::size_t holes_ = 0;         // first samples that nothing is near enough for (slant range)
  double spaced_range_m_ = 0.0;   // range that the distances are for; 0: none yet
  double smeared_samples_ = 0.0;  // pulse that the weights are for; 0: none yet
  std::ptrdiff_t smear_reach_ = 0;
  float cells_per_sample_ = 0.0F;  // that the cells are for; 0: none yet
  std::array<float, 2 * physics::PulseSmear::kMaxReach + 1> smear_weights_{};
  std::vector<double> distance_m_;
  Padded distance_, one_step_inverse_, two_step_inverse_;
  physics::PlaceArrays places_;
  RayCrests ray_crests_;
  Padded elevation_, water_, peak_, side_, crest_, cross_slope_;
  Padded tangent_, before_, horizon_;
  Padded power_, variate_;
  memory::LineVector<std::int32_t> cell_;  // of resolution, that each sample lies in
};

}  // namespace yars::model::rbm
