// The default algorithm: float, by vectors of whatever width the machine has. Positions come from a series of the
// geodesic (ray.hpp), curvature from the first terms of its own. Bound against Reference, without noise:
// shadow differs in at most 0.5 % of the samples, video by 0.5 gray levels RMS (tests/model/standard_test.cpp). Equal
// bits for any number of threads and any width.
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

  std::size_t measure(const Look& look, const Database& database, std::span<float> power) override;
  void lit(std::span<std::uint8_t> mask) const override;
  void develop(const PowerWindow& window, geo::Length range, int gain, const NoiseKey& key,
               std::span<std::uint8_t> video) override;

 private:
  // Entries for `samples` and kPad either side.
  struct Padded {
    Padded(std::size_t samples, float fill) : values(samples + 2 * lanes::kPad, fill) {}
    float* data() { return values.data() + lanes::kPad; }
    const float* data() const { return values.data() + lanes::kPad; }
    std::span<float> first(std::size_t count) { return {data(), count}; }
    memory::LineVector<float> values;
  };

  void place_samples(const Look& look, const EffectiveEarth& earth, const terrain::TerrainView& terrain);
  std::size_t read_terrain(const Look& look, const terrain::TerrainView& terrain);
  void add_movers(const Look& look, const GroundWalk& walk, const Receiver& receiver, const Database& database,
                  double pulse_samples);
  void add_rain(const Look& look, const EffectiveEarth& earth, const Receiver& receiver);
  void see_scenes(const Look& look, const GroundWalk& walk, const Receiver& receiver, const scene::SceneView& scenes,
                  double pulse_samples);
  void attenuate(const Look& look);
  void read_cross_slopes(const Look& look, const terrain::TerrainView& terrain);
  lanes::SweepConstants sweep_constants(const Look& look, const EffectiveEarth& earth, const Receiver& receiver) const;

  const Receiver& receiver_at(geo::Length range);
  void use_cells(float cells_per_sample);

  radar::RadarConfiguration configuration_;
  Ground ground_;
  RainPath rain_;
  GasPath gas_;
  GasSamples gas_samples_;
  Movers movers_;
  SceneReturn scene_return_;
  Receiver receiver_;  // of the range last asked for
  std::size_t count_;
  std::size_t holes_ = 0;         // first samples that nothing is near enough for (slant range)
  double spaced_range_m_ = 0.0;   // range that the distances are for; 0: none yet
  double smeared_samples_ = 0.0;  // pulse that the weights are for; 0: none yet
  std::ptrdiff_t smear_reach_ = 0;
  float cells_per_sample_ = 0.0F;  // that the cells are for; 0: none yet
  std::array<float, 2 * PulseSmear::kMostReach + 1> smear_weights_{};
  std::vector<double> distance_m_;
  Padded distance_, one_step_inverse_, two_step_inverse_;
  PlaceArrays places_;
  RayCrests ray_crests_;
  Padded elevation_, water_, peak_, side_, crest_, cross_slope_;
  Padded tangent_, before_, horizon_;
  Padded power_, variate_;
  memory::LineVector<std::int32_t> cell_;  // of resolution, that each sample lies in
};

}  // namespace yars::model::rbm
