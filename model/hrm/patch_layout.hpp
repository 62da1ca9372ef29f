// What a patch map needs before it can be made: which terrain, and how far beyond its window it has to look.
#pragma once

#include <vector>

#include "model/hrm/crew.hpp"
#include "model/hrm/fan_grid.hpp"
#include "model/scene/scene_view.hpp"
#include "model/terrain/smooth_view.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::hrm {

// Terrain about the window, and on the way to it, which may be coarser: by the fidelity's posts a sample, for all posts
// of what is read raise the horizon (decision 19).
struct PatchNeed {
  terrain::TerrainRegion window;
  terrain::TerrainRegion path;
};
PatchNeed patch_need(const PatchOrder& order, const radar::Fidelity& fidelity);

// Where on the earth the fan reads its ground, and how finely; `tiles` stand on ground that is straight between posts.
terrain::SmoothOrder smooth_order(const PatchGeometry& geometry, const FanGrid& grid, const radar::Fidelity& fidelity,
                                  const std::vector<const scene::Tile*>& tiles);

// For what stands or lies outside the window and is laid over or shades into it: by the relief of the ground and the
// things of the tiles.
FanMargins fan_margins(const PatchGeometry& geometry, const terrain::TerrainView& ground,
                       const std::vector<const scene::Tile*>& tiles, const Crew& crew);

}  // namespace yars::model::hrm
