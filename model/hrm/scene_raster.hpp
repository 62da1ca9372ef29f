// Triangles of a scene drawn onto a fan from above: the highest surface over each grid point, its gamma, and where
// walls stand that face the radar (a wall has no extent from above). What lies flat on the ground (runways, roads)
// takes the ground's height and gives it its own gamma.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/hrm/fan_grid.hpp"
#include "model/hrm/scene_lanes.hpp"
#include "model/hrm/scene_surface.hpp"
#include "model/scene/scene_view.hpp"

namespace yars::model::hrm {

// By FanGrid::at().
struct SceneArrays {
  float* height_m = nullptr;   // above the map plane; in: the ground, out: the highest surface
  float* gain = nullptr;       // gamma; negative where a thing stands on the ground
  float* wall_gain = nullptr;  // gamma of a facing wall in front of this point; in: zero
};

class SceneRaster {
 public:
  explicit SceneRaster(const radar::RadarConfiguration& configuration);

  // Draws what of the tiles falls into the columns [first, last), in the order of the tiles.
  void draw(const PatchGeometry& geometry, const FanGrid& grid, const scene::SceneView& scene,
            const std::vector<const scene::Tile*>& tiles, int first, int last, const SceneArrays& arrays);

 private:
  // A vertex on the grid, and how squarely its surface faces the radar.
  struct Vertex {
    float column, row, height_m, facing;
  };
  // From a tile's east, north, up to the plane of the map: exact at the origin, the tangent plane about it.
  struct Placement {
    double right_m, up_m;  // of the origin
    double right_east, right_north, up_east, up_north;
    float lift_m;                                // up = 0 above the map plane
    float toward_east, toward_north, toward_up;  // unit vector to the radar
  };
  // Where a tile is drawn, and what a grid cell is there.
  struct Canvas {
    const FanGrid* grid;
    SceneArrays arrays;
    int first, last;  // columns
    float column_width_m, row_height_m;
    float sine, cosine;  // of the grazing angle
  };
  using Triangle = std::array<Vertex, 3>;
  struct Facet;
  struct Surface {
    std::size_t code;  // of the material
    float base_m;      // of the object, above the map plane
  };

  Placement place(const PatchGeometry& geometry, const scene::Tile& tile) const;
  bool overlaps(const PatchGeometry& geometry, const FanGrid& grid, const Placement& placement, const scene::Tile& tile,
                int first, int last) const;
  Vertex on_grid(const PatchGeometry& geometry, const FanGrid& grid, const Placement& placement, float east_m,
                 float north_m, float height_m) const;
  void transform(const PatchGeometry& geometry, const FanGrid& grid, const Placement& placement,
                 const scene::Tile& tile);
  void draw_tile(const scene::SceneView& scene, const scene::Tile& tile, const Placement& placement,
                 const Canvas& canvas);
  void draw_triangle(const Canvas& canvas, const Triangle& corner, const Surface& surface) const;
  // The plane of a triangle over the grid: value + by_column * column + by_row * row.
  struct Plane {
    float value, by_column, by_row;
    float at(float column, float row) const { return value + by_column * column + by_row * row; }
  };
  static float shading(const Triangle& corner, float facing);
  static void fill(const Canvas& canvas, const Triangle& corner, const Plane& plane, float gain, bool flat);
  static void mark_wall(const Canvas& canvas, const Triangle& corner, float gain);

  SceneSurface surface_;
  lanes::GridVertices vertices() { return {column_.data(), row_.data(), height_m_.data(), facing_.data()}; }
  Vertex vertex(std::size_t i) const { return {column_[i], row_[i], height_m_[i], facing_[i]}; }

  std::vector<float> column_, row_, height_m_, facing_;  // of the tile in hand, by vertex
  std::vector<std::uint32_t> found_;                     // triangles of it that are drawn
};

}  // namespace yars::model::hrm
