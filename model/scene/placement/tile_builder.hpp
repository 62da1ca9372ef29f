// Tiles of a scene from its triangles.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "model/scene/openflight/node_tree.hpp"
#include "model/scene/placement/plan_geometry.hpp"
#include "model/scene/placement/scene_view.hpp"

namespace yars::model::scene {

inline constexpr double kTileSide_m = 128.0;

// A tile before its vertices are joined: how triangles are collected, and how they become arrays.
struct SurfaceTag {
  std::uint16_t kind = 0;
  std::uint32_t object = 0;
  bool on_ground = false;
};

struct DraftVertex {
  float east_m, north_m;  // of the tile's origin
  double altitude_m;      // MSL
  std::array<float, 3> normal;
};

struct DraftTriangle {
  std::array<std::uint16_t, 3> corners;
  SurfaceTag tag;
  bool flat;  // its vertices' normals say nothing that its own does not
};

// Fills a tile's triangles and vertices, altitudes counted from its zero. Those on the ground come first; among
// themselves they stay in order, for the later is painted over the earlier. Vertices are numbered as triangles need
// them, the bare ones first.
void finish_tile(const std::vector<DraftVertex>& vertices, std::vector<DraftTriangle>& triangles, Tile& tile);

struct PlacedCorner {
  Vector3 position;              // metres east and north on the scene's plane, altitude MSL
  Vector3 normal;                // unit, along the same axes
  std::uint32_t vertex = kNone;  // of the model; kNone: shared with no other corner
};

// Tiles of one scene while triangles are sorted into them: the square of a scene's plane that holds a triangle's middle
// is its tile. Of a tile's vertices, those of flat triangles are one where they lie in one place; of others, where
// they come from one vertex of the model.
class TileBuilders {
 public:
  TileBuilders(const Plane& plane, std::size_t model_vertices);

  void add(const std::array<PlacedCorner, 3>& corners, SurfaceTag tag);
  // The map of the square that a point lies in.
  const LocalMap& map_at(PlanePoint point);
  // Ends the work: tiles from south to north and west to east, without spare room.
  std::vector<Tile> take(double zero_msl_m);

 private:
  using Square = std::pair<std::int32_t, std::int32_t>;  // row, column
  struct Builder {
    Builder(const LocalMap& local, std::uint32_t order) : map(local), number(order) {}
    LocalMap map;
    std::uint32_t number;
    std::vector<DraftVertex> vertices;
    std::vector<DraftTriangle> triangles;
  };
  using Pieces = std::vector<std::unique_ptr<Builder>>;  // of a square, in order
  static bool is_full(const Builder& builder);
  Builder& builder_at(PlanePoint point);
  std::uint16_t vertex_in(Builder& builder, const PlacedCorner& corner);

  Plane plane_;
  std::map<Square, Pieces> squares_;
  std::uint32_t builders_ = 0;
  Builder* last_ = nullptr;
  Square last_square_{};
  struct Copy {
    std::uint32_t builder = kNone;
    std::uint16_t vertex = 0;
  };
  std::vector<Copy> copies_;  // the newest copy of each vertex of the model
};

std::uint64_t bytes_of(const Tile& tile);

}  // namespace yars::model::scene
