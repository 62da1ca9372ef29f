// Triangle model of an OpenFlight scene, flattened from its node tree; polygon triangulation.
// Inputs: a NodeTree, a loader of external files, a filter of names. Outputs: one set of triangles with objects and
// kinds.
// Units: metres. Frame: x east, y north, z up from the scene's origin.
// Errors: limits exceeded, nodes nested too deep, errors of the loader.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/geo/frames.hpp"
#include "model/scene/openflight/node_tree.hpp"

namespace yars::model::scene {

// Triangulation of polygons in space. Convex polygons become a triangle fan; concave ones are cut by ears in the plane
// of their Newell normal. Orientation is kept. Coincident or collinear corners give no triangles. Self-crossing
// polygons are covered approximately. There are never more than corners - 2 triangles.

// Twice the vector area. It points to the side from which the corners turn counter-clockwise.
Vector3 newell_normal(std::span<const Vector3> corners);

// Writes corner numbers of the triangles; clears `found` first.
void triangulate(std::span<const Vector3> corners, std::vector<std::array<std::uint32_t, 3>>& found);

// Vertex of a flattened scene. Of sibling levels of detail those with the least switch-out distance are taken. Of a
// switch its current mask is taken, of an animation the first frame. A two-sided polygon occurs twice, once for each
// side. A subface lies 0.02 m before its face. Normals are unit vectors on the counter-clockwise side. The facet's
// normal replaces a missing one, or one of the other side.
struct ModelVertex {
  std::array<float, 3> place_m{};  // relative to Model::base
  std::array<float, 3> normal{};
};

struct ModelTriangle {
  std::array<std::uint32_t, 3> corners{};  // indices into vertices
  std::uint32_t object = 0;                // index into objects
  std::uint16_t kind = 0;                  // index into kinds
};

struct Model {
  Header header;      // of the main file
  FileCounts counts;  // including external files, each file once
  Vector3 base;       // [m]; zero unless the file lies far from its origin
  std::vector<ModelVertex> vertices;
  std::vector<ModelTriangle> triangles;
  std::vector<std::string> objects;  // names; number 0 stands for faces outside objects
  std::vector<SurfaceKind> kinds;
  std::uint64_t polygons = 0;      // polygons that gave triangles, each instance counted
  std::vector<std::string> files;  // external files read, in order
  std::vector<std::string> warnings;
};

inline constexpr float kSubfaceLift_m = 0.02F;  // of each subface level, along the normal of the face

// Nesting of nodes. Instances that contain themselves exceed it.
inline constexpr int kMaxNodeDepth = 512;

// Limits on the expansion of instances and replications: at most 2 GB of memory and about ten seconds.
struct FlattenLimits {
  std::size_t triangles = 16'000'000;
  std::size_t vertices = 48'000'000;
  std::size_t objects = 2'000'000;   // each copy counted, object 0 too
  std::size_t visits = 256'000'000;  // of nodes and corners, each copy counted
};

using LoadExternal = std::function<error::Expected<std::shared_ptr<const Model>>(const std::string& name)>;

// Flattens a node tree: applies transforms, expands instances and replications, and omits nodes by `filter` (null:
// none). `load` returns the model of an external file, or null to omit it. Errors: those of load(), exceeded limits,
// nesting deeper than kMaxNodeDepth.
error::Expected<Model> flatten(const NodeTree& tree, const std::string& subject, const LoadExternal& load,
                               FlattenLimits limits = {}, NameFilter* filter = nullptr);

}  // namespace yars::model::scene
