// Survey of a raster in degrees of WGS84: statistics of its pixels for each cell, in one pass over the file.
// A raster of the whole earth would take minutes cell by cell.
// Input: a file. Output: RasterFacts. Units: heights [m MSL]. Errors: those of raster.hpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lib/error/error.hpp"

namespace yars::model::terrain::gdal {

// Statistics of one cell. Pixels on an edge count in both cells.
struct RasterCellFacts {
  int south_deg = 0, west_deg = 0;
  int columns = 0;  // of the raster within the cell
  std::size_t posts = 0, voids = 0, sea = 0;
  float lowest_m = 0.0F, highest_m = 0.0F;  // voids left out; 0 if all posts are void
};

struct RasterFacts {
  std::vector<RasterCellFacts> cells;  // those of describe_raster()
  std::size_t impossible = 0;          // posts with impossible heights; counted as voids too
  std::vector<std::string> warnings;   // about the whole raster
};

// nullopt if the raster's rows and columns are not parallels and meridians of WGS84. `progress` receives the share of
// the work that is done, (0, 1].
error::Expected<std::optional<RasterFacts>> survey_raster(const std::filesystem::path& path,
                                                          const std::function<void(double)>& progress);

}  // namespace yars::model::terrain::gdal
