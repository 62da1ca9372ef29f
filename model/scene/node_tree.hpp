// An OpenFlight file as its records tell it: nodes linked by numbers, polygons below them, nothing chosen, placed or
// multiplied. Lengths in metres. Counts are those of the records: every level of detail, hidden faces and all.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/scene/affine.hpp"
#include "model/scene/scene_view.hpp"

namespace yars::model::scene {

inline constexpr std::uint32_t kNone = 0xFFFFFFFFU;

enum class NodeKind : std::uint8_t { group, object, level_of_detail, choice, instance, external, ignored };

struct Node {
  NodeKind kind = NodeKind::group;
  bool first_child_only = false;  // an animation: its first picture stands for it
  std::uint16_t replications = 0;
  std::uint16_t instance = 0;  // number of the definition that an instance shows
  std::uint32_t first_child = kNone;
  std::uint32_t last_child = kNone;
  std::uint32_t next_sibling = kNone;
  std::uint32_t first_face = kNone;
  std::uint32_t last_face = kNone;
  std::uint32_t matrix = kNone;            // into NodeTree::matrices
  double switch_out_m = 0.0;               // of a level of detail: the nearest distance that shows it
  std::string name;                        // an external reference: its file
  std::vector<std::uint32_t> choice_mask;  // of a choice; empty: every child
};

struct TreeVertex {
  Vector3 place;
  std::array<float, 3> normal{};  // zero: none given
};

// A polygon; its corners are `count` entries of NodeTree::corners.
struct TreeFace {
  std::uint32_t first_corner = 0;
  std::uint32_t count = 0;
  std::uint32_t next = kNone;  // of the same node
  std::uint16_t kind = 0;      // into NodeTree::kinds
  std::uint8_t subface_level = 0;
  bool two_sided = false;
};

struct FileCounts {
  std::uint64_t vertices = 0;      // of the palette and of local pools
  std::uint64_t faces = 0;         // face records and primitives of meshes
  std::uint64_t corners = 0;       // entries of vertex lists and primitives
  std::uint64_t hidden_faces = 0;  // among faces
  std::uint64_t objects = 0;
  std::uint64_t meshes = 0;
  std::uint64_t materials = 0;
  std::uint64_t levels_of_detail = 0;
  std::uint64_t instances = 0;
  std::uint64_t external_references = 0;
  bool operator==(const FileCounts&) const = default;
};

struct Header {
  std::int32_t revision = 0;  // 1570 = 15.7
  double metres_per_unit = 1.0;
  std::optional<geo::GeoPoint> origin;
  std::optional<geo::GeoPoint> south_west, north_east;  // what the file says that it covers
};

struct NodeTree {
  Header header;
  FileCounts counts;
  std::vector<Node> nodes;  // the first is the root
  std::vector<TreeFace> faces;
  std::vector<std::uint32_t> corners;  // into vertices
  std::vector<TreeVertex> vertices;
  std::vector<Affine> matrices;
  std::vector<SurfaceKind> kinds;
  std::map<std::uint16_t, std::uint32_t> definitions;  // number of an instance definition -> node
  std::vector<std::string> warnings;                   // a sentence each, without the file's name
};

}  // namespace yars::model::scene
