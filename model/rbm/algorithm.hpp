// Interface of the algorithms that make the sweeps of the real beam map. They compute power from terrain, and video
// from power. Video is brightness, 0 to 255.
// An algorithm measures one ray at a time. Beam (beam.hpp) adds several rays and point targets. RayGround is the ground
// along one ray, as far as it hides and attenuates these: Algorithm::describe() fills it, PointReturn reads it.
// Inputs: geometry of a ray; terrain, scenes and traffic; configuration at construction.
// Outputs: power per sample, mask of the lit samples, 8-bit video. Samples are ordered near to far. A power of 1 is
// full scale: it gives video 255 at the highest GAIN step. A void (ground without elevation data) returns no power.
// Units: heights are above mean sea level.
// Threads: one thread at a time may use an instance. No allocation after construction.
// Source: docs/radar_maths.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "model/physics/environment.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/sweep_geometry.hpp"

namespace yars::model::rbm {

struct RayGround {
  struct Sample {
    double horizon = 0.0;  // maximum tangent of elevation angle up to and including this sample
    double peak_m = 0.0;   // highest ground at the sample, which casts the shadow; NaN: void
    // Slope of the ground from the peak of the previous sample to that of this one, if it is taken to be straight
    // between them. NaN: it is walked.
    double slope = std::numeric_limits<double>::quiet_NaN();
  };
  explicit RayGround(std::size_t count) : samples(count), distance_m(count) { transmission.reserve(count); }

  physics::SweepGeometry geometry;  // of the ray
  std::vector<Sample> samples;
  std::vector<double> distance_m;    // over ground, ascending
  std::vector<double> transmission;  // two-way, of the rain; empty: no rain
};

class Algorithm {
 public:
  Algorithm() = default;
  Algorithm(const Algorithm&) = delete;
  Algorithm& operator=(const Algorithm&) = delete;
  virtual ~Algorithm() = default;

  // Replaces sea state, wind and rain from the next measure() on. Report1996 has neither.
  virtual void use_weather(const physics::RadarParameters& /*parameters*/) {}

  // Computes the power of sample_count() samples after sensitivity time control (a gain that increases with range) and
  // pulse smear (mean over the samples that the pulse covers), without noise: that of the ground along one ray, with
  // the covers of scenes and the rain, without point targets. Report1996 has no sensitivity time control and smears
  // over three samples. Values are finite and >= 0. Returns the number of samples on terrain that is not loaded.
  virtual std::size_t measure(const physics::SweepGeometry& geometry, const physics::Environment& environment,
                              std::span<float> power) = 0;

  // Lit mask of the last measure(): 1 if no nearer ground hides the sample; 0 in shadow and over a void. Report1996
  // also sets 0 outside the beam.
  virtual void lit(std::span<std::uint8_t> mask) const = 0;

  // False: point targets (movers, standing parts of scenes) return no power.
  virtual bool has_points() const = 0;

  // Describes the ground of the last measure() to point targets: all of `ground` but its geometry. Call it only if
  // has_points().
  virtual void describe(RayGround& /*ground*/) const {}

  // Computes the video of the sweep that has the power `window.centre`: azimuth smear, noise, receiver characteristic.
  // `gain` is the GAIN step 0..3.
  virtual void form_video(const physics::PowerWindow& window, geo::Length range, int gain, const physics::NoiseKey& key,
                          std::span<std::uint8_t> video) = 0;
};

// Number of samples per sweep, in [1, kMaxSamples].
inline std::size_t sample_count(const physics::RadarParameters& parameters) {
  return parameters.samples;
}

}  // namespace yars::model::rbm
