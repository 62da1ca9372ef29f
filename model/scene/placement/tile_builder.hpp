// Builder of a scene's tiles (scene_view.hpp) from triangles that have been placed on the earth.
// Inputs: triangles with normals and tags; corners as plane coordinates of the scene (scene_view.hpp) and altitude MSL.
// Outputs: Tiles with joined vertices.
// Units: metres.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "lib/geo/frames.hpp"
#include "model/scene/openflight/node_tree.hpp"
#include "model/scene/placement/geometry.hpp"
#include "model/scene/placement/scene_view.hpp"

namespace yars::model::scene {

inline constexpr double kTileSide_m = 128.0;  // side of a tile's square

// Attributes of a triangle that is added to a tile.
struct SurfaceTag {
  std::uint16_t kind = 0;    // index into SceneView::kinds()
  std::uint32_t object = 0;  // index into SceneView::objects()
  bool on_ground = false;    // lies on the ground and only sets the ground's gamma
};

// Vertex of a tile under construction.
struct DraftVertex {
  float east_m, north_m;  // from the tile's origin
  double altitude_m;      // MSL
  std::array<float, 3> normal;
};

struct DraftTriangle {
  std::array<std::uint16_t, 3> corners;
  SurfaceTag tag;
  bool flat;  // vertex normals equal the triangle's normal (within 0.8 degrees)
};

// Fills the triangles and vertices of `tile`. Reorders `triangles` and renumbers their corners. Altitudes become
// heights above Tile::zero_msl_m.
// Triangles on the ground come first and keep their order, because later ones are painted over earlier ones. Vertices
// without a normal precede vertices with a normal. Each of these two groups is numbered by first use.
void finish_tile(const std::vector<DraftVertex>& vertices, std::vector<DraftTriangle>& triangles, Tile& tile);

struct PlacedCorner {
  Vector3 position;              // [m] east and north on the scene's plane, altitude MSL
  Vector3 normal;                // unit, along the same axes
  std::uint32_t vertex = kNone;  // index into Model::vertices; kNone: not shared with other corners
};

// Sorts the triangles of one scene into tiles, by the square that contains a triangle's centre. In a tile, vertices of
// flat triangles are joined if their positions are equal. Other vertices are joined if they are the same vertex of
// the model.
class TileBuilders {
 public:
  TileBuilders(const geo::AzimuthalEquidistant& plane, std::size_t model_vertices);

  void add(const std::array<PlacedCorner, 3>& corners, SurfaceTag tag);
  // Returns the transform from the scene's plane to the plane of the square that contains `point`.
  const LocalMap& map_at(geo::PlanePoint point);
  // Returns the tiles row by row from the south, each row from west to east. Tile::zero_msl_m becomes `zero_msl_m`
  // rounded down to whole metres, or 0 if not finite. The builder cannot be used afterwards.
  std::vector<Tile> take(double zero_msl_m);

 private:
  using Square = std::pair<std::int32_t, std::int32_t>;  // row, column
  struct Builder {
    Builder(const LocalMap& local, std::uint32_t order) : map(local), number(order) {}
    LocalMap map;
    std::uint32_t number;  // in order of creation
    std::vector<DraftVertex> vertices;
    std::vector<DraftTriangle> triangles;
  };
  using Pieces = std::vector<std::unique_ptr<Builder>>;  // tiles of one square, in order of creation
  static bool is_full(const Builder& builder);
  Builder& builder_at(geo::PlanePoint point);
  std::uint16_t vertex_in(Builder& builder, const PlacedCorner& corner);

  geo::AzimuthalEquidistant plane_;
  std::map<Square, Pieces> squares_;
  std::uint32_t builders_ = 0;
  Builder* last_ = nullptr;
  Square last_square_{};
  struct Copy {
    std::uint32_t builder = kNone;
    std::uint16_t vertex = 0;
  };
  std::vector<Copy> copies_;  // for each vertex of the model: its newest copy in a builder
};

// [bytes] Memory of a tile.
std::uint64_t bytes_of(const Tile& tile);

}  // namespace yars::model::scene
