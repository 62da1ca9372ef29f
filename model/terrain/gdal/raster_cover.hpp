// Which cells a raster touches, how much of each it spans, and how fine their posts have to be.
#pragma once

#include <vector>

namespace yars::model::terrain::gdal {

inline constexpr int kMaxPostsPerDegree = 7200;  // 0.5 arc seconds: a cell of finer posts would not fit in memory

struct RasterCell {
  int south_deg = 0;
  int west_deg = 0;
  double covered = 0.0;  // (0, 1] share of the degree that the raster spans
  // The raster's own posts where they are the cell's too; else twice as fine or more.
  int posts_per_degree_north = 0;
  int posts_per_degree_east = 0;
};

struct RasterSummary {
  std::vector<RasterCell> cells;  // that the raster touches by more than a quarter of a pixel
};

// What follows is private to this folder.
struct Raster;

// From the header alone. Empty: it touches none.
std::vector<RasterCell> cells_of(const Raster& raster);

// Whether the posts of a cell of so many intervals are pixels of the raster, each at its own place.
bool posts_are_pixels(const Raster& raster, int posts_per_degree_north, int posts_per_degree_east);

}  // namespace yars::model::terrain::gdal
