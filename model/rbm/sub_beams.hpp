// The algorithm that a configuration names, and several rays across the beam around it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "model/rbm/algorithm.hpp"

namespace yars::model::rbm {

// Several rays across the beam in azimuth, joined by its two-way pattern: what the beam sees of ground that changes
// within its width. Around any algorithm; its power is that of one ray of the joined gain, conserved over uniform
// ground.
class SubBeams : public Algorithm {
 public:
  SubBeams(std::unique_ptr<Algorithm> ray, const radar::RadarConfiguration& configuration);

  std::size_t measure(const physics::SweepGeometry& look, const physics::Environment& database,
                      std::span<float> power) override;
  void lit(std::span<std::uint8_t> mask) const override;
  void form_video(const physics::PowerWindow& window, geo::Length range, int gain, const physics::NoiseKey& key,
                  std::span<std::uint8_t> video) override;

 private:
  struct Ray {
    geo::Angle offset;        // from the beam's centre
    float weight;             // their sum is 1
    physics::BeamSlice share;  // of points: those nearest to this ray
  };
  std::unique_ptr<Algorithm> ray_;
  std::vector<Ray> rays_;
  std::vector<float> power_;
  std::vector<std::uint8_t> lit_;  // of the middle ray
};

// The algorithm that the fidelity names. Samples are clamped to [1, kMaxSamples].
std::unique_ptr<Algorithm> make_algorithm(const radar::RadarConfiguration& configuration);

}  // namespace yars::model::rbm
