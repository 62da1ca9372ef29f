// The default algorithm: plain float C++ whose loops the compiler vectorizes. Positions come from five exact points of
// the geodesic a sweep, curvature from the first terms of its series. Bound against Reference, without noise: shadow
// differs in at most 0.1 % of the samples, video by 1 gray level RMS (tests/model/standard_test.cpp). Equal bits for
// any number of threads and lanes.
#pragma once

#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/earth.hpp"
#include "model/rbm/receiver.hpp"
#include "model/rbm/standard_loops.hpp"

namespace yars::model::rbm {

class Standard : public Algorithm {
 public:
  explicit Standard(const radar::RadarConfiguration& configuration);

  std::size_t measure(const Look& look, const terrain::TerrainView& terrain, std::span<float> power) override;
  void develop(const PowerWindow& window, geo::Length range, int gain, const NoiseKey& key,
               std::span<std::uint8_t> video) override;

 private:
  // Entries for `samples` and kPad either side, and what the last block of the running maximum overhangs.
  struct Padded {
    explicit Padded(std::size_t samples, float fill) : values(samples + 2 * loops::kPad, fill) {}
    float* data() { return values.data() + loops::kPad; }
    std::vector<float> values;
  };

  std::size_t read_terrain(const Look& look, const terrain::TerrainView& terrain);
  void read_cross_slopes(const Look& look, const terrain::TerrainView& terrain);
  loops::SweepConstants sweep_constants(const Look& look, const EffectiveEarth& earth, const Receiver& receiver) const;
  void apply_beam(const loops::SweepConstants& constants, const loops::SightArrays& sights);

  const Receiver& receiver_at(geo::Length range);

  radar::RadarConfiguration configuration_;
  Receiver receiver_;  // of the range last asked for
  std::size_t count_;
  std::vector<double> distance_m_, latitude_deg_, longitude_deg_;
  Padded distance_, elevation_, water_, side_, cross_slope_;
  Padded tangent_, spare_, horizon_;
  Padded range_inverse_, sin_grazing_, cos_grazing_, sin_sight_, cos_sight_;
  Padded sin_local_, gain_, power_;
};

}  // namespace yars::model::rbm
