// A raster of heights opened by GDAL, and windows of its heights. Private to this folder.
// Input: a plain file. Output: heights [m MSL by scale and offset], NaN without data.
// Errors: no plain file, GDAL cannot open or read it, not one band of heights, no georeference. GDAL's messages become
//   part of the error; nothing goes to stderr.
// Threads: one thread per Raster.
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

// Captures the error messages of GDAL on this thread during the object's lifetime.
class MessageCapture {
 public:
  MessageCapture();
  ~MessageCapture();
  MessageCapture(const MessageCapture&) = delete;
  MessageCapture& operator=(const MessageCapture&) = delete;
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
  // height [m] = number in the band * scale + offset_m.
  double scale = 1.0;
  double offset_m = 0.0;
  std::optional<double> void_number;  // number for no data
  bool masked = false;                // a separate mask marks pixels without data
  bool whole_metres = false;          // numbers are whole metres
};

// Opens a raster with one band of heights and reads its georeference, unit, scale and no-data value.
error::Expected<Raster> open_raster(const std::filesystem::path& path);

// Range [first, first + count) in each dimension.
struct Box {
  int first_column = 0, first_row = 0;
  int columns = 0, rows = 0;
  std::size_t area() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
};

// Heights of pixels [m], row by row. NaN: no data. Infinite: impossible heights, below -12,000 m or above 10,000 m, and
// the numbers -32768, -32767 and -9999, which producers write for no data without declaring it.
error::Expected<std::vector<float>> read_heights(const Raster& raster, const Box& pixels);

// Size of the blocks of pixels that are averaged. Blocks begin at the raster's first pixel.
struct BlockSize {
  int across = 1, along = 1;  // [pixels]
};

// Mean heights of blocks. Blocks of 1 x 1 are the pixels.
struct HeightWindow {
  Box blocks;                   // range of blocks
  std::vector<float> height_m;  // NaN where no pixel of a block has a height
  std::size_t impossible = 0;   // number of pixels with impossible heights
  float at(int column, int row) const {
    return height_m[static_cast<std::size_t>(row - blocks.first_row) * static_cast<std::size_t>(blocks.columns) +
                    static_cast<std::size_t>(column - blocks.first_column)];
  }
};

// Means of `blocks`. Impossible pixels are counted in the blocks of `counted` only.
error::Expected<HeightWindow> read_window(const Raster& raster, BlockSize size, const Box& blocks, const Box& counted);

}  // namespace yars::model::terrain::gdal
