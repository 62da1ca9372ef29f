// What a patch map needs before it can be made: which terrain, and how far beyond its window it has to look.
#pragma once

#include <vector>

#include "model/hrm/crew.hpp"
#include "model/hrm/fan_grid.hpp"
#include "model/scene/scene_view.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::hrm {

// Terrain about the window, and on the way to it, which may be coarser.
struct PatchNeed {
  terrain::TerrainRegion window;
  terrain::TerrainRegion path;
};
PatchNeed patch_need(const PatchOrder& order, int pixels);

// For what stands or lies outside the window and is laid over or shades into it: by the relief of the ground and the
// things of the tiles.
FanMargins fan_margins(const PatchGeometry& geometry, const terrain::TerrainView& ground,
                       const std::vector<const scene::Tile*>& tiles, const Crew& crew);

}  // namespace yars::model::hrm
