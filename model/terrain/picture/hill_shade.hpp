// Hill-shaded map of the ground, for people: lit from the north-west, coloured by height or by surface material. Sea,
// voids and absent cells have fixed colours.
// Inputs: elevation cells with their culture, or a view of the terrain; a frame in degrees and pixels.
// Outputs: an RGB image. Projection: plate carree (x proportional to longitude, y to latitude).
// Threads: any; functions without state.
#pragma once

#include "lib/imageio/png.hpp"
#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain {

struct MapFrame {
  double south_deg = 0.0, north_deg = 0.0, west_deg = 0.0, east_deg = 0.0;
  int width = 0, height = 0;  // [pixels]
};

// Frame of the given width [pixels]. The height, 1 to 16384 pixels, gives true shapes at the middle parallel.
MapFrame map_frame(double south_deg, double north_deg, double west_deg, double east_deg, int width);

// RGB image filled with the colour of absent cells.
imageio::Image blank_map(const MapFrame& frame);

// Paints the pixels whose centre is in the cell. `culture` may be null.
void paint_cell(const Cell& cell, const Culture* culture, const MapFrame& frame, imageio::Image& image);

// The whole frame from a view. The slope at a pixel is a difference over two pixels or two posts, whichever is wider.
imageio::Image map_of(const TerrainView& view, const MapFrame& frame);

}  // namespace yars::model::terrain
