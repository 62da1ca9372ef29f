// A tile before its vertices are joined: how triangles are collected, and how they become arrays.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/scene/scene_view.hpp"

namespace yars::model::scene {

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

}  // namespace yars::model::scene
