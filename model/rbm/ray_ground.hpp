// Ground along one ray, as far as it hides and attenuates point targets. Algorithm::describe() fills it, PointReturn
// reads it.
// Heights are above mean sea level. Samples are in order from near to far.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

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
  std::vector<double> distance_m;    // over ground, ascending; NaN: slant range too short to meet the ground
  std::vector<double> transmission;  // two-way, of the rain; empty: no rain
};

}  // namespace yars::model::rbm
