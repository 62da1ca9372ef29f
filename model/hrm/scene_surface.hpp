// What the faces of a scene return, and which of them are walls or lie on the ground: the rules that the fast
// algorithm and the reference share.
#pragma once

#include <cstddef>
#include <vector>

#include "lib/radar/configuration.hpp"

namespace yars::model::hrm {

// A level face this near its object's base [m] lies on the ground: it takes the ground's height and gives it its gamma.
inline constexpr double kOnGround_m = 0.5;
inline constexpr double kLevelNormal = 0.98;  // upward part of a unit normal that is level
// Steeper than 70 degrees a face is a wall: square of the upward part of its normal against the level part.
inline constexpr double kWallNormal2 = 0.13;
inline constexpr double kMostShading = 4.0;  // of an interpolated normal against the facet's: silhouettes are ragged

class SceneSurface {
 public:
  explicit SceneSurface(const radar::RadarConfiguration& configuration);

  // By material code, whatever its number; 0 stands for the configured plain material.
  double gamma(std::size_t code) const { return gamma_[code % gamma_.size()]; }
  // The same of a wall whose horizontal normal is so far off the direction to the radar: `across` against `towards`.
  double wall_gamma(std::size_t code, double across, double towards) const;

 private:
  std::vector<double> gamma_, cardinal_;
  double street_width_deg_;
  double faded_tangent_;  // of the angle beyond which nothing of the cardinal effect is left
};

}  // namespace yars::model::hrm
