// Model of an OpenFlight scene: a list of triangles, flattened from the scene's node tree. Triangulation of polygons.
// Inputs: a NodeTree, a loader of external files, a filter of names.
// Outputs: triangles, each with the numbers of its object and of its surface kind (material, feature, colour).
// Units: metres. Frame: x east, y north, z up from the scene's origin.
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

// Triangulation of polygons in space. Convex polygons become a triangle fan. Concave polygons are triangulated by ear
// clipping of their projection along the coordinate axis nearest to their normal; with more than 512 corners they
// become a fan, too. Orientation is kept. Some of the triangles may have no area. A polygon of four or more corners
// that are all collinear gives no triangles. Self-crossing polygons are covered approximately.
// The number of triangles is at most the number of corners minus two.

// Normal of a polygon, with a length of twice the area. It points to the side from which the corners run
// counter-clockwise.
Vector3 newell_normal(std::span<const Vector3> corners);

// Triangulates a polygon. Sets `found` to the triangles; each has three indices into `corners`.
void triangulate(std::span<const Vector3> corners, std::vector<std::array<std::uint32_t, 3>>& found);

inline Vector3 vector_of(const std::array<float, 3>& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

// Vertex of a flattened scene. Its normal is a unit vector on the side from which the corners of its polygon run
// counter-clockwise. The polygon's normal replaces a missing normal, or a normal on the back.
struct ModelVertex {
  std::array<float, 3> position_m{};  // relative to Model::base
  std::array<float, 3> normal{};
};

struct ModelTriangle {
  std::array<std::uint32_t, 3> corners{};  // indices into vertices
  std::uint32_t object = 0;                // index into Model::objects
  std::uint16_t kind = 0;                  // index into Model::kinds
};

struct Model {
  Header header;      // header of the main file
  FileCounts counts;  // including external files, each file once
  Vector3 base;       // [m] origin of position_m; zero unless the vertices lie far from the file's origin
  std::vector<ModelVertex> vertices;
  std::vector<ModelTriangle> triangles;
  std::vector<std::string> objects;  // names of the objects; object 0 has the faces outside objects, and no name
  std::vector<SurfaceKind> kinds;
  std::uint64_t polygons = 0;         // polygons that gave triangles, each instance counted
  std::vector<std::string> files;     // paths of the external files, in the order in which they were read
  std::vector<std::string> warnings;  // Remarks::warnings, of external files too
  std::vector<std::string> left_out;  // Remarks::left_out, of external files too
};

inline constexpr float kSubfaceLift_m = 0.02F;  // height of a subface above its face, per subface level

// Maximum nesting of nodes. Instances that contain themselves exceed it.
inline constexpr int kMaxNodeDepth = 512;

// Limits on the expansion of instances and replications. They bound memory to 2 GB and time to about ten seconds.
struct FlattenLimits {
  std::size_t triangles = 16'000'000;
  std::size_t vertices = 48'000'000;
  std::size_t objects = 2'000'000;   // each copy counted, object 0 too
  std::size_t visits = 256'000'000;  // visited nodes and corners, each copy counted
};

// Loader of external files: returns the model of a file, or null to omit the file.
using LoadExternal = std::function<error::Expected<std::shared_ptr<const Model>>(const std::string& name)>;

struct FlattenOptions {
  FlattenLimits limits{};
  NameFilter* filter = nullptr;  // names to leave out; null: none
  std::uint32_t first_node = 0;  // only this node, with its own transform but without those above it; 0: the whole tree
};

// Flattens a node tree: applies transforms, expands instances and replications, and omits the nodes that the filter
// matches. Selects the current mask of a switch, and the first frame of an animation. Degrees of freedom have their
// current pose. A two-sided polygon gives triangles for each side. `subject`: name of the file in errors.
// Of the levels of detail of an object only the finest is shown (mark_coarser_levels()).
// Errors: errors of `load`, exceeded limits, nesting deeper than kMaxNodeDepth, an external file placed more than
// 10,000 km from the origin.
error::Expected<Model> flatten(const NodeTree& tree, const std::string& subject, const LoadExternal& load,
                               FlattenOptions options = {});

}  // namespace yars::model::scene
