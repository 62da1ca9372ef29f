// What the faces of a scene return, by their surface material code.
#pragma once

#include <cstddef>
#include <vector>

#include "lib/radar/configuration.hpp"

namespace yars::model::reflectivity {

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

}  // namespace yars::model::reflectivity
