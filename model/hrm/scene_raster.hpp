// Triangles of a scene drawn onto a fan from above: the highest surface over each grid point, its gamma, and where
// walls stand that face the radar (a wall has no extent from above). What lies on the ground (runways, roads) takes the
// ground's height and gives it its own gamma.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/hrm/fan_grid.hpp"
#include "model/hrm/placed_tile.hpp"
#include "model/hrm/raster_lanes.hpp"
#include "model/hrm/scene_surface.hpp"
#include "model/scene/scene_view.hpp"

namespace yars::model::hrm {

class SceneRaster {
 public:
  explicit SceneRaster(const radar::RadarConfiguration& configuration);

  // Draws what of the tiles falls into the columns [first, last), in the order of the tiles.
  void draw(const PatchGeometry& geometry, const FanGrid& grid, const scene::SceneView& scene,
            std::span<const PlacedTile> tiles, int first, int last, const lanes::SceneArrays& arrays);

 private:
  void transform(const PatchGeometry& geometry, const FanGrid& grid, const PlacedTile& placement);
  void read_kinds(const scene::SceneView& scene);
  void draw_tile(const scene::Tile& tile, const lanes::Canvas& canvas);
  lanes::GridVertices vertices_of(const scene::Tile& tile) {
    return {column_.data(), row_.data(), height_m_.data(), facing_.data(), tile.bare};
  }

  SceneSurface surface_;
  std::vector<float> cardinal_shares_;
  std::vector<float> gamma_, cardinal_;                  // by kind of the scene
  std::vector<float> column_, row_, height_m_, facing_;  // of the tile in hand, by vertex
  lanes::FoundTriangles found_;                          // of it, those that are drawn
  lanes::Fragments fragments_;
};

}  // namespace yars::model::hrm
