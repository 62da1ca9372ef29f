// Scene tiles on the polar grid: where they lie, and their triangles drawn from above.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/parallel/thread_pool.hpp"
#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/hrm/scene_raster_simd.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/scene/placement/scene_view.hpp"

namespace yars::model::hrm {

// Where the tiles of a scene lie on the map and on the fan, and the columns that each of several hands draws.

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
std::vector<PlacedTile> place_tiles(const PatchGeometry& geometry, const PolarGrid& grid,
                                    const std::vector<const scene::Tile*>& tiles, const parallel::Executor& crew);

// Strips at which `bands` runs of them begin that have about as many triangles each; behind them the last one's end.
std::vector<int> even_bands(const PolarGrid& grid, std::span<const PlacedTile> tiles, int bands);

// Triangles of a scene drawn onto a fan from above: the highest surface over each grid point, its gamma, and where
// walls stand that face the radar (a wall has no extent from above). What lies on the ground (runways, roads) takes the
// ground's height and gives it its own gamma.
class SceneRaster {
 public:
  explicit SceneRaster(const radar::RadarConfiguration& configuration);

  // Draws what of the tiles falls into the columns [first, last), in the order of the tiles.
  void draw(const PatchGeometry& geometry, const PolarGrid& grid, const scene::SceneView& scene,
            std::span<const PlacedTile> tiles, int first, int last, const simd::SceneArrays& arrays);

 private:
  void transform(const PatchGeometry& geometry, const PolarGrid& grid, const PlacedTile& placement);
  void read_kinds(const scene::SceneView& scene);
  void draw_tile(const scene::Tile& tile, const simd::Canvas& canvas);
  simd::GridVertices vertices_of(const scene::Tile& tile) {
    return {column_.data(), row_.data(), height_m_.data(), facing_.data(), tile.bare};
  }

  physics::SceneSurface surface_;
  std::vector<float> cardinal_shares_;
  std::vector<float> gamma_, cardinal_;                  // by kind of the scene
  std::vector<float> column_, row_, height_m_, facing_;  // of the tile in hand, by vertex
  simd::FoundTriangles found_;                           // of it, those that are drawn
  simd::Fragments fragments_;
};

}  // namespace yars::model::hrm
