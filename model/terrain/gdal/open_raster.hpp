// Raster opened by GDAL, and windows of its heights.
#pragma once

#include <gdal.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/gdal/georeference.hpp"

namespace yars::model::terrain::gdal {

struct CloseDataset {
  void operator()(GDALDatasetH dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

// While it lives, GDAL's messages of this thread are kept here.
class MessageKeeper {
 public:
  MessageKeeper();
  ~MessageKeeper();
  MessageKeeper(const MessageKeeper&) = delete;
  MessageKeeper& operator=(const MessageKeeper&) = delete;
  // The first error, or `otherwise`.
  std::string first_or(const std::string& otherwise) const { return first_.empty() ? otherwise : first_; }

 private:
  std::string first_;
};

struct Raster {
  std::string subject;  // its path, for errors
  Dataset dataset;
  GDALRasterBandH heights = nullptr;  // belongs to the dataset
  int columns = 0, rows = 0;
  Georeference georeference;
  // Of the band: height [m] = number * scale + offset.
  double scale = 1.0;
  double offset_m = 0.0;
  std::optional<double> void_number;  // what stands for no data
  bool masked = false;                // a mask of its own says where there is no data
  bool whole_metres = false;          // its numbers are metres without fractions
};

// Opens a raster of heights with GDAL: one band, its place on the earth, and what makes metres of its numbers.
// GDAL's own messages become part of the error; nothing goes to stderr. Private to this folder.
// `path` must be a plain file.
error::Expected<Raster> open_raster(const std::filesystem::path& path);

// A part of a raster as heights in metres, every number judged before anything is made of it.
// Private to this folder.

// Positions [first, first + count) in each dimension.
struct Box {
  int first_column = 0, first_row = 0;
  int columns = 0, rows = 0;
  std::size_t area() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
};

// Pixels as heights [m], row by row. NaN: no data. Infinite: a number that only looks like a height: below -12,000 m,
// above 10,000 m, and -32768, -32767 and -9999, which makers of rasters write for no data without saying so.
error::Expected<std::vector<float>> read_heights(const Raster& raster, const Box& pixels);

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
error::Expected<HeightWindow> read_window(const Raster& raster, BlockSize size, const Box& blocks, const Box& counted);

}  // namespace yars::model::terrain::gdal
