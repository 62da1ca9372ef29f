// Rasters of land cover as classes by post of a one-degree cell, through GDAL and PROJ.
// Input: files as in raster.hpp, with one band of whole numbers, and the classes of a legend.
// Output: for each post the class that most pixels have whose centres lie in the square around it, which
//   reaches half way to the next posts, and the share of pixels with water. Of classes with equally many, the first in
//   the legend. Where posts are closer than pixels, the class of the pixel at the post.
// Errors: as in raster.hpp; a band that is not of whole numbers.
// Threads: the functions are thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/gdal/raster_cover.hpp"

namespace yars::model::terrain::gdal {

inline constexpr std::uint8_t kNoClass = 255;
inline constexpr std::size_t kMaxClasses = 255;  // of a legend

// A class of a legend.
struct PixelClass {
  std::vector<std::uint16_t> values;  // of the pixels
  bool water = false;
};

struct CoverSummary {
  std::vector<RasterCell> cells;
  double pixels_per_degree = 0.0;  // from south to north, in the first cell
};

// Reads the header only.
error::Expected<CoverSummary> describe_cover(const std::filesystem::path& path);

struct CoverPosts {
  int rows = 0, columns = 0;          // from the south, from the west; both edges of the degree included
  std::vector<std::uint8_t> classes;  // index into the legend; kNoClass: no pixel with a class
  // The same without the classes of water; kNoClass: no other.
  std::vector<std::uint8_t> land;
  std::vector<std::uint8_t> water;     // share of water, times 255
  std::map<int, std::size_t> unknown;  // pixels by value, of values that the legend has not
  std::vector<std::string> notes;      // about the rasters
};

// Reads the posts of one cell. A post without a class in the first raster has that of the next raster with one.
// Requires at least one raster and at most kMaxClasses classes.
error::Expected<CoverPosts> read_cover(const std::vector<std::filesystem::path>& rasters,
                                       const std::vector<PixelClass>& legend, int south_deg, int west_deg,
                                       int posts_per_degree_north, int posts_per_degree_east);

}  // namespace yars::model::terrain::gdal
