// The fan drawn onto the rows of the map, by vectors (Highway, chosen at run time; equal bits on every target).
#pragma once

#include "model/hrm/fan_grid.hpp"

namespace yars::model::hrm::lanes {

struct MapRow {
  int columns = 0;             // pixels
  float first_right_m = 0.0F;  // of the first pixel
  float pixel_m = 0.0F;
  float ahead_m = 0.0F;  // of the row: from the aircraft, along the line of sight
  float scale = 1.0F;    // on what is found, besides 1 / (width of a column * spacing)
};

// pixel[i] = fan per square metre at the pixel, bilinear, times the scale. Pixels lie within the grid.
void draw_row(const FanGrid& grid, const float* fan, const MapRow& row, float* pixel);

}  // namespace yars::model::hrm::lanes
