// A part of a raster as heights in metres, every number judged before anything is made of it.
// Private to this folder.
#pragma once

#include <cstddef>
#include <vector>

#include "lib/failure/error.hpp"
#include "model/terrain/gdal/open_raster.hpp"

namespace yars::model::terrain::gdal {

// Positions [first, first + count) in each dimension.
struct Box {
  int first_column = 0, first_row = 0;
  int columns = 0, rows = 0;
  std::size_t area() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
};

// Pixels as heights [m], row by row. NaN: no data. Infinite: a number that only looks like a height: below -12,000 m,
// above 10,000 m, and -32768, -32767 and -9999, which makers of rasters write for no data without saying so.
failure::Expected<std::vector<float>> read_heights(const Raster& raster, const Box& pixels);

// Blocks of pixels, from the raster's own first pixel on.
struct BlockSize {
  int across = 1, along = 1;  // [pixels]
};

// Means of blocks; of 1 x 1 the pixels themselves.
struct HeightWindow {
  Box blocks;                   // which
  std::vector<float> height_m;  // NaN where no pixel of a block has a height
  std::size_t impossible = 0;   // pixels that read_heights() makes infinite
  float at(int column, int row) const {
    return height_m[static_cast<std::size_t>(row - blocks.first_row) * static_cast<std::size_t>(blocks.columns) +
                    static_cast<std::size_t>(column - blocks.first_column)];
  }
};

// Of impossible pixels those in blocks of `counted` are counted.
failure::Expected<HeightWindow> read_window(const Raster& raster, BlockSize size, const Box& blocks,
                                            const Box& counted);

}  // namespace yars::model::terrain::gdal
