// Rasters of heights that GDAL opens, as one-degree cells. The only door to GDAL; a build without it has the same
// functions, which fail with a word (gdal_absent.cpp).
// Opened are plain files through drivers that read one local file: GeoTIFF, JPEG 2000, Erdas Imagine, ASCII and BIL
// grids, ENVI, USGS DEM, DTED, HGT. Never a .vrt: it may name any path or address.
// A raster needs one band of 16-bit or real heights, a coordinate system and a geotransform; any datum is brought to
// WGS84, any unit to metres, ellipsoidal heights to mean sea level, each by PROJ (georeference.hpp).
// Posts: rows from south to north, both edges of the degree included; kNoHeight outside the raster and where it has no
// data. Between its posts a cell is what lies between the raster's, to within a quarter of their own error of slope
// (rms; half a spacing times the slope), and a summit keeps its height. A height that is not 0 m is at least a unit
// away from it (0 m means sea).
// Errors: GDAL cannot open or read it, or it is not such a raster. Thread-safe: each call opens the file anew.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/terrain/gdal/raster_cover.hpp"

namespace yars::model::terrain::gdal {

inline constexpr std::int16_t kNoHeight = -32768;

// False where YARS was built without GDAL.
bool available();

// From the header alone.
error::Expected<RasterSummary> describe_raster(const std::filesystem::path& path);

struct RasterPosts {
  int rows = 0;
  int columns = 0;
  double unit_m = 1.0;                // [m] of a post; a tenth or a few where the raster has fractions
  std::vector<std::int16_t> posts;    // [unit_m]
  std::size_t impossible = 0;         // of the raster's own posts, heights that no ground has; they are void
  std::vector<std::string> warnings;  // about the whole raster
};

// The posts of one degree, so many intervals a side; coarser than the raster: of means over half a post or less.
error::Expected<RasterPosts> read_raster(const std::filesystem::path& path, int south_deg, int west_deg,
                                         int posts_per_degree_north, int posts_per_degree_east);

}  // namespace yars::model::terrain::gdal
