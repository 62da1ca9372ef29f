// What land returns: sigma0 = gamma sin(psi), gamma by surface material, 5 dB more a decade of frequency. Walls that
// face the radar return more (cardinal effect). Gammas are power ratios at the radar's frequency.
// Source: docs/spec/physics.md#land; the constant-gamma model after Barton, "Modern Radar System Analysis".
#pragma once

#include <array>
#include <cstdint>

#include "lib/radar/configuration.hpp"

namespace yars::model::reflectivity {

// What is added to every gamma [dB] at this frequency: slope * log10(f / reference).
double frequency_term_db(const radar::LandConfiguration& land, double frequency_ghz);

// By material code; a code without a material returns what land without culture returns.
struct LandReturn {
  std::array<double, radar::kMaterials> gamma{};
  std::array<double, radar::kMaterials> cardinal{};  // power ratio less 1, at walls square to the look; 0 = no walls
  double street_width_deg = 6.0;
};
LandReturn make_land_return(const radar::RadarConfiguration& configuration);

// Angle [deg] in [-45, 45) between a look and the nearest direction of a street grid, whose walls stand square to it.
double off_street_deg(double look_deg, double street_deg);

// Factor on gamma: 1 + cardinal * exp(-4 ln 2 (off / width)^2), the width between half powers.
double cardinal_gain(double cardinal, double off_deg, double width_deg);

}  // namespace yars::model::reflectivity
