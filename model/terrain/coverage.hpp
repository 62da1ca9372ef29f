// What the cells of a folder cover, for people who look elsewhere.
#pragma once

#include <string>

#include "model/terrain/directory_index.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::terrain {

// Whether any cell may lie within the region.
bool touches(const DirectoryIndex& index, const TerrainRegion& region);

// Whole degrees about all cells; longitudes as the cells have them.
struct Coverage {
  int south_deg = 0, north_deg = 0, west_deg = 0, east_deg = 0;
};

// Requires an index that is not empty.
Coverage coverage_of(const DirectoryIndex& index);

// "latitude 36 to 39, longitude -124 to -120". Likewise.
std::string coverage_text(const DirectoryIndex& index);

}  // namespace yars::model::terrain
