#include "model/terrain/coverage.hpp"

#include <algorithm>

#include "lib/failure/require.hpp"
#include "model/terrain/region_cells.hpp"

namespace yars::model::terrain {

bool touches(const DirectoryIndex& index, const TerrainRegion& region) {
  const std::vector<CellPlace> places = cells_within(region);
  return std::any_of(places.begin(), places.end(), [&](CellPlace place) { return index.contains(slot_of(place)); });
}

Coverage coverage_of(const DirectoryIndex& index) {
  YARS_REQUIRE(index.empty(), ==, false);
  CellPlace lowest{90, 180};
  CellPlace highest{-90, -180};
  for (const auto& [slot, file] : index) {
    const CellPlace place = place_of_slot(slot);
    lowest = {std::min(lowest.south_deg, place.south_deg), std::min(lowest.west_deg, place.west_deg)};
    highest = {std::max(highest.south_deg, place.south_deg), std::max(highest.west_deg, place.west_deg)};
  }
  return {lowest.south_deg, highest.south_deg + 1, lowest.west_deg, highest.west_deg + 1};
}

std::string coverage_text(const DirectoryIndex& index) {
  const Coverage all = coverage_of(index);
  return "latitude " + std::to_string(all.south_deg) + " to " + std::to_string(all.north_deg) + ", longitude " +
         std::to_string(all.west_deg) + " to " + std::to_string(all.east_deg);
}

}  // namespace yars::model::terrain
