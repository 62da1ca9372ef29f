// From what returns to a picture: the fan drawn onto the map, the impulse response, moving targets, speckle, receiver
// noise and the logarithm. Power is counted as the gamma that level ground at the centre would need to return as much.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "lib/radar/configuration.hpp"
#include "model/hrm/fan_grid.hpp"

namespace yars::model::hrm {

// Square, row 0 at the far edge.
struct MapImage {
  explicit MapImage(int edge) : size(edge), power(static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge)) {}
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(size) + static_cast<std::size_t>(column);
  }

  int size;
  memory::LineVector<float> power;
  bool blind = false;  // part of it is blank
};

// Level ground of gamma 1 returns this [m^2] a pixel: what a cross section is divided by.
double unit_return_m2(const PatchGeometry& geometry, int pixels);

// Rows [first, last) of the map from a fan of cross sections, bilinear. Blind cells become -1.
void draw_fan(const PatchGeometry& geometry, const FanGrid& grid, const float* cross_section_m2, int first, int last,
              MapImage& image);

// Marks what lies in the blind zone with -1, after all that returns is drawn.
void blank_blind_zone(const PatchGeometry& geometry, geo::Bearing ground_track,
                      const radar::HighResolutionConfiguration& configuration, MapImage& image);

}  // namespace yars::model::hrm
