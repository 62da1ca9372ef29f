// One way of computing the real beam map, in two halves: measure() turns terrain into power, form_video() turns power
// into video. An instance has scratch memory: one thread at a time. No allocation after construction.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lib/radar/configuration.hpp"
#include "lib/radar/modes.hpp"
#include "model/physics/environment.hpp"
#include "model/physics/sweep_geometry.hpp"

namespace yars::model::rbm {

class Algorithm {
 public:
  Algorithm() = default;
  Algorithm(const Algorithm&) = delete;
  Algorithm& operator=(const Algorithm&) = delete;
  virtual ~Algorithm() = default;

  // Fills `power` (near to far, samples of the fidelity): 1 = full scale, after sensitivity time control and pulse
  // smear, without noise; never NaN, never negative. Returns how many samples met terrain that is not loaded yet.
  virtual std::size_t measure(const physics::SweepGeometry& look, const physics::Environment& database,
                              std::span<float> power) = 0;

  // Of the last measure(): 1 where no nearer ground hides the sample, 0 in shadow, over a void and, by the 1996 report,
  // outside the beam. Of several rays the middle one counts, of two middle ones the right. `mask` as long as the power.
  virtual void lit(std::span<std::uint8_t> mask) const = 0;

  // Azimuth smear, noise, log receiver and gain (0..3): 8-bit video, as long as the power.
  virtual void form_video(const physics::PowerWindow& window, geo::Length range, int gain, const physics::NoiseKey& key,
                          std::span<std::uint8_t> video) = 0;
};

// Samples of a sweep that the configuration gives, clamped.
inline std::size_t sample_count(const radar::RadarConfiguration& configuration) {
  return static_cast<std::size_t>(std::clamp(configuration.fidelity.samples, 1, radar::kMaxSamples));
}

}  // namespace yars::model::rbm
