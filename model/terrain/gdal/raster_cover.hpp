// Coverage of a raster: the cells that it touches, the share of each, and the posts per degree that they need.
// Input: an opened raster; its header only. Output: RasterCell per degree.
#pragma once

#include <vector>

namespace yars::model::terrain::gdal {

inline constexpr int kMaxPostsPerDegree = 7200;  // 0.5 arc seconds; cells with more posts need too much memory

struct RasterCell {
  int south_deg = 0;
  int west_deg = 0;
  double covered = 0.0;  // (0, 1] share of the degree that the raster spans
  // The raster's resolution if its pixels are posts of the cell, else at least twice as fine.
  int posts_per_degree_north = 0;
  int posts_per_degree_east = 0;
};

struct RasterSummary {
  std::vector<RasterCell> cells;  // that the raster touches by more than a quarter of a pixel
};

// The rest is private to this folder.
struct Raster;

// The cells that a raster touches; may be empty.
std::vector<RasterCell> cells_of(const Raster& raster);

// True if each post of a cell with these intervals is the centre of a pixel of the raster.
bool posts_are_pixels(const Raster& raster, int posts_per_degree_north, int posts_per_degree_east);

}  // namespace yars::model::terrain::gdal
