#include "model/scene/openflight/parser.hpp"

#include <algorithm>
#include <cmath>

#include "lib/geo/frames.hpp"
#include "lib/text/plain_text.hpp"
#include "model/scene/openflight/node_tree.hpp"
#include "model/scene/openflight/record_readers.hpp"
#include "model/scene/openflight/records.hpp"

namespace yars::model::scene {

using namespace openflight;

error::Expected<NodeTree> parse_openflight(std::span<const std::byte> bytes, const std::string& subject) {
  return TreeParser(bytes, subject).parse();
}

error::Expected<NodeTree> TreeParser::parse() {
  const auto header = parse_header(bytes_, subject_);
  if (!header) return tl::unexpected(header.error());
  tree_.header = *header;
  surfaces_.set_revision(header->revision);
  tree_.nodes.emplace_back();
  current_.node = 0;
  for (;;) {
    const auto record = stream_.next();
    if (!record && is_complete()) {
      tree_.remarks.warnings.add("bytes after the last record: " + std::to_string(stream_.rest().size()) +
                                 "; they are ignored");
      break;
    }
    if (!record) return tl::unexpected(record.error());
    if (!*record) break;
    if (const auto done = dispatch(**record); !done) return tl::unexpected(done.error());
  }
  if (!levels_.empty())
    tree_.remarks.left_out.add("the file ends inside " + text::counted(levels_.size(), "open level") +
                               "; what followed is missing");
  if (surfaces_.unknown_codes() > 0)
    tree_.remarks.left_out.add("faces with a surface material code beyond 31: " +
                               std::to_string(surfaces_.unknown_codes()) + "; they count as faces without a code");
  tree_.counts.materials = surfaces_.colors().materials();
  tree_.counts.hidden_faces = surfaces_.hidden_faces();
  tree_.kinds = surfaces_.kinds();
  if (const auto done = mark_coarser_levels(tree_, subject_); !done) return tl::unexpected(done.error());
  return std::move(tree_);
}

TreeParser::Done TreeParser::dispatch(const Record& record) {
  if (const int step = nesting_of_skipped(record.opcode()); step != 0 || skipped_ > 0) {
    skipped_ = std::max(0, skipped_ + step);
    return {};
  }
  switch (record.opcode()) {
    case kPushLevel:
      return push();
    case kPopLevel:
      return pop();
    case kPushSubface:
      ++subface_level_;
      return push();
    case kPopSubface:
      subface_level_ = std::max(0, subface_level_ - 1);
      return pop();
    case kColorPalette:
      surfaces_.colors().read_colors(record, tree_.header.revision);
      return {};
    case kMaterial:
      surfaces_.colors().read_material(record);
      return {};
    case kFace:
      return add_face(record);
    case kMesh:
      return add_mesh(record);
    case kLocalVertexPool:
      return add_pool(record);
    case kMeshPrimitive:
      return add_primitive(record);
    case kVertexPalette:
      palette_.begin(record);
      return {};
    case kVertexColor:
    case kVertexColorNormal:
    case kVertexColorNormalTexture:
    case kVertexColorTexture:
      return add_vertex(record);
    case kVertexList:
      return add_corners(record);
    case kMatrix:
      return add_matrix(record);
    case kReplicate:
      return add_replication(record);
    case kLongId:
      set_name(record);
      return {};
    default:
      return add_node(record);
  }
}

int TreeParser::nesting_of_skipped(std::uint16_t opcode) {
  if (opcode == kPushExtension || opcode == kPushAttribute) return 1;
  return opcode == kPopExtension || opcode == kPopAttribute ? -1 : 0;
}

tl::unexpected<error::Error> TreeParser::too_many(std::size_t limit, const std::string& what) {
  return error::fail(subject_, "at most " + std::to_string(limit) + " " + what, "more", "split the file");
}

TreeParser::Done TreeParser::push() {
  if (levels_.size() >= kMaxPushDepth) return too_many(kMaxPushDepth, "levels of records");
  levels_.push_back(current_);
  return {};
}

TreeParser::Done TreeParser::pop() {
  if (levels_.empty())
    return error::fail(subject_, "as many pop records as push records", "one pop more",
                       "the file is damaged; fetch it again");
  current_ = levels_.back();
  levels_.pop_back();
  closed_level_ = true;
  closed_tree_ |= levels_.empty() && current_.node == 0 && current_.face == kNone && current_.mesh < 0;
  return {};
}

// A file that is truncated ends inside a level, or in the palettes before the first one. A file without a level below
// its header has its nodes side by side, and a piece of one more may follow: there, only padding counts as none.
bool TreeParser::is_complete() const {
  constexpr std::size_t kHeadBytes = 4;  // of a record
  if (!levels_.empty() || !closed_level_) return false;
  const std::span<const std::byte> rest = stream_.rest();
  return closed_tree_ || rest.size() < kHeadBytes ||
         std::ranges::all_of(rest, [](std::byte byte) { return byte == std::byte{0}; });
}

// The following functions parse nodes (groups, objects, switches, references), and transforms of nodes and faces.

TreeParser::Done TreeParser::new_node(NodeKind kind, bool attached) {
  if (tree_.nodes.size() >= kMaxNodes) return too_many(kMaxNodes, "nodes");
  const auto number = static_cast<std::uint32_t>(tree_.nodes.size());
  tree_.nodes.emplace_back().kind = kind;
  if (attached && parent().node != kNone) link_child(parent().node, number);
  current_ = {.node = number};
  return {};
}

void TreeParser::link_child(std::uint32_t parent, std::uint32_t child) {
  Node& above = tree_.nodes[parent];
  if (above.first_child == kNone)
    above.first_child = child;
  else
    tree_.nodes[above.last_child].next_sibling = child;
  above.last_child = child;
}

TreeParser::Done TreeParser::add_node(const Record& record) {
  switch (record.opcode()) {
    case kGroup:
      return add_group(record);
    case kObject:
      ++tree_.counts.objects;
      return add_named(record, NodeKind::object);
    case kLevelOfDetail:
      return add_level_of_detail(record);
    case kSwitch:
      return add_switch(record);
    case kInstanceDefinition:
      return add_definition(record);
    case kInstanceReference:
      ++tree_.counts.instances;
      return new_node(NodeKind::instance).map([&] {
        tree_.nodes.back().instance = record.number_or<std::uint16_t>(6, 0);
      });
    case kExternalReference:
      ++tree_.counts.external_references;
      return new_node(NodeKind::external).map([&] { tree_.nodes.back().name = record.raw_text(4, 200); });
    case kDegreeOfFreedom:
      return add_degree_of_freedom(record);
    case kBinarySeparatingPlane:
    case kRoadSegment:
    case kClipRegion:
    case kExtension:
    case kContinuouslyAdaptive:
    case kRoadConstruction:
      return add_named(record, NodeKind::group);
    case kSound:
    case kPath:
    case kText:
    case kLightSource:
    case kLightPoint:
    case kCurve:
    case kIndexedLightPoint:
    case kLightPointSystem:
      return new_node(NodeKind::ignored);
    default:
      return {};
  }
}

TreeParser::Done TreeParser::add_named(const Record& record, NodeKind kind) {
  return new_node(kind).map([&] { tree_.nodes.back().name = record.text(kNameAt, kNameBytes); });
}

TreeParser::Done TreeParser::add_group(const Record& record) {
  constexpr std::uint32_t kForward = 1U << 30, kSwing = 1U << 29, kBackward = 1U << 26;
  // First revision (15.8) in which a bit marks an animation that runs backward. Earlier revisions have the swing bit
  // (to and fro) instead.
  constexpr std::int32_t kBackwardRevision = 1580;
  const auto flags = record.number_or<std::uint32_t>(16, 0);
  const std::uint32_t animation = kForward | (tree_.header.revision >= kBackwardRevision ? kBackward : kSwing);
  return add_named(record, NodeKind::group).map([&] {
    tree_.nodes.back().first_child_only = (flags & animation) != 0;
  });
}

TreeParser::Done TreeParser::add_level_of_detail(const Record& record) {
  ++tree_.counts.levels_of_detail;
  return add_named(record, NodeKind::level_of_detail).map([&] {
    LevelOfDetail level = level_of_detail_of(record, tree_.header.metres_per_unit);
    const auto flags = record.number_or<std::uint32_t>(level_of_detail::kFlags, 0);
    if ((flags & level_of_detail::kCentreOfPrevious) != 0 && !tree_.levels.empty())
      level.centre = tree_.levels.back().centre;
    tree_.nodes.back().level = static_cast<std::uint32_t>(tree_.levels.size());
    tree_.levels.push_back(level);
  });
}

TreeParser::Done TreeParser::add_degree_of_freedom(const Record& record) {
  return add_named(record, NodeKind::group).map([&] {
    const auto pose = pose_of(record, tree_.header.metres_per_unit);
    if (!pose || *pose == Transform(1.0)) return;
    tree_.nodes.back().pose = static_cast<std::uint32_t>(tree_.matrices.size());
    tree_.matrices.push_back(*pose);
  });
}

TreeParser::Done TreeParser::add_switch(const Record& record) {
  return add_named(record, NodeKind::switch_node).map([&] { tree_.nodes.back().switch_mask = switch_mask_of(record); });
}

TreeParser::Done TreeParser::add_definition(const Record& record) {
  return new_node(NodeKind::group, false).map([&] {
    tree_.definitions[record.number_or<std::uint16_t>(6, 0)] = current_.node;
  });
}

void TreeParser::set_name(const Record& record) {
  constexpr std::size_t kMaxNameLength = 128;
  if (current_.node == kNone || current_.face != kNone || current_.mesh >= 0) return;
  Node& node = tree_.nodes[current_.node];
  if (node.kind != NodeKind::external) node.name = record.text(4, kMaxNameLength);
}

// Only the face that was read last can change its node. An earlier face stays in its node, and the caller then ignores
// the transform.
TreeParser::Done TreeParser::move_face_to_own_node() {
  const std::uint32_t face = current_.face;
  const std::uint32_t above = parent().node;
  if (tree_.faces.size() != std::size_t{face} + 1 || above == kNone) return {};
  if (auto made = new_node(NodeKind::group); !made) return made;
  Node& before = tree_.nodes[above];
  before.last_face = previous_face_;
  if (previous_face_ == kNone)
    before.first_face = kNone;
  else
    tree_.faces[previous_face_].next = kNone;
  tree_.nodes.back().first_face = tree_.nodes.back().last_face = face;
  current_.face = face;
  return {};
}

TreeParser::Done TreeParser::add_matrix(const Record& record) {
  const std::optional<Transform> matrix = matrix_of(record, tree_.header.metres_per_unit);
  if (!matrix) return error::fail(subject_, "a matrix of finite numbers", "NaN or infinity", "the file is damaged");
  if (is_loose_face())
    if (auto done = move_face_to_own_node(); !done) return done;
  if (current_.node == kNone || is_loose_face()) return {};
  if (tree_.nodes[current_.node].matrix == kNone) {
    tree_.nodes[current_.node].matrix = static_cast<std::uint32_t>(tree_.matrices.size());
    tree_.matrices.push_back(*matrix);
  } else {
    tree_.matrices[tree_.nodes[current_.node].matrix] = *matrix;
  }
  return {};
}

TreeParser::Done TreeParser::add_replication(const Record& record) {
  const int copies = record.number_or<std::int16_t>(4, 0);
  if (copies <= 0) return {};
  if (is_loose_face())
    if (auto done = move_face_to_own_node(); !done) return done;
  if (current_.node != kNone && !is_loose_face())
    tree_.nodes[current_.node].replications = static_cast<std::uint16_t>(copies);
  return {};
}

// The following functions parse faces, their corners, and meshes.

TreeParser::Done TreeParser::append_face(TreeFace face, std::uint32_t node) {
  if (tree_.faces.size() >= kMaxFaces) return too_many(kMaxFaces, "faces");
  const auto number = static_cast<std::uint32_t>(tree_.faces.size());
  tree_.faces.push_back(face);
  Node& owner = tree_.nodes[node];
  previous_face_ = owner.last_face;
  if (owner.first_face == kNone)
    owner.first_face = number;
  else
    tree_.faces[owner.last_face].next = number;
  owner.last_face = number;
  return {};
}

TreeParser::Done TreeParser::add_face(const Record& record) {
  ++tree_.counts.faces;
  current_ = {.node = parent().node};
  if (current_.node == kNone) return {};
  const std::optional<TreeFace> face = surfaces_.read(record, 0, subface_level_);
  if (!face) {
    current_.node = kNone;  // records nested in a skipped face are skipped, too
    return {};
  }
  current_.face = static_cast<std::uint32_t>(tree_.faces.size());
  return append_face(*face, current_.node);
}

TreeParser::Done TreeParser::add_vertex(const Record& record) {
  if (tree_.vertices.size() >= kMaxVertices) return too_many(kMaxVertices, "vertices");
  palette_.add(record, tree_.header.metres_per_unit, tree_.vertices);
  ++tree_.counts.vertices;
  return {};
}

TreeParser::Done TreeParser::add_corners(const Record& record) {
  const std::uint32_t face_number = parent().face;
  const std::size_t count = (record.size() - 4) / 4;
  tree_.counts.corners += count;
  if (face_number == kNone) return {};
  if (tree_.corners.size() + count > kMaxVertices) return too_many(kMaxVertices, "corners of faces");
  TreeFace& face = tree_.faces[face_number];
  if (face.count > 0) return {};
  face.first_corner = static_cast<std::uint32_t>(tree_.corners.size());
  face.count = static_cast<std::uint32_t>(count);
  if (const auto unknown_offset = palette_.find_corners(record, tree_.corners))
    return error::fail(
        subject_, "corners that are vertices of the palette",
        "offset " + std::to_string(*unknown_offset) + " in the vertex list at byte " + std::to_string(record.start()),
        "the file is damaged; fetch it again");
  return {};
}

TreeParser::Done TreeParser::add_mesh(const Record& record) {
  ++tree_.counts.meshes;
  current_ = {.node = parent().node};
  const std::optional<TreeFace> surface = surfaces_.read(record, face::kMeshShift, subface_level_);
  meshes_.push_back({.surface = surface.value_or(TreeFace{}), .visible = surface && current_.node != kNone});
  const int mesh = static_cast<int>(meshes_.size()) - 1;
  // The mesh gets a node of its own, because a matrix may follow that applies to this mesh only.
  if (current_.node != kNone)
    if (auto made = new_node(NodeKind::group); !made) return made;
  current_.mesh = mesh;
  return {};
}

TreeParser::Done TreeParser::add_pool(const Record& record) {
  const int mesh = current_mesh();
  if (mesh < 0) return {};
  if (tree_.vertices.size() + record.size() / 24 > kMaxVertices) return too_many(kMaxVertices, "vertices");
  MeshState& state = meshes_[static_cast<std::size_t>(mesh)];
  state.first_vertex = tree_.vertices.size();
  const auto count = read_local_pool(record, tree_.header.metres_per_unit, subject_, tree_.vertices);
  if (!count) return tl::unexpected(count.error());
  state.vertices = *count;
  tree_.counts.vertices += *count;
  return {};
}

TreeParser::Done TreeParser::add_primitive(const Record& record) {
  ++tree_.counts.faces;
  const Level& above = parent();
  if (above.mesh < 0) return {};
  const MeshState& state = meshes_[static_cast<std::size_t>(above.mesh)];
  const auto polygons = read_primitive(record, state.vertices, subject_);
  if (!polygons) return tl::unexpected(polygons.error());
  tree_.counts.corners += polygons->listed;
  if (!state.visible || above.node == kNone) return {};
  if (tree_.corners.size() + polygons->corners.size() > kMaxVertices) return too_many(kMaxVertices, "corners of faces");
  for (std::size_t first = 0; first < polygons->corners.size(); first += polygons->corners_per_polygon) {
    TreeFace face = state.surface;
    face.first_corner = static_cast<std::uint32_t>(tree_.corners.size());
    face.count = static_cast<std::uint32_t>(polygons->corners_per_polygon);
    for (std::size_t i = first; i < first + polygons->corners_per_polygon; ++i)
      tree_.corners.push_back(static_cast<std::uint32_t>(state.first_vertex + polygons->corners[i]));
    if (auto done = append_face(face, above.node); !done) return done;
  }
  return {};
}

}  // namespace yars::model::scene
