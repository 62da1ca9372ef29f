// What the faces of a scene return, and which of them are walls: the rules that the fast algorithm and the reference
// share.
#pragma once

#include <cstddef>
#include <vector>

#include "lib/radar/configuration.hpp"

namespace yars::model::hrm {

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

  double cardinal(std::size_t code) const { return cardinal_[code % cardinal_.size()]; }
  // What a wall returns more than gamma, over gamma times cardinal(): by the sine of its angle off, in even steps from
  // 0, an entry more than steps; 0 behind the last.
  std::vector<float> cardinal_shares() const;
  double steps_a_sine() const;

 private:
  std::vector<double> gamma_, cardinal_;
  double street_width_deg_;
  double faded_deg_;
  double faded_tangent_;  // of the angle beyond which nothing of the cardinal effect is left
};

}  // namespace yars::model::hrm
