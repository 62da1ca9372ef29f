// Node tree of an OpenFlight file: transforms, surface kinds, nodes, their names, header.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/geo/geodesy.hpp"

namespace yars::model::scene {

using geo::Vector3;

// Affine maps of space as OpenFlight writes them: row vectors, so that p * a * b applies a first.
struct Affine {
  Vector3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  // where the axes go
  Vector3 offset{};

  Vector3 apply(Vector3 p) const { return p.x * x + p.y * y + p.z * z + offset; }
  Vector3 turn(Vector3 v) const { return v.x * x + v.y * y + v.z * z; }
  double determinant() const { return dot(cross(x, y), z); }
  // Normals go by the cofactors: at right angles to the surface whatever the scales; not of unit length; a mirror keeps
  // them on the same side of the surface.
  Vector3 turn_normal(Vector3 n) const {
    const double side = determinant() < 0.0 ? -1.0 : 1.0;
    return side * (n.x * cross(y, z) + n.y * cross(z, x) + n.z * cross(x, y));
  }

  static Affine translation(Vector3 by) { return {.offset = by}; }
  // About the vertical axis, counter-clockwise seen from above.
  static Affine turn_about_up(double radians) {
    const double c = std::cos(radians);
    const double s = std::sin(radians);
    return {.x = {c, s, 0}, .y = {-s, c, 0}};
  }
  static Affine scale(Vector3 by) { return {.x = {by.x, 0, 0}, .y = {0, by.y, 0}, .z = {0, 0, by.z}}; }
};

// First a, then b.
inline Affine operator*(const Affine& a, const Affine& b) {
  return {b.turn(a.x), b.turn(a.y), b.turn(a.z), b.apply(a.offset)};
}

// What the faces of a kind are made of. Material: surface material code of DFAD, 0 = none given.
struct SurfaceKind {
  std::uint8_t material = 0;
  std::uint16_t feature_id = 0;
  std::uint32_t color_rgb = 0;  // 0xRRGGBB
};

// Kinds of surface by number, each once. Beyond 65,536 of them (colours run out first) the nearest earlier one serves:
// the first of the same material, else number 0.
class KindTable {
 public:
  std::uint16_t number_of(const SurfaceKind& kind);
  const std::vector<SurfaceKind>& kinds() const { return kinds_; }

 private:
  std::vector<SurfaceKind> kinds_;
  std::map<std::tuple<std::uint8_t, std::uint16_t, std::uint32_t>, std::uint16_t> numbers_;
};

// An OpenFlight file as its records tell it: nodes linked by numbers, polygons below them, nothing chosen, placed or
// multiplied. Lengths in metres. Counts are those of the records: every level of detail, hidden faces and all.
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
  Vector3 position;
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

// Names of what is left out of a scene: objects, groups and levels of detail by their names, external files by theirs;
// with all that is below them. In a name `*` stands for any letters and `?` for one; upper and lower case are one.
class NameFilter {
 public:
  // Names apart by commas, blanks about them are of no account; empty: nothing is left out.
  explicit NameFilter(std::string_view names);

  // Remembers the name, and which of those wanted it met.
  bool leaves_out(const std::string& name);

  // The names that another one was asked about.
  void add_seen(const NameFilter& other) { seen_.insert(other.seen_.begin(), other.seen_.end()); }

  // Of the names wanted, those that nothing had that was asked about.
  std::vector<std::string> unmet() const;
  // Nothing, or what is wrong with the first of them: it lists names that are near to it. `subject`: where they were
  // sought.
  std::optional<error::Error> complaint(const std::string& subject) const;

 private:
  struct Wanted {
    std::string name;
    bool met = false;
  };
  std::vector<Wanted> wanted_;
  std::set<std::string> seen_;
};

// The header record of an OpenFlight file: revision, unit, origin and what it covers. A place of exactly 0, 0 counts as
// none: files write it that have none. Errors: other bytes than a header, a revision but 14 to 16.5, a foreign unit.

// `bytes` may end behind the header.
error::Expected<Header> parse_header(std::span<const std::byte> bytes, const std::string& subject);

}  // namespace yars::model::scene
