// Opens a raster of heights with GDAL and works out where on the earth it lies. GDAL's own messages become part of
// the error; nothing goes to stderr. Private to this folder.
#pragma once

#include <gdal.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>

#include "lib/failure/error.hpp"

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

// Between the middles of the outermost pixels; longitudes not wrapped, west <= east.
struct Extent {
  double south_deg = 0.0, north_deg = 0.0, west_deg = 0.0, east_deg = 0.0;
  double pixel_north_deg = 0.0, pixel_east_deg = 0.0;  // spacing in the middle of the raster
};

struct Raster {
  Dataset dataset;
  GDALRasterBandH heights = nullptr;  // belongs to the dataset
  bool geographic = false;            // its own coordinates are degrees
  Extent extent;
};

// `path` must be a plain file.
failure::Expected<Raster> open_raster(const std::filesystem::path& path);

}  // namespace yars::model::terrain::gdal
