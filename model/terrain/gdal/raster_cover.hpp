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
  double covered = 0.0;  // (0, 1] fraction of the cell that the raster covers; 0: posts on an edge of the cell alone
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
  // Cells beside them that have posts of the raster on an edge or a corner alone. `covered` is 0.
  std::vector<RasterCell> edges = {};
  // nullopt: not a DTED file. GDAL's coordinate system of a DTED file ignores its vertical datum and all horizontal
  // datums but WGS84 and WGS72.
  std::optional<DtedDatums> dted_datums = {};
};

// The declarations below are used in this folder only.
struct Raster;
struct Grid;

// The cells that a raster overlaps; may be empty. On a WGS84 grid, an overlap below a quarter of a pixel is ignored.
std::vector<RasterCell> cells_of(const Raster& raster);

// The cells that have posts of the raster on an edge or a corner alone. Empty for a raster that is no WGS84 grid: its
// cells_of() are those that its pixels, not their centres, overlap.
std::vector<RasterCell> edges_of(const Raster& raster);

// Posts of a cell that a raster may have, and some around them.
struct PostRange {
  int first_row = 0, end_row = 0;
  int first_column = 0, end_column = 0;
  bool overlaps(int row, int column, int other_end_row, int other_end_column) const {
    return row < end_row && first_row < other_end_row && column < end_column && first_column < other_end_column;
  }
};
PostRange touched_posts(const Raster& raster, const Grid& grid);

// True if each post of a cell with this resolution is the centre of a pixel of the raster.
bool posts_are_pixels(const Raster& raster, int posts_per_degree_north, int posts_per_degree_east);

}  // namespace yars::model::terrain::gdal
