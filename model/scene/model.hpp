// A scene as one set of triangles: nodes flattened, instances and external files put where they belong, x east, y
// north, z up, in metres from the origin. Of levels of detail the finest is taken: among siblings those with the least
// switch-out distance; of a switch what its current mask shows; of an animation the first picture. A two-sided polygon
// is there twice, once for each side. A subface lies 0.02 m before its face. Normals are unit and point to the side
// from which the corners turn counter-clockwise; where a file has none, or one of the other side, it is the facet's.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "model/scene/node_tree.hpp"

namespace yars::model::scene {

struct ModelVertex {
  std::array<float, 3> place_m{};  // from Model::base
  std::array<float, 3> normal{};
};

struct ModelTriangle {
  std::array<std::uint32_t, 3> corners{};  // into vertices
  std::uint32_t object = 0;                // into objects
  std::uint16_t kind = 0;                  // into kinds
};

struct Model {
  Header header;      // of the file itself
  FileCounts counts;  // with those of external files, each file once
  Vector3 base;       // [m] zero unless the file lies far from its origin
  std::vector<ModelVertex> vertices;
  std::vector<ModelTriangle> triangles;
  std::vector<std::string> objects;  // names; number 0 is what lies outside objects
  std::vector<SurfaceKind> kinds;
  std::uint64_t polygons = 0;      // that the triangles come from, instances counted each time
  std::vector<std::string> files;  // external files read, in order
  std::vector<std::string> warnings;
};

inline constexpr float kSubfaceLift_m = 0.02F;

}  // namespace yars::model::scene
