// Where the tiles of a scene lie on the map and on the fan, and the columns that each of several hands draws.
#pragma once

#include <span>
#include <vector>

#include "model/hrm/crew.hpp"
#include "model/hrm/fan_grid.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/scene/scene_view.hpp"

namespace yars::model::hrm {

// From a tile's east, north, up to the plane of the map: exact at the origin, the tangent plane about it.
struct PlacedTile {
  const scene::Tile* tile = nullptr;
  double right_m = 0.0, up_m = 0.0;  // of the origin
  double right_east = 0.0, right_north = 0.0, up_east = 0.0, up_north = 0.0;
  float lift_m = 0.0F;                                              // up = 0 above the map plane
  float toward_east = 0.0F, toward_north = 0.0F, toward_up = 0.0F;  // unit vector to the radar
  float least_column = 0.0F, most_column = 0.0F;                    // of the fan, that it may cover
};

// Those that come near the fan, in their order.
std::vector<PlacedTile> place_tiles(const PatchGeometry& geometry, const FanGrid& grid,
                                    const std::vector<const scene::Tile*>& tiles, const Crew& crew);

// Strips at which `bands` runs of them begin that have about as many triangles each; behind them the last one's end.
std::vector<int> even_bands(const FanGrid& grid, std::span<const PlacedTile> tiles, int bands);

}  // namespace yars::model::hrm
