// Elevation rasters of any datum and projection as one-degree cells, through GDAL and PROJ.
// Input: a regular local file (GeoTIFF, JPEG 2000, Erdas Imagine, ASCII and BIL grids, ENVI, USGS DEM, DTED, HGT).
//   It has one band of heights of 16 bits or more, a coordinate system and a geotransform. A .vrt (virtual raster) is
//   an error, because it may name any path.
// Output: posts on WGS84 above mean sea level, rows from south to north, both edges of the degree included. Posts
//   outside the raster or without data are kNoHeight. 0 is sea; another height is at least one unit away from 0.
// Accuracy: let r be the rms height difference of two points of the raster that are half a pixel apart (half a post
//   spacing, if posts are coarser). Between posts, the rms difference of cell and raster is at most r / 4. The post
//   nearest to a summit has the height of the summit's pixel, or of its block if pixels are averaged in blocks.
// Errors: GDAL cannot open or read the file, the raster is not as above, the system lacks the library of GDAL or PROJ,
//   or the build has no GDAL (gdal_absent.cpp).
// Threads: the functions are thread-safe. Each call opens the file; a thread keeps the coordinate transformation of the
//   last one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/gdal/raster_cover.hpp"

namespace yars::model::terrain::gdal {

inline constexpr std::int16_t kNoHeight = -32768;

// False in a build without GDAL.
bool available();

// Lists the cells of a raster. Reads the header only.
error::Expected<RasterSummary> describe_raster(const std::filesystem::path& path);

struct RasterPosts {
  int rows = 0;
  int columns = 0;
  double unit_m = 1.0;                // [m] height of post value 1; one or a few decimetres for fractional heights
  std::vector<std::int16_t> posts;    // [unit_m]
  std::size_t impossible = 0;         // number of pixels with impossible heights, treated as pixels without data
  std::vector<std::string> notes;     // about the rasters that were read
  std::vector<std::string> problems;  // about further rasters that could not be read
};

// Reads the posts of one cell. If posts are coarser than pixels, blocks of pixels, at most half a post interval wide,
// are averaged first. A post that is void in the first raster is read from the first of the others that has it; one
// that cannot be read is a problem. Then a void post on an edge of the cell takes the height of the outermost pixel of
// a raster, if that pixel's centre is at most one pixel away: many tiles end one pixel short of their southern and
// eastern edges. Requires at least one raster.
error::Expected<RasterPosts> read_raster(const std::vector<std::filesystem::path>& rasters, int south_deg, int west_deg,
                                         int posts_per_degree_north, int posts_per_degree_east);

}  // namespace yars::model::terrain::gdal
