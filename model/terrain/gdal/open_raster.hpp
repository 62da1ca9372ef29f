// Opens a raster of heights with GDAL: one band, its place on the earth, and what makes metres of its numbers.
// GDAL's own messages become part of the error; nothing goes to stderr. Private to this folder.
#pragma once

#include <gdal.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "lib/failure/error.hpp"
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

// `path` must be a plain file.
failure::Expected<Raster> open_raster(const std::filesystem::path& path);

}  // namespace yars::model::terrain::gdal
