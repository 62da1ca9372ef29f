// Node tree of one OpenFlight file: header, nodes, faces, vertices, transforms, surface kinds; filter of names.
// Units: metres.
// Source: docs/spec/formats.md#openflight.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/ext/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/geo/frames.hpp"

namespace yars::model::scene {

using geo::Vector3;

// Affine transform of column vectors, from the child's frame to the parent's. `parent * child` applies `child` first.
// OpenFlight's matrices act on row vectors. The parser transposes them.
using Transform = glm::dmat4;

inline Transform translation(Vector3 by) {
  return glm::translate(Transform(1.0), by);
}
// Rotation about the vertical axis, counter-clockwise seen from above.
inline Transform rotation_about_up(double angle_rad) {
  return glm::rotate(Transform(1.0), angle_rad, Vector3(0.0, 0.0, 1.0));
}
inline Transform scaling(Vector3 by) {
  return glm::scale(Transform(1.0), by);
}

inline Vector3 transformed_point(const Transform& transform, Vector3 point) {
  return glm::dmat3(transform) * point + Vector3(transform[3]);
}
// True if the transform changes right-handed into left-handed frames.
inline bool mirrors(const Transform& transform) {
  return glm::determinant(glm::dmat3(transform)) < 0.0;
}
// Transforms a normal by the cofactor matrix of `transform`. The normal stays perpendicular to the surface for any
// scale. Under mirroring it stays on the same side of the surface. The result is not a unit vector.
inline Vector3 transformed_normal(const Transform& transform, Vector3 normal) {
  const glm::dmat3 axes(transform);
  const glm::dmat3 cofactors(cross(axes[1], axes[2]), cross(axes[2], axes[0]), cross(axes[0], axes[1]));
  return (mirrors(transform) ? -1.0 : 1.0) * (cofactors * normal);
}

// Surface properties of faces.
struct SurfaceKind {
  std::uint8_t material = 0;  // code of DFAD (Digital Feature Analysis Data); 0: not given
  std::uint16_t feature_id = 0;
  std::uint32_t color_rgb = 0;  // 0xRRGGBB
};

// Table that numbers distinct surface kinds, at most 65,536. Once the table is full, a further kind gets the number of
// the first kind with the same material, or 0 if there is none.
class KindTable {
 public:
  // The number of a kind, which is added if it is new. A full table gives the number of a kind of the same material.
  std::uint16_t number_of(const SurfaceKind& kind);
  // The same for a kind that number_of() has been called with. Several threads may call it at once.
  std::uint16_t known_number_of(const SurfaceKind& kind) const;
  const std::vector<SurfaceKind>& kinds() const { return kinds_; }

 private:
  std::vector<SurfaceKind> kinds_;
  std::map<std::tuple<std::uint8_t, std::uint16_t, std::uint32_t>, std::uint16_t> numbers_;
};

// Sentences about a scene: each text once, at most kMaxWarnings texts, then the number of further ones.
inline constexpr std::size_t kMaxWarnings = 100;
class WarningList {
 public:
  void add(std::string warning);
  std::vector<std::string> take();

 private:
  std::vector<std::string> texts_;
  std::size_t further_ = 0;
};

// What a reader has to say about a file that it has read.
struct Remarks {
  WarningList warnings;  // what is unusual; the model has all surfaces of the file
  WarningList left_out;  // what the file has, or refers to, and the model has not
};

// The following types describe a file as stored, before nodes are selected, transformed and instantiated. FileCounts
// includes all levels of detail, and hidden faces.
inline constexpr std::uint32_t kNone = 0xFFFFFFFFU;  // index that refers to nothing

enum class NodeKind : std::uint8_t { group, object, level_of_detail, switch_node, instance, external, ignored };

struct Node {
  NodeKind kind = NodeKind::group;
  bool first_child_only = false;   // animation: only the first frame is used
  bool is_coarser = false;         // level of detail: a finer one of the same object replaces it
  std::uint16_t replications = 0;  // further copies of the node, each moved by the matrix
  std::uint16_t instance = 0;      // number of the definition that an instance refers to
  std::uint32_t first_child = kNone;
  std::uint32_t last_child = kNone;
  std::uint32_t next_sibling = kNone;
  std::uint32_t first_face = kNone;
  std::uint32_t last_face = kNone;
  std::uint32_t matrix = kNone;            // index into NodeTree::matrices
  std::uint32_t level = kNone;             // level of detail: index into NodeTree::levels
  std::uint32_t pose = kNone;              // degree of freedom: index into NodeTree::matrices; applies before `matrix`
  std::string name;                        // for an external reference, the file name as in the file
  std::vector<std::uint32_t> switch_mask;  // switch_node: one bit per child, 1: shown; empty: all shown
};

// Viewing distances between which a level of detail is drawn. They count from `centre`, in the frame of the node above.
struct LevelOfDetail {
  double switch_in_m = std::numeric_limits<double>::infinity();  // drawn below this distance
  double switch_out_m = 0.0;                                     // drawn from this distance on; below switch_in_m
  Vector3 centre;
};

struct TreeVertex {
  Vector3 position;
  std::array<float, 3> normal{};  // zero: none given
};

// Polygon with `count` entries of NodeTree::corners.
struct TreeFace {
  std::uint32_t first_corner = 0;
  std::uint32_t count = 0;
  std::uint32_t next = kNone;      // next face of the same node
  std::uint16_t kind = 0;          // index into NodeTree::kinds
  std::uint8_t subface_level = 0;  // 0: no subface; 1: subface of a face; 2: subface of a subface, and so on
  bool two_sided = false;
};

struct FileCounts {
  std::uint64_t vertices = 0;      // in the vertex palette and in local vertex pools
  std::uint64_t faces = 0;         // face records and mesh primitives
  std::uint64_t corners = 0;       // entries of vertex lists and primitives
  std::uint64_t hidden_faces = 0;  // included in `faces`
  std::uint64_t objects = 0;
  std::uint64_t meshes = 0;
  std::uint64_t materials = 0;
  std::uint64_t levels_of_detail = 0;
  std::uint64_t instances = 0;
  std::uint64_t external_references = 0;
  bool operator==(const FileCounts&) const = default;
};

struct Header {
  std::int32_t revision = 0;  // 1570 is 15.7
  double metres_per_unit = 1.0;
  std::optional<geo::GeoPoint> origin;
  std::optional<geo::GeoPoint> south_west, north_east;  // corners of the area covered
};

struct NodeTree {
  Header header;
  FileCounts counts;
  std::vector<Node> nodes;  // node 0 is the root
  std::vector<TreeFace> faces;
  std::vector<std::uint32_t> corners;  // indices into vertices
  std::vector<TreeVertex> vertices;
  std::vector<Transform> matrices;
  std::vector<LevelOfDetail> levels;
  std::vector<SurfaceKind> kinds;
  std::map<std::uint16_t, std::uint32_t> definitions;  // from the number of an instance definition to its node
  Remarks remarks;                                     // without the file's name
};

// True if a switch shows its child at `position`, counted from 0. Any other node shows all its children.
bool shows(const Node& node, std::uint32_t position);

// Sets Node::is_coarser. A level of detail is a coarser one of the object of its sibling if it is drawn only from where
// the sibling ends, and not from the sibling's centre. Nodes that a switch or an animation does not show do not count.
// Error: a file with so many siblings that they cannot be compared. `subject`: name of the file in errors.
error::Expected<void> mark_coarser_levels(NodeTree& tree, const std::string& subject);

// Filter of the names of objects, groups, switches, levels of detail and external files. A node with a matching name is
// left out with everything below it. `*` matches any characters, `?` one character. Case is ignored.
class NameFilter {
 public:
  // `names`: the names to leave out (excluded names), separated by commas. Blanks around a name are ignored. Empty:
  // nothing is left out.
  explicit NameFilter(std::string_view names);

  // True if `name` matches an excluded name. Records `name` as seen, and marks the excluded names that it matches.
  bool leaves_out(const std::string& name);

  // Adds the names that `other` recorded as seen.
  void add_seen(const NameFilter& other) { seen_.insert(other.seen_.begin(), other.seen_.end()); }

  // Excluded names that matched nothing so far.
  std::vector<std::string> unmatched_names() const;
  // Error for the first unmatched name, with a list of similar names; nullopt if all matched. `subject`: the file or
  // option that the error names.
  std::optional<error::Error> unmatched_error(const std::string& subject) const;

 private:
  struct Excluded {
    std::string name;
    bool matched = false;  // true: a node's name matched
  };
  std::vector<Excluded> excluded_;
  std::set<std::string> seen_;  // names of nodes, for suggestions in errors
};

}  // namespace yars::model::scene
