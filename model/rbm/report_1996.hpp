// Real beam map algorithm of the 1996 report. Intensity is the cosine of the angle between the ground's normal and the
// direction to the radar, both in the vertical plane of the sweep, and at least 0.
// Geometry: flat earth without refraction. Only lit samples raise the horizon. No power is received from more than half
// an elevation beamwidth above the highest bar or below the lowest bar.
// Smear: weights 1/4 1/2 1/4 over three samples and over three sweeps. Gain steps: 1/4 1/2 3/4 1 of full scale. No
// noise.
// Outputs: power is the intensity, smeared over samples, divided by the intensity of level ground at sea level at half
// the selected range. Video is proportional to power up to power 1, and constant above.
// Source: docs/spec/physics.md#preset-1996, docs/decisions/0020-brightness-of-the-preset-1996.md.
// The algorithm uses four values of the configuration: elevation beamwidth, samples, geodesic knots, interpolation.
#pragma once

#include <vector>

#include "lib/radar/modes.hpp"
#include "model/physics/ray.hpp"
#include "model/rbm/algorithm.hpp"

namespace yars::model::rbm {

class Report1996 : public Algorithm {
 public:
  explicit Report1996(const physics::RadarParameters& parameters);

  std::size_t measure(const physics::SweepGeometry& geometry, const physics::Environment& environment,
                      std::span<float> power) override;
  void lit(std::span<std::uint8_t> mask) const override;
  bool has_points() const override { return false; }
  void form_video(const physics::PowerWindow& window, geo::Length range, int gain, const physics::NoiseKey& key,
                  std::span<std::uint8_t> video) override;

 private:
  float slope(std::size_t index, float spacing_m) const;

  double half_beam_rad_;
  int knots_;
  radar::Interpolation interpolation_;
  std::size_t count_;
  std::vector<float> distance_m_;
  physics::PositionSampler sampler_;
  physics::PositionArrays positions_;
  std::vector<float> elevation_m_, water_;  // terrain::kRunSlack entries more than samples
  std::vector<float> intensity_;
  std::vector<std::uint8_t> lit_;
};

}  // namespace yars::model::rbm
