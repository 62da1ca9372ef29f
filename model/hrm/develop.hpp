// Speckle, thermal noise and the receiver's logarithm: from power to the picture.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/hrm/map_image.hpp"

namespace yars::model::hrm {

// Thermal noise as the gamma of level ground that returns as much, at a slant range: it falls behind with the cube of
// the range, for the time that a map takes makes up for one power of the fourth.
double noise_gamma(const radar::HighResolutionConfiguration& configuration, geo::Length slant_range);

// Speckle of `looks` looks, see speckle.hpp. Blank pixels are black. `map` and the seed name the noise.
void develop(const radar::RadarConfiguration& configuration, const MapImage& image, double noise, int looks,
             std::uint32_t map, std::vector<std::uint8_t>& picture);

}  // namespace yars::model::hrm
