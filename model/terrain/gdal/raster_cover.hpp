// Which cells a raster touches, how much of each it spans, and how fine their posts have to be. Private to this folder.
#pragma once

#include <vector>

#include "model/terrain/gdal/open_raster.hpp"
#include "model/terrain/gdal/raster.hpp"

namespace yars::model::terrain::gdal {

// From the header alone. Empty: it touches none.
std::vector<RasterCell> cells_of(const Raster& raster);

// Whether the posts of a cell of so many intervals are pixels of the raster, each at its own place.
bool posts_are_pixels(const Raster& raster, int posts_per_degree_north, int posts_per_degree_east);

}  // namespace yars::model::terrain::gdal
