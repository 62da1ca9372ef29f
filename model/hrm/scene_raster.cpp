#include "model/hrm/scene_raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace yars::model::hrm {

SceneRaster::SceneRaster(const radar::RadarConfiguration& configuration)
    : surface_(configuration), cardinal_shares_(surface_.cardinal_shares()) {}

void SceneRaster::transform(const PatchGeometry& geometry, const FanGrid& grid, const PlacedTile& placement) {
  const scene::Tile& tile = *placement.tile;
  const std::size_t count = tile.east_m.size();
  for (std::vector<float>* numbers : {&column_, &row_, &height_m_, &facing_})
    if (numbers->size() < count) numbers->resize(count);
  lanes::VertexMap map{};
  map.right_m = static_cast<float>(placement.right_m);
  map.up_m = static_cast<float>(placement.up_m);
  map.right_east = static_cast<float>(placement.right_east);
  map.right_north = static_cast<float>(placement.right_north);
  map.up_east = static_cast<float>(placement.up_east);
  map.up_north = static_cast<float>(placement.up_north);
  map.lift_m = placement.lift_m;
  map.toward_east = placement.toward_east;
  map.toward_north = placement.toward_north;
  map.toward_up = placement.toward_up;
  map.centre_m = static_cast<float>(geometry.distance_m());
  map.columns_a_tangent = static_cast<float>(1.0 / grid.tangent_step);
  map.middle_column = static_cast<float>(-grid.first_tangent / grid.tangent_step);
  map.rows_a_metre = static_cast<float>(1.0 / grid.spacing_m);
  map.middle_row = static_cast<float>((geometry.distance_m() - grid.first_distance_m) / grid.spacing_m);
  lanes::place_vertices(count,
                        {tile.east_m.data(), tile.north_m.data(), tile.up_m.data(), tile.normal_east.data(),
                         tile.normal_north.data(), tile.normal_up.data()},
                        map, vertices_of(tile));
}

void SceneRaster::read_kinds(const scene::SceneView& scene) {
  gamma_.clear();
  cardinal_.clear();
  for (const scene::SurfaceKind& kind : scene.kinds()) {
    gamma_.push_back(static_cast<float>(surface_.gamma(kind.material)));
    cardinal_.push_back(static_cast<float>(surface_.cardinal(kind.material)));
  }
}

void SceneRaster::draw(const PatchGeometry& geometry, const FanGrid& grid, const scene::SceneView& scene,
                       std::span<const PlacedTile> tiles, int first, int last, const lanes::SceneArrays& arrays) {
  read_kinds(scene);
  lanes::Canvas canvas;
  canvas.grid = &grid;
  canvas.arrays = arrays;
  canvas.cardinal = {cardinal_shares_, static_cast<float>(surface_.steps_a_sine())};
  lanes::GridLimits& limits = canvas.limits;
  limits.first_column = static_cast<float>(first);
  limits.last_column = static_cast<float>(last);
  limits.first_row = -lanes::kSurfaceReach;
  limits.last_row = static_cast<float>(grid.rows);
  limits.row_height_m = static_cast<float>(grid.spacing_m);
  limits.wall_normal2 = static_cast<float>(kWallNormal2);
  for (const PlacedTile& placement : tiles) {
    if (!(placement.most_column >= limits.first_column && placement.least_column < limits.last_column)) continue;
    const double distance_m = std::hypot(placement.right_m, placement.up_m + geometry.distance_m());
    const double tangent = placement.right_m / std::max(placement.up_m + geometry.distance_m(), 1.0);
    limits.column_width_m = static_cast<float>(distance_m * grid.tangent_step / (1.0 + tangent * tangent));
    limits.sine = placement.toward_up;
    limits.cosine = std::sqrt(1.0F - placement.toward_up * placement.toward_up);
    transform(geometry, grid, placement);
    draw_tile(*placement.tile, canvas);
  }
}

void SceneRaster::draw_tile(const scene::Tile& tile, const lanes::Canvas& canvas) {
  const lanes::GridVertices vertices = vertices_of(tile);
  const lanes::Corners corners{tile.corner[0].data(), tile.corner[1].data(), tile.corner[2].data()};
  const lanes::TileSurfaces surfaces{tile.kind.data(), gamma_.data(), cardinal_.data()};
  lanes::select_triangles(0, tile.on_ground, corners, vertices, canvas.limits, found_);
  lanes::paint_ground(found_, surfaces, vertices, canvas);
  lanes::select_triangles(tile.on_ground, tile.triangles(), corners, vertices, canvas.limits, found_);
  lanes::draw_standing(found_, surfaces, vertices, canvas, fragments_);
}

}  // namespace yars::model::hrm
