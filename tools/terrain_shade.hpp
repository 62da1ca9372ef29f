// A map of elevation as a picture: hill shade lit from the north-west, tinted by height or by what covers the
// ground; sea and voids in colours of their own. Plate carree stretched so that the middle parallel has true shape.
// Pure.
#pragma once

#include <cstdint>

#include "lib/imageio/png.hpp"
#include "model/terrain/cell.hpp"
#include "model/terrain/culture.hpp"

namespace yars::tools {

struct MapFrame {
  double south_deg = 0.0, north_deg = 0.0, west_deg = 0.0, east_deg = 0.0;
  int width = 0, height = 0;  // [pixels]
};

// A frame of this width, its height chosen for true shape.
MapFrame map_frame(double south_deg, double north_deg, double west_deg, double east_deg, int width);

// A picture of the colour of absent cells, RGB.
imageio::Image blank_map(const MapFrame& frame);

// Paints the pixels whose middle lies in the cell; `culture` may be null.
void paint_cell(const model::terrain::Cell& cell, const model::terrain::Culture* culture, const MapFrame& frame,
                imageio::Image& image);

}  // namespace yars::tools
