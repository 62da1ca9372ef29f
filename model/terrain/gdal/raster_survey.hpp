// What a raster in degrees of WGS84 holds, degree by degree, of its own posts and in one pass over the file: for a
// table of a raster of the whole earth, whose cells would take minutes one by one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lib/error/error.hpp"

namespace yars::model::terrain::gdal {

// Posts on an edge belong to both cells.
struct RasterCellFacts {
  int south_deg = 0, west_deg = 0;
  int columns = 0;  // of the raster in the cell
  std::size_t posts = 0, voids = 0, sea = 0;
  float lowest_m = 0.0F, highest_m = 0.0F;  // of the posts that have a height; 0 when none has
};

struct RasterFacts {
  std::vector<RasterCellFacts> cells;  // those of describe_raster()
  std::size_t impossible = 0;          // posts with heights that no ground has; among the voids
  std::vector<std::string> warnings;   // about the whole raster
};

// Nothing where the raster's rows and columns are no parallels and meridians of WGS84. `progress` gets the share that
// is done, (0, 1]. Errors: those of raster.hpp.
error::Expected<std::optional<RasterFacts>> survey_raster(const std::filesystem::path& path,
                                                          const std::function<void(double)>& progress);

}  // namespace yars::model::terrain::gdal
