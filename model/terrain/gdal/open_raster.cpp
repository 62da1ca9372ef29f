#include "model/terrain/gdal/open_raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>

namespace yars::model::terrain::gdal {

namespace {

// GDAL drivers that open_raster() permits; they read local files only. VRT and similar drivers are absent: their files
// may name any path or address, which GDAL would open.
constexpr std::array<const char*, 12> kDrivers = {"GTiff",   "JP2OpenJPEG",    "HFA", "AAIGrid", "EHdr",    "ENVI",
                                                  "USGSDEM", "GRASSASCIIGrid", "BT",  "DTED",    "SRTMHGT", nullptr};

bool has_content(GDALDatasetH dataset, Content content) {
  if (GDALGetRasterCount(dataset) != 1) return false;
  switch (GDALGetRasterDataType(GDALGetRasterBand(dataset, 1))) {
    case GDT_Byte:
      return content == Content::classes;
    case GDT_Int16:
    case GDT_UInt16:
    case GDT_Int32:
    case GDT_UInt32:
      return true;
    case GDT_Float32:
    case GDT_Float64:
      return content == Content::heights;
    default:
      return false;
  }
}

std::string bands_of(GDALDatasetH dataset) {
  const int count = GDALGetRasterCount(dataset);
  if (count == 0) return "no band";
  const GDALDataType type = GDALGetRasterDataType(GDALGetRasterBand(dataset, 1));
  return std::to_string(count) + " band(s) of type " + GDALGetDataTypeName(type);
}

// [m] Unit of the band's heights. If the band states no unit: `by_system`, the unit of heights in the coordinate
// system, or the metre if `by_system` is 0. Any stated unit other than feet counts as the metre.
double metres_of(GDALRasterBandH band, double by_system) {
  constexpr double kFoot = 0.3048;
  constexpr double kSurveyFoot = 1200.0 / 3937.0;
  const std::string_view unit = GDALGetRasterUnitType(band);
  if (unit == "ft" || unit == "foot" || unit == "feet") return kFoot;
  if (unit == "US survey foot" || unit == "ftUS" || unit == "us-ft") return kSurveyFoot;
  return unit.empty() && by_system > 0.0 ? by_system : 1.0;
}

bool is_whole(GDALDataType type) {
  return type == GDT_Int16 || type == GDT_UInt16 || type == GDT_Int32 || type == GDT_UInt32;
}

void describe_numbers(Raster& raster) {
  const Georeference& position = raster.georeference;
  const double metres = metres_of(raster.heights, position.metres_per_unit()) * (position.points_down() ? -1.0 : 1.0);
  raster.scale = GDALGetRasterScale(raster.heights, nullptr) * metres;
  raster.offset_m = GDALGetRasterOffset(raster.heights, nullptr) * metres;
  int stated = 0;
  const double number = GDALGetRasterNoDataValue(raster.heights, &stated);
  if (stated != 0) raster.no_data_value = number;
  raster.masked = (GDALGetMaskFlags(raster.heights) & (GMF_ALL_VALID | GMF_NODATA)) == 0;
  raster.whole_metres = is_whole(GDALGetRasterDataType(raster.heights)) && std::abs(raster.scale) == 1.0 &&
                        raster.offset_m == std::round(raster.offset_m) && !position.heights_are_ellipsoidal();
}

void keep_first(CPLErr severity, CPLErrorNum /*number*/, const char* text) {
  auto* const first = static_cast<std::string*>(CPLGetErrorHandlerUserData());
  if (severity < CE_Failure || !first->empty()) return;
  *first = std::string("GDAL: ") + text;
  std::replace(first->begin(), first->end(), '\n', ' ');
}

}  // namespace

MessageCapture::MessageCapture() {
  CPLPushErrorHandlerEx(keep_first, &first_);
}
MessageCapture::~MessageCapture() {
  CPLPopErrorHandler();
}

error::Expected<Raster> open_raster(const std::filesystem::path& path, Content content) {
  const std::string subject = path.string();
  const std::string what = content == Content::heights ? "heights" : "classes";
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
    return error::fail(subject, "a raster of " + what + " in a regular file",
                       code ? error::reason_of(code.value()) : "not a regular file");
  if (const auto loaded = load_gdal(subject); !loaded) return tl::unexpected(loaded.error());
  const MessageCapture messages;
  // An absolute path cannot begin with a prefix of a GDAL driver. The check above refuses virtual folders
  // (/vsizip/...).
  Raster raster;
  raster.dataset.reset(GDALOpenEx(std::filesystem::absolute(path).c_str(),
                                  GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, kDrivers.data(), nullptr,
                                  nullptr));
  GDALDatasetH const dataset = raster.dataset.get();
  if (dataset == nullptr)
    return error::fail(subject, "a raster of " + what + " in a regular file (GeoTIFF, JPEG 2000, Erdas Imagine, ...)",
                       messages.first_or("one that GDAL does not open"));
  if (!has_content(dataset, content))
    return error::fail(subject,
                       content == Content::heights ? "one band of heights, 16 bits or more"
                                                   : "one band of classes, which are whole numbers",
                       bands_of(dataset), "it may be a picture");
  raster.subject = subject;
  raster.heights = GDALGetRasterBand(dataset, 1);
  raster.columns = GDALGetRasterXSize(dataset);
  raster.rows = GDALGetRasterYSize(dataset);
  auto georeference = Georeference::of(dataset, subject);
  if (!georeference) return tl::unexpected(georeference.error());
  raster.georeference = std::move(*georeference);
  describe_numbers(raster);
  return raster;
}

namespace {

// [m] Bounds of possible heights, as in cell_reading.cpp.
constexpr double kLowest_m = -12'000.0;
constexpr double kHighest_m = 10'000.0;
constexpr float kImpossible = std::numeric_limits<float>::infinity();

// Band values that producers write where they have no data, often without declaring them. These values are compared
// before scale, offset and unit are applied. Afterwards, some of these values would be possible heights.
std::vector<float> usual_voids_of(const Raster& raster) {
  const GDALDataType type = GDALGetRasterDataType(raster.heights);
  if (type != GDT_UInt16 && type != GDT_UInt32) return {-32768.0F, -32767.0F, 32767.0F, -9999.0F};
  std::vector<float> voids;
  if (type == GDT_UInt16) voids.push_back(65535.0F);
  // With a scale, 32767 is a usual height in the middle of an unsigned band's range.
  if (GDALGetRasterScale(raster.heights, nullptr) == 1.0) voids.push_back(32767.0F);
  return voids;
}

// Converts a band value to a height [m]. NaN: no data, as the file declares. Infinity: an impossible height, or one of
// usual_voids_of() that the file does not declare.
class HeightCheck {
 public:
  explicit HeightCheck(const Raster& raster)
      : usual_voids_(usual_voids_of(raster)),
        scale_(raster.scale),
        offset_m_(raster.offset_m),
        no_data_value_(raster.no_data_value ? static_cast<float>(*raster.no_data_value) : kMissing) {}

  float operator()(float number) const {
    if (std::isnan(number) || number == no_data_value_) return kMissing;
    const double height_m = static_cast<double>(number) * scale_ + offset_m_;
    const bool possible = height_m >= kLowest_m && height_m <= kHighest_m && height_m != kCommonVoid_m &&
                          std::find(usual_voids_.begin(), usual_voids_.end(), number) == usual_voids_.end();
    return possible ? static_cast<float>(height_m) : kImpossible;
  }

 private:
  static constexpr double kCommonVoid_m = -9999.0;
  std::vector<float> usual_voids_;
  double scale_, offset_m_;
  float no_data_value_;
};

bool contains(const Box& box, int column, int row) {
  return column >= box.first_column && row >= box.first_row && column < box.first_column + box.columns &&
         row < box.first_row + box.rows;
}

// True if a position lies in a polygon. A position on the common edge of two polygons lies in one of them.
bool contains(const PixelCorners& polygon, PixelPosition position) {
  bool inside = false;
  for (std::size_t i = 0, before = polygon.size() - 1; i < polygon.size(); before = i++) {
    const PixelPosition& a = polygon[i];
    const PixelPosition& b = polygon[before];
    if ((a.row > position.row) != (b.row > position.row) &&
        position.column < a.column + (b.column - a.column) * (position.row - a.row) / (b.row - a.row))
      inside = !inside;
  }
  return inside;
}

// Accumulates pixels into the means of a window's blocks, and counts impossible heights.
class Means {
 public:
  Means(BlockSize size, const Box& blocks, const CountedPixels& counted)
      : size_(size), counted_(counted), window_{blocks, {}, 0}, sums_m_(blocks.area()), counts_(blocks.area()) {}

  void add(const std::vector<float>& heights_m, const Box& pixels) {
    std::size_t pixel = 0;
    for (int row = pixels.first_row; row < pixels.first_row + pixels.rows; ++row)
      for (int column = pixels.first_column; column < pixels.first_column + pixels.columns; ++column)
        add(column, row, heights_m[pixel++]);
  }

  HeightWindow take() {
    window_.height_m.reserve(sums_m_.size());
    for (std::size_t block = 0; block < sums_m_.size(); ++block)
      window_.height_m.push_back(counts_[block] == 0 ? kMissing : static_cast<float>(sums_m_[block] / counts_[block]));
    return std::move(window_);
  }

 private:
  void add(int pixel_column, int pixel_row, float height_m) {
    const int column = pixel_column / size_.across;
    const int row = pixel_row / size_.along;
    if (std::isfinite(height_m)) {
      const Box& blocks = window_.blocks;
      const auto block = static_cast<std::size_t>(row - blocks.first_row) * static_cast<std::size_t>(blocks.columns) +
                         static_cast<std::size_t>(column - blocks.first_column);
      sums_m_[block] += static_cast<double>(height_m);
      ++counts_[block];
    } else if (std::isinf(height_m) && contains(counted_.blocks, column, row) &&
               (!counted_.corners || contains(*counted_.corners, {pixel_column + 0.5, pixel_row + 0.5}))) {
      ++window_.impossible;
    }
  }

  BlockSize size_;
  CountedPixels counted_;
  HeightWindow window_;
  std::vector<double> sums_m_;
  std::vector<int> counts_;
};

}  // namespace

error::Expected<std::vector<std::uint8_t>> read_pixels(const Raster& raster, const Box& pixels, GDALDataType type,
                                                       void* numbers, const std::string& what) {
  const MessageCapture messages;
  std::vector<std::uint8_t> valid(raster.masked ? pixels.area() : 0);
  const auto read = [&](GDALRasterBandH band, void* into, GDALDataType as) {
    return GDALRasterIO(band, GF_Read, pixels.first_column, pixels.first_row, pixels.columns, pixels.rows, into,
                        pixels.columns, pixels.rows, as, 0, 0) == CE_None;
  };
  if (!read(raster.heights, numbers, type) ||
      (raster.masked && !read(GDALGetMaskBand(raster.heights), valid.data(), GDT_Byte)))
    return error::fail(raster.subject, what + " that can be read", messages.first_or("a failure of GDAL"),
                       "the file may be damaged; fetch it again");
  return valid;
}

error::Expected<std::vector<float>> read_heights(const Raster& raster, const Box& pixels) {
  std::vector<float> heights(pixels.area());
  const auto valid = read_pixels(raster, pixels, GDT_Float32, heights.data(), "heights");
  if (!valid) return tl::unexpected(valid.error());
  std::transform(heights.begin(), heights.end(), heights.begin(), HeightCheck(raster));
  for (std::size_t i = 0; i < valid->size(); ++i)
    if ((*valid)[i] == 0) heights[i] = kMissing;
  return heights;
}

error::Expected<HeightWindow> read_window(const Raster& raster, BlockSize size, const Box& blocks,
                                          const CountedPixels& counted) {
  Means means(size, blocks, counted);
  Box pixels;
  pixels.first_column = blocks.first_column * size.across;
  pixels.columns = std::min(raster.columns, (blocks.first_column + blocks.columns) * size.across) - pixels.first_column;
  // Reads the pixels in strips, because all pixels of large blocks together may need too much memory.
  constexpr int kMaxPixels = 1 << 22;  // per strip, unless one row has more
  const int rows_at_once = std::max(1, kMaxPixels / std::max(1, pixels.columns));
  const int end_row = std::min(raster.rows, (blocks.first_row + blocks.rows) * size.along);
  for (pixels.first_row = blocks.first_row * size.along; pixels.first_row < end_row; pixels.first_row += rows_at_once) {
    pixels.rows = std::min(rows_at_once, end_row - pixels.first_row);
    const auto heights = read_heights(raster, pixels);
    if (!heights) return tl::unexpected(heights.error());
    means.add(*heights, pixels);
  }
  return means.take();
}

}  // namespace yars::model::terrain::gdal
