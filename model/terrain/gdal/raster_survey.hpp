// Survey of a raster in degrees of WGS84: statistics of its pixels for each one-degree cell, in one pass over the file.
// Reason: a raster of the whole earth takes minutes if it is read cell by cell.
// Input: a file. Output: RasterStatistics. Units: heights [m MSL]. Errors: see raster.hpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lib/error/error.hpp"

namespace yars::model::terrain::gdal {

// Statistics of one cell. Pixels on the edge between two cells count in both cells.
struct RasterCellStatistics {
  int south_deg = 0, west_deg = 0;
  int columns = 0;                            // number of pixel columns within the cell
  std::size_t posts = 0, voids = 0, sea = 0;  // numbers of pixels: all, without a height, at exactly 0 m
  float lowest_m = 0.0F, highest_m = 0.0F;    // [m MSL] voids left out; 0 if all are void
};

struct RasterStatistics {
  std::vector<RasterCellStatistics> cells;  // the cells of describe_raster()
  std::size_t impossible = 0;               // number of pixels with impossible heights; they also count as voids
  std::vector<std::string> notes;           // about the whole raster
};

// Surveys a raster. nullopt if its rows and columns are not parallels and meridians of WGS84, or if its heights are
// ellipsoidal. Only read_raster() (raster.hpp) converts ellipsoidal heights to heights above mean sea level. `progress`
// receives the completed fraction of the work, (0, 1]; it may be empty.
error::Expected<std::optional<RasterStatistics>> survey_raster(const std::filesystem::path& path,
                                                               const std::function<void(double)>& progress);

}  // namespace yars::model::terrain::gdal
