// The one-degree cells that a disc on the earth touches; a few that it only nears may be among them.
// Works across the antimeridian and over the poles. Result in ascending slot order, each once.
#pragma once

#include <vector>

#include "model/terrain/cell.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::terrain {

std::vector<CellPlace> cells_within(const TerrainRegion& region);

// Great-circle angle [deg] from a point to a cell's middle. A disc touches no cell that is farther than
// touched_within_deg() of its radius.
double angle_to_middle_deg(geo::GeoPoint point, CellPlace place);
double touched_within_deg(double radius_m);

}  // namespace yars::model::terrain
