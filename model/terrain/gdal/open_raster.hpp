// Raster of heights or of classes opened by GDAL, and mean heights of blocks of its pixels. Used in this folder only.
// Input: a regular file. Output: heights [m], NaN where the raster has no data. The heights are above mean sea level,
//   or above the ellipsoid if Georeference::heights_are_ellipsoidal().
// Errors: not a regular file, not readable by GDAL, not exactly one band of numbers, heights of less than
//   16 bits, classes that are no whole numbers, no georeference.
//   The first error message of GDAL becomes part of the error. GDAL prints nothing to stderr.
// Threads: one thread per Raster.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/gdal/gdal_library.hpp"
#include "model/terrain/gdal/georeference.hpp"

namespace yars::model::terrain::gdal {

inline constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();  // a pixel or block without a height

struct CloseDataset {
  void operator()(GDALDatasetH dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

// Captures the first error message of GDAL on this thread during the object's lifetime. load_gdal() comes first.
class MessageCapture {
 public:
  MessageCapture();
  ~MessageCapture();
  MessageCapture(const MessageCapture&) = delete;
  MessageCapture& operator=(const MessageCapture&) = delete;
  // The captured message, or `otherwise` if there is none.
  std::string first_or(const std::string& otherwise) const { return first_.empty() ? otherwise : first_; }

 private:
  std::string first_;
};

struct Raster {
  std::string subject;  // path, for error messages
  Dataset dataset;
  GDALRasterBandH heights = nullptr;  // or classes; owned by the dataset
  int columns = 0, rows = 0;
  Georeference georeference;
  // Height [m] = band value x scale + offset_m.
  double scale = 1.0;
  double offset_m = 0.0;
  std::optional<double> no_data_value;  // declared no-data value of the band
  bool masked = false;                  // true: a separate mask band marks pixels without data
  bool whole_metres = false;            // true: all heights are whole metres
};

// What the band of a raster has. Classes: whole numbers of any size, without unit and scale.
enum class Content : std::uint8_t { heights, classes };

// Opens a raster with one band and reads its georeference, unit, scale and no-data value.
error::Expected<Raster> open_raster(const std::filesystem::path& path, Content content = Content::heights);

// Rectangle of pixels or blocks: [first, first + count) in each dimension.
struct Box {
  int first_column = 0, first_row = 0;
  int columns = 0, rows = 0;
  std::size_t area() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
};

// Reads the numbers of pixels into `numbers`, row by row, as `type`. Returns by pixel whether it has data, by the mask
// of the raster; empty if it has none. `what`: heights or classes, for the error.
error::Expected<std::vector<std::uint8_t>> read_pixels(const Raster& raster, const Box& pixels, GDALDataType type,
                                                       void* numbers, const std::string& what);

// Reads the heights of pixels [m], row by row. NaN: no data. Infinity: an impossible height.
// Impossible are heights below -12,000 m or above 10,000 m, a height of -9999 m, and undeclared no-data values of the
// band: -32768, -32767, 32767 and -9999. In unsigned bands these values are 65535 (16 bits only) and 32767 (only
// without a scale) instead.
error::Expected<std::vector<float>> read_heights(const Raster& raster, const Box& pixels);

// Size of the blocks of pixels that are averaged. The first block begins at the raster's first pixel.
struct BlockSize {
  int across = 1, along = 1;  // [pixels] columns, rows
};

// Mean heights of blocks. A block of 1 x 1 is one pixel.
struct HeightWindow {
  Box blocks;                   // rectangle of blocks
  std::vector<float> height_m;  // NaN where no pixel of a block has a height
  std::size_t impossible = 0;   // number of counted pixels (CountedPixels) with impossible heights
  float at(int column, int row) const {
    return height_m[static_cast<std::size_t>(row - blocks.first_row) * static_cast<std::size_t>(blocks.columns) +
                    static_cast<std::size_t>(column - blocks.first_column)];
  }
};

// Pixels whose impossible heights are counted.
struct CountedPixels {
  Box blocks;                           // pixels of these blocks
  std::optional<PixelCorners> corners;  // quadrilateral that the pixel's centre must also lie in; nullopt: no limit
};

// Reads the mean heights of `blocks`.
error::Expected<HeightWindow> read_window(const Raster& raster, BlockSize size, const Box& blocks,
                                          const CountedPixels& counted);

}  // namespace yars::model::terrain::gdal
