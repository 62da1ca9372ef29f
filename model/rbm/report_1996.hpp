// The picture as the 1996 report makes it, where the report is silent as docs/spec/physics.md#preset-1996 defines it:
// intensity is the cosine between facet normal and direction to the radar, both in the plane of the sweep; flat earth,
// no refraction; nothing outside half a beam width of the antenna's elevations, those of all bars; a horizon that lit
// posts alone raise; weights 1/4 1/2 1/4 over three posts and over three sweeps; gain steps 1/4 1/2 3/4 1; no noise.
// Power is intensity over that of level ground at sea level at half the selected range; video is proportional to it,
// white from 1 on. Why: docs/decisions/0020. Only samples and beam width are read from the configuration.
#pragma once

#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/physics/ray.hpp"
#include "model/rbm/algorithm.hpp"

namespace yars::model::rbm {

class Report1996 : public Algorithm {
 public:
  explicit Report1996(const radar::RadarConfiguration& configuration);

  std::size_t measure(const physics::SweepGeometry& look, const physics::Environment& database,
                      std::span<float> power) override;
  void lit(std::span<std::uint8_t> mask) const override;
  void form_video(const physics::PowerWindow& window, geo::Length range, int gain, const physics::NoiseKey& key,
                  std::span<std::uint8_t> video) override;

 private:
  float slope(std::size_t index, float spacing_m) const;

  double half_beam_rad_;
  int knots_;
  radar::Interpolation interpolation_;
  std::size_t count_;
  std::vector<float> distance_m_;
  physics::PlaceArrays places_;
  std::vector<float> elevation_m_, water_;  // and terrain::kRunSlack more
  std::vector<float> intensity_;
  std::vector<std::uint8_t> lit_;
};

}  // namespace yars::model::rbm
