// Triangle model of a scene, flattened from its node tree.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/scene/openflight/node_tree.hpp"

namespace yars::model::scene {

// Polygons in space to triangles. A convex polygon becomes a fan, a concave one is cut by its ears in the plane of its
// Newell normal; the turning sense is kept. Corners that coincide or lie on a line give no triangle.
// Self-crossing polygons give triangles that cover them somehow, never more than corners - 2.

// Twice the vector area: its direction is the side from which the corners turn counter-clockwise.
Vector3 newell_normal(std::span<const Vector3> corners);

// Triangles as numbers of corners; `found` is cleared first.
void triangulate(std::span<const Vector3> corners, std::vector<std::array<std::uint32_t, 3>>& found);

// A scene as one set of triangles: nodes flattened, instances and external files put where they belong, x east, y
// north, z up, in metres from the origin. Of levels of detail the finest is taken: among siblings those with the least
// switch-out distance; of a switch what its current mask shows; of an animation the first picture. A two-sided polygon
// is there twice, once for each side. A subface lies 0.02 m before its face. Normals are unit and point to the side
// from which the corners turn counter-clockwise; where a file has none, or one of the other side, it is the facet's.
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

// A tree of nodes to a model: transforms multiplied out, instances and replications multiplied, the finest level of
// detail chosen, what `filter` (null: none) leaves out left out. External files come through `load`, which answers null
// where one is to be left out. Errors: what load() fails with; more than the limits allow; nodes nested deeper than
// kDeepestNode, as instances that contain themselves are.
inline constexpr int kMaxNodeDepth = 512;

// Bounds on what a small file can blow up to by instances and replications: memory at most 1.6 GB, some ten seconds.
struct FlattenLimits {
  std::size_t triangles = 16'000'000;
  std::size_t vertices = 48'000'000;
  std::size_t visits = 256'000'000;  // of nodes and corners, each as often as it is shown
};

using LoadExternal = std::function<error::Expected<std::shared_ptr<const Model>>(const std::string& name)>;

error::Expected<Model> flatten(const NodeTree& tree, const std::string& subject, const LoadExternal& load,
                               FlattenLimits limits = {}, NameFilter* filter = nullptr);

}  // namespace yars::model::scene
