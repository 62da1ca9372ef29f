#include "model/terrain/gdal/raster.hpp"

#include <gdal_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <string_view>
#include <utility>

#include "model/terrain/gdal/open_raster.hpp"

namespace yars::model::terrain::gdal {

namespace {

constexpr int kStripRows = 1024;  // of a cell at a time, so that its real numbers never stand whole in memory
constexpr double kDeepest_m = -12000.0;
constexpr double kHighest_m = 9000.0;
constexpr double kSea_m = 0.05;  // [m] interpolated sea is not exactly 0

int friendly_posts(double pixel_deg) {
  const double wanted = std::min(1.0 / pixel_deg, static_cast<double>(kMostPostsPerDegree));
  int best = 15;
  for (const int odd : {15, 75, 225})
    for (int posts = odd; posts <= kMostPostsPerDegree; posts *= 2)
      if (std::abs(std::log(posts / wanted)) < std::abs(std::log(best / wanted))) best = posts;
  return best;
}

// How much of [edge, edge + 1] lies in [low, high].
double overlap(double edge, double low, double high) {
  return std::min(edge + 1.0, high) - std::max(edge, low);
}

struct Conversion {
  double scale = 1.0;  // metres of one unit of the band
  double offset_m = 0.0;
};

Conversion conversion_of(GDALRasterBandH band) {
  const std::string_view unit = GDALGetRasterUnitType(band);
  constexpr double kFoot = 0.3048;
  constexpr double kSurveyFoot = 1200.0 / 3937.0;
  double metres = 1.0;
  if (unit == "ft" || unit == "foot" || unit == "feet") metres = kFoot;
  if (unit == "US survey foot" || unit == "ftUS" || unit == "us-ft") metres = kSurveyFoot;
  return {GDALGetRasterScale(band, nullptr) * metres, GDALGetRasterOffset(band, nullptr) * metres};
}

std::int16_t rounded(float value, const Conversion& conversion) {
  if (!std::isfinite(value) || value <= kNoHeight + 1) return kNoHeight;
  const double height_m = value * conversion.scale + conversion.offset_m;
  if (!(height_m >= kDeepest_m && height_m <= kHighest_m)) return kNoHeight;
  if (std::abs(height_m) < kSea_m) return 0;
  const long whole_m = std::lround(height_m);
  if (whole_m != 0) return static_cast<std::int16_t>(whole_m);
  return height_m < 0 ? std::int16_t{-1} : std::int16_t{1};
}

std::string number(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.15g", value);
  return text.data();
}

struct DestroyOptions {
  void operator()(GDALWarpAppOptions* options) const { GDALWarpAppOptionsFree(options); }
};

// Rows [first, first + count) from the north of a cell's grid.
struct Strip {
  double west_deg = 0.0;   // of the cell, in the raster's own turn
  double north_deg = 0.0;  // of the cell
  int rows_per_degree = 0, columns_per_degree = 0;
  int first = 0, count = 0;
};

std::vector<std::string> warp_arguments(const Raster& raster, const Strip& strip) {
  const double down_deg = 1.0 / strip.rows_per_degree;
  const double right_deg = 1.0 / strip.columns_per_degree;
  // Posts are the middles of pixels.
  const double north_deg = strip.north_deg - (strip.first - 0.5) * down_deg;
  std::vector<std::string> arguments = {
      "-q",
      "-of",
      "MEM",
      "-ot",
      "Float32",
      "-r",
      "bilinear",
      "-ovr",
      "AUTO",
      "-novshift",
      "-wm",
      "64",
      "-dstnodata",
      number(kNoHeight),
      "-te",
      number(strip.west_deg - right_deg / 2),
      number(north_deg - strip.count * down_deg),
      number(strip.west_deg + 1.0 + right_deg / 2),
      number(north_deg),
      "-ts",
      std::to_string(strip.columns_per_degree + 1),
      std::to_string(strip.count),
      "-et",
      raster.geographic ? "0" : "0.02"};  // [pixels] a fiftieth moves a height less than its rounding
  if (!raster.geographic) arguments.insert(arguments.end(), {"-t_srs", "EPSG:4326"});
  int has_void = 0;
  (void)GDALGetRasterNoDataValue(raster.heights, &has_void);
  // What elevation rasters use where they do not say so.
  if (has_void == 0) arguments.insert(arguments.end(), {"-srcnodata", number(kNoHeight)});
  return arguments;
}

failure::Expected<std::vector<float>> warp(const Raster& raster, const Strip& strip, const std::string& subject) {
  const MessageKeeper messages;
  std::vector<std::string> arguments = warp_arguments(raster, strip);
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  const std::unique_ptr<GDALWarpAppOptions, DestroyOptions> options(GDALWarpAppOptionsNew(pointers.data(), nullptr));
  GDALDatasetH source = raster.dataset.get();
  int wrong_usage = 0;
  const Dataset warped(options ? GDALWarp("", nullptr, 1, &source, options.get(), &wrong_usage) : nullptr);
  const int columns = strip.columns_per_degree + 1;
  std::vector<float> heights(static_cast<std::size_t>(columns) * static_cast<std::size_t>(strip.count));
  if (!warped || GDALRasterIO(GDALGetRasterBand(warped.get(), 1), GF_Read, 0, 0, columns, strip.count, heights.data(),
                              columns, strip.count, GDT_Float32, 0, 0) != CE_None)
    return failure::fail(subject, "heights that can be read", messages.first_or("a failure of GDAL"),
                         "the file may be damaged; fetch it again");
  return heights;
}

}  // namespace

bool available() {
  return true;
}

failure::Expected<RasterSummary> describe_raster(const std::filesystem::path& path) {
  const auto raster = open_raster(path);
  if (!raster) return tl::unexpected(raster.error());
  const Extent& extent = raster->extent;
  RasterSummary summary{friendly_posts(extent.pixel_north_deg), friendly_posts(extent.pixel_east_deg), {}};
  std::set<std::pair<int, int>> seen;
  const int last_south = std::min(89, static_cast<int>(std::floor(extent.north_deg)));
  for (int south = std::max(-90, static_cast<int>(std::floor(extent.south_deg))); south <= last_south; ++south) {
    const double high = overlap(south, extent.south_deg, extent.north_deg);
    if (high < extent.pixel_north_deg / 4) continue;
    for (int west = static_cast<int>(std::floor(extent.west_deg)); west <= std::floor(extent.east_deg); ++west) {
      const double wide = overlap(west, extent.west_deg, extent.east_deg);
      const int wrapped = ((west + 180) % 360 + 360) % 360 - 180;
      if (wide < extent.pixel_east_deg / 4 || !seen.emplace(south, wrapped).second) continue;
      summary.cells.push_back({south, wrapped, high * wide});
    }
  }
  if (summary.cells.empty())
    return failure::fail(path.string(), "a raster of several pixels", "one that touches no cell of a degree");
  return summary;
}

failure::Expected<RasterPosts> read_raster(const std::filesystem::path& path, int south_deg, int west_deg,
                                           int posts_per_degree_north, int posts_per_degree_east) {
  const auto raster = open_raster(path);
  if (!raster) return tl::unexpected(raster.error());
  const Extent& extent = raster->extent;
  RasterPosts cell{posts_per_degree_north + 1, posts_per_degree_east + 1, {}};
  const auto columns = static_cast<std::size_t>(cell.columns);
  cell.posts.assign(static_cast<std::size_t>(cell.rows) * columns, kNoHeight);
  const Conversion conversion = conversion_of(raster->heights);
  // The turn of the earth that brings the cell beside the raster's middle.
  const double middle_deg = (extent.west_deg + extent.east_deg) / 2;
  const double turned_deg = west_deg + 360.0 * std::round((middle_deg - west_deg - 0.5) / 360.0);
  for (int first = 0; first < cell.rows; first += kStripRows) {
    const Strip strip{turned_deg,
                      south_deg + 1.0,
                      posts_per_degree_north,
                      posts_per_degree_east,
                      first,
                      std::min(kStripRows, cell.rows - first)};
    const double north_deg = strip.north_deg - static_cast<double>(first) / posts_per_degree_north;
    const double south_edge_deg = north_deg - static_cast<double>(strip.count - 1) / posts_per_degree_north;
    if (south_edge_deg > extent.north_deg + extent.pixel_north_deg ||
        north_deg < extent.south_deg - extent.pixel_north_deg)
      continue;
    const auto heights = warp(*raster, strip, path.string());
    if (!heights) return tl::unexpected(heights.error());
    for (std::size_t i = 0; i < heights->size(); ++i) {
      const std::size_t row_from_south = static_cast<std::size_t>(cell.rows - 1 - first) - i / columns;
      cell.posts[row_from_south * columns + i % columns] = rounded((*heights)[i], conversion);
    }
  }
  return cell;
}

}  // namespace yars::model::terrain::gdal
