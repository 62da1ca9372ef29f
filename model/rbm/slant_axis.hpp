// Sweeps with samples at equal steps of slant range (`slantRange`): moves the power of the ground along one ray from
// ground range to slant range. Slopes that face the aircraft are foreshortened. High ground is laid over what lies
// before it. Level ground keeps its power.
// Inputs: power and height of cells at equal steps of ground range; altitude; earth.
// Outputs: power of as many samples at equal steps of slant range up to the same range, full scale = 1.
// Accuracy: the ground of a cell is straight; its echo is even in slant range. Double precision.
// Threads: one thread at a time may use an instance. No allocation after construction.
// Source: docs/radar_maths.md#slant-range.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/physics/sweep_geometry.hpp"

namespace yars::model::rbm {

class SlantAxis {
 public:
  explicit SlantAxis(std::size_t samples);

  // `height_m` [m MSL]: by sample, in the middle of its cell. NaN: void, which lies level with the ground beside it.
  void move(const physics::SweepGeometry& geometry, const physics::EffectiveEarth& earth,
            std::span<const float> height_m, std::span<float> power);

 private:
  std::vector<double> height_m_, moved_;
};

// Ground along a ray that a sample of slant range shows: the nearest lit ground at its slant range, else the nearest
// ground. `distance_m`, `height_m`, `lit`: of samples at equal steps of ground range, height NaN: void. Result:
// distance over ground [m] of as many samples of slant range; NaN: there is no ground.
struct ShownGround {
  double distance_m;
  bool lit, laid_over;  // laid_over: two or more pieces of lit ground have this slant range
};
std::vector<ShownGround> shown_at_slant_ranges(const physics::SweepGeometry& geometry,
                                               const physics::EffectiveEarth& earth, std::span<const double> distance_m,
                                               std::span<const double> height_m, std::span<const std::uint8_t> lit);

}  // namespace yars::model::rbm
