// Coverage of a raster: the cells of 1 x 1 degree that it overlaps, each with covered fraction and posts per degree.
// Input: the header of an opened raster. Output: one RasterCell per cell.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace yars::model::terrain::gdal {

inline constexpr int kMaxPostsPerDegree = 7200;  // one post per 0.5 arc seconds; more posts need too much memory

struct RasterCell {
  int south_deg = 0;
  int west_deg = 0;
  double covered = 0.0;  // (0, 1] fraction of the cell that the raster covers
  // The raster's resolution if its pixels are posts of the cell. Otherwise at least twice that resolution, but at most
  // kMaxPostsPerDegree.
  int posts_per_degree_north = 0;
  int posts_per_degree_east = 0;
};

// Datums in the description record of a DTED file, as written there.
struct DtedDatums {
  std::string vertical, horizontal;
};

struct RasterSummary {
  std::vector<RasterCell> cells;  // cells that the raster overlaps
  // nullopt: not a DTED file. GDAL's coordinate system of a DTED file ignores its vertical datum and all horizontal
  // datums but WGS84 and WGS72.
  std::optional<DtedDatums> dted_datums = {};
};

// The declarations below are used in this folder only.
struct Raster;

// The cells that a raster overlaps; may be empty. On a WGS84 grid, an overlap below a quarter of a pixel is ignored.
std::vector<RasterCell> cells_of(const Raster& raster);

// True if each post of a cell with this resolution is the centre of a pixel of the raster.
bool posts_are_pixels(const Raster& raster, int posts_per_degree_north, int posts_per_degree_east);

}  // namespace yars::model::terrain::gdal
