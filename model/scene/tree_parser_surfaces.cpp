// Faces, their corners, and meshes.
#include "model/scene/mesh_record.hpp"
#include "model/scene/openflight_format.hpp"
#include "model/scene/openflight_parser.hpp"
#include "model/scene/tree_parser.hpp"

namespace yars::model::scene {

using namespace openflight;

TreeParser::Done TreeParser::append_face(TreeFace face, std::uint32_t node) {
  if (tree_.faces.size() >= kMostFaces) return too_many(kMostFaces, "faces");
  const auto number = static_cast<std::uint32_t>(tree_.faces.size());
  tree_.faces.push_back(face);
  Node& owner = tree_.nodes[node];
  face_before_ = owner.last_face;
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
  const std::optional<TreeFace> face = surfaces_.of(record, 0, subface_level_);
  if (!face) {
    current_.node = kNone;  // what is below it belongs to nothing
    return {};
  }
  current_.face = static_cast<std::uint32_t>(tree_.faces.size());
  return append_face(*face, current_.node);
}

TreeParser::Done TreeParser::add_vertex(const Record& record) {
  if (tree_.vertices.size() >= kMostVertices) return too_many(kMostVertices, "vertices");
  palette_.add(record, tree_.header.metres_per_unit, tree_.vertices);
  ++tree_.counts.vertices;
  return {};
}

TreeParser::Done TreeParser::add_corners(const Record& record) {
  const std::uint32_t face_number = parent().face;
  const std::size_t count = (record.size() - 4) / 4;
  tree_.counts.corners += count;
  if (face_number == kNone) return {};
  if (tree_.corners.size() + count > kMostVertices) return too_many(kMostVertices, "corners of faces");
  TreeFace& face = tree_.faces[face_number];
  if (face.count > 0) return {};
  face.first_corner = static_cast<std::uint32_t>(tree_.corners.size());
  face.count = static_cast<std::uint32_t>(count);
  if (const auto strange = palette_.find_corners(record, tree_.corners))
    return failure::fail(
        subject_, "corners that are vertices of the palette",
        "offset " + std::to_string(*strange) + " in the vertex list at byte " + std::to_string(record.start()),
        "the file is damaged; fetch it again");
  return {};
}

TreeParser::Done TreeParser::add_mesh(const Record& record) {
  ++tree_.counts.meshes;
  current_ = {.node = parent().node};
  const std::optional<TreeFace> surface = surfaces_.of(record, face::kMeshShift, subface_level_);
  meshes_.push_back({.surface = surface.value_or(TreeFace{}), .visible = surface && current_.node != kNone});
  const int mesh = static_cast<int>(meshes_.size()) - 1;
  // A node of its own: its primitives come behind a push, a matrix before it.
  if (current_.node != kNone)
    if (auto made = new_node(NodeKind::group); !made) return made;
  current_.mesh = mesh;
  return {};
}

TreeParser::Done TreeParser::add_pool(const Record& record) {
  const int mesh = mesh_here();
  if (mesh < 0) return {};
  if (tree_.vertices.size() + record.size() / 24 > kMostVertices) return too_many(kMostVertices, "vertices");
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
  if (tree_.corners.size() + polygons->corners.size() > kMostVertices)
    return too_many(kMostVertices, "corners of faces");
  for (std::size_t first = 0; first < polygons->corners.size(); first += polygons->each) {
    TreeFace face = state.surface;
    face.first_corner = static_cast<std::uint32_t>(tree_.corners.size());
    face.count = static_cast<std::uint32_t>(polygons->each);
    for (std::size_t i = first; i < first + polygons->each; ++i)
      tree_.corners.push_back(static_cast<std::uint32_t>(state.first_vertex + polygons->corners[i]));
    if (auto done = append_face(face, above.node); !done) return done;
  }
  return {};
}

}  // namespace yars::model::scene
