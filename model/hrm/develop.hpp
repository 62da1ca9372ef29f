// Speckle, thermal noise and the receiver's logarithm: from power to the picture.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/hrm/map_image.hpp"

namespace yars::model::hrm {

// Thermal noise as the gamma of level ground that returns as much: it falls behind with the cube of the slant range,
// for the time that a map takes makes up for one power of the fourth; and it is less the coarser the cells of a window
// are, for each holds more ground. Source: Carrara, Goodman, Majewski, "Spotlight SAR", 3.1 (noise-equivalent sigma
// nought).
double noise_gamma(const radar::HighResolutionConfiguration& configuration, geo::Length slant_range,
                   geo::Length window);

struct MapNoise {
  double thermal = 0.0;   // as noise_gamma() has it
  int looks = 1;          // of the speckle, see speckle.hpp
  std::uint32_t map = 0;  // names the noise, together with the seed
};

// Rows [first, last) of the picture, which is as large as the image. Blank pixels are black.
void develop(const radar::RadarConfiguration& configuration, const MapImage& image, const MapNoise& noise, int first,
             int last, std::vector<std::uint8_t>& picture);

}  // namespace yars::model::hrm
