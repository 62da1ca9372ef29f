// Draws scene triangles, as seen from above, onto the polar grid of a patch map.
// Inputs: tiles of a SceneView, the surface of the ground. Outputs by grid point: highest surface, its gamma, walls.
// Units: metres; columns (azimuth) and rows (distance over ground) of the polar grid (patch_geometry.hpp).
// Threads: one SceneRaster per thread; threads draw disjoint ranges of columns (bands).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/parallel/thread_pool.hpp"
#include "model/hrm/algorithm.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/hrm/scene_raster_simd.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/scene/placement/scene_view.hpp"

namespace yars::model::hrm {

// Transform of a tile to the map plane: exact at the tile's origin, linear about the origin.
// `right` and `up` are directions in the map picture, as in MapPoint: up leads away from the aircraft.
struct PlacedTile {
  const scene::Tile* tile = nullptr;
  double right_m = 0.0, up_m = 0.0;                                           // tile's origin, from the map's centre
  double right_east = 0.0, right_north = 0.0, up_east = 0.0, up_north = 0.0;  // right and up per metre east, north
  float lift_m = 0.0F;  // height of the tile's vertical zero (Tile::zero_msl_m) above the map plane
  float toward_east = 0.0F, toward_north = 0.0F, toward_up = 0.0F;  // unit vector to the radar; toward_up: vertical
  float min_column = 0.0F, max_column = 0.0F;                       // grid columns that the tile's bounds span
};

// Places the tiles that overlap the polar grid, in the order of `tiles`.
std::vector<PlacedTile> place_tiles(const PatchGeometry& geometry, const PolarGrid& grid,
                                    const std::vector<const scene::Tile*>& tiles, const parallel::Executor& executor);

// Divides the strips of the sector (16 columns each) into `bands` contiguous bands with about equal numbers of
// triangles. Returns the first strip of each band, followed by the end of the sector.
std::vector<int> even_bands(const PolarGrid& grid, std::span<const PlacedTile> tiles, int bands);

// Draws scene triangles onto the polar grid as seen from above. At each grid point the highest surface wins. Walls have
// little or no area from above, so their return is summed as WallPoint. Surfaces on the ground, for example runways,
// set the ground's gamma and do not change its height.
class SceneRaster {
 public:
  explicit SceneRaster(const physics::SceneSurface& surface);

  // Draws the part of the tiles within the columns [first, last), in the order of the tiles.
  void draw(const PatchGeometry& geometry, const PolarGrid& grid, const scene::SceneView& scene,
            std::span<const PlacedTile> tiles, int first, int last, const simd::SceneArrays& arrays);

 private:
  void transform(const PatchGeometry& geometry, const PolarGrid& grid, const PlacedTile& placement);
  void read_kinds(const scene::SceneView& scene);
  void draw_tile(const scene::Tile& tile, const simd::Canvas& canvas);
  simd::GridVertices vertices_of(const scene::Tile& tile) {
    return {column_.data(), row_.data(), height_m_.data(), facing_.data(), tile.first_with_normal};
  }

  physics::SceneSurface surface_;
  std::vector<float> cardinal_effect_;                   // as simd::CardinalShape::effect
  std::vector<float> gamma_, cardinal_;                  // by surface kind of the scene
  std::vector<std::uint8_t> material_;                   // the same
  std::vector<float> column_, row_, height_m_, facing_;  // current tile, by vertex
  simd::FoundTriangles found_;                           // triangles of the current tile that are to be drawn
  simd::Fragments fragments_;
};

// Draws a scene onto the polar grid with all threads of an executor, and owns the array of walls.
class PolarScene {
 public:
  explicit PolarScene(const physics::RadarParameters& parameters) : surface_(parameters) {}

  // Call before each map, before its sectors. If the map has tiles, enlarges the array of walls as needed, and sets the
  // array to zero if it has grown or if an earlier map has left walls in it.
  void begin(const PatchData& data);
  // Draws onto `data.surface`, or onto a copy of it for an algorithm that reads the scene in another way. Also draws
  // the labels of the surfaces if the map has labels.
  void draw(const PatchInputs& inputs, PatchData& data) { draw(inputs, data, data.surface.data()); }
  void draw(const PatchInputs& inputs, PatchData& data, SurfacePoint* surface);

  // Null if the map has no tiles. The stage that reads the walls must set them to zero and then call set_clear().
  WallPoint* walls() { return drawn_ ? walls_.data() : nullptr; }
  void set_clear() { dirty_ = false; }

 private:
  physics::SceneSurface surface_;
  std::vector<SceneRaster> rasters_;  // by thread
  PolarArray<WallPoint> walls_;
  std::vector<PlacedTile> placed_;
  bool drawn_ = false;  // true if the map has tiles
  bool dirty_ = false;  // true if walls have been drawn and not yet set to zero
};

}  // namespace yars::model::hrm
