// Parser of one OpenFlight file, revisions 14 to 16.7, into a node tree. The parser opens no other file.
// Skipped: textures, lights, sounds, extensions, all masks of a switch but the current one, and the transform records
// 76-82 and 94 (record 49 has their product).
// Wireframes and faces that stand for lights are omitted. Hidden faces are omitted, too; FileCounts::hidden_faces is
// the number of hidden faces.
// Bytes after the last record, such as padding, are a warning.
// Errors: no header, unknown revision or unit, truncated records, more pop records than push records, a corner without
// a vertex, a damaged mesh record, a matrix with NaN or infinity, an exceeded limit (constants below; records.hpp).
// Source: docs/spec/formats.md#openflight.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/scene/openflight/node_tree.hpp"
#include "model/scene/openflight/record_readers.hpp"
#include "model/scene/openflight/records.hpp"

namespace yars::model::scene {

// A file beyond these limits is an error, so that a damaged or malicious file cannot exhaust memory.
inline constexpr std::size_t kMaxPushDepth = 512;  // nesting of records
// The next three limits bound the memory of nodes to about 0.5 GB, of faces to 0.5 GB and of vertices to 2.6 GB.
inline constexpr std::size_t kMaxNodes = 4'000'000;
inline constexpr std::size_t kMaxFaces = 32'000'000;
inline constexpr std::size_t kMaxVertices = 64'000'000;  // also the limit of corners of faces: 0.3 GB more

// Parses a file. `subject`: name of the file in errors.
error::Expected<NodeTree> parse_openflight(std::span<const std::byte> bytes, const std::string& subject);

// Parses one file: turns its records into nodes, in their order in the file.
class TreeParser {
 public:
  TreeParser(std::span<const std::byte> bytes, std::string subject)
      : bytes_(bytes), subject_(std::move(subject)), stream_(bytes, subject_) {}

  error::Expected<NodeTree> parse();

 private:
  using Done = error::Expected<void>;

  // Node, face or mesh that owns the records between a push record and its pop record.
  struct Level {
    std::uint32_t node = kNone;
    std::uint32_t face = kNone;  // face that owns vertex lists
    int mesh = -1;               // number of the mesh that owns primitives; -1: none
  };
  struct MeshState {
    TreeFace surface;
    bool visible = true;
    std::size_t first_vertex = 0;
    std::size_t vertices = 0;
  };

  Done dispatch(const Record& record);
  // Returns +1 for a push record and -1 for a pop record of extensions and attributes, which are skipped; else 0.
  static int nesting_of_skipped(std::uint16_t opcode);
  tl::unexpected<error::Error> too_many(std::size_t limit, const std::string& what);
  Done push();
  Done pop();
  // True if the rest of the file, which is no whole record, lies after the last record of a complete tree.
  bool is_complete() const;

  Done new_node(NodeKind kind, bool attached = true);
  void link_child(std::uint32_t parent, std::uint32_t child);
  Done add_node(const Record& record);
  Done add_named(const Record& record, NodeKind kind);
  Done add_group(const Record& record);
  Done add_level_of_detail(const Record& record);
  Done add_degree_of_freedom(const Record& record);
  Done add_switch(const Record& record);
  Done add_definition(const Record& record);
  void set_name(const Record& record);
  // Moves the newest face into a node of its own, so that a transform applies only to this face.
  Done move_face_to_own_node();
  Done add_matrix(const Record& record);
  Done add_replication(const Record& record);

  Done append_face(TreeFace face, std::uint32_t node);
  Done add_face(const Record& record);
  Done add_vertex(const Record& record);
  Done add_corners(const Record& record);
  Done add_mesh(const Record& record);
  Done add_pool(const Record& record);
  Done add_primitive(const Record& record);

  const Level& parent() const { return levels_.empty() ? root_ : levels_.back(); }
  // True if current_ is a face without a node of its own.
  bool is_loose_face() const { return current_.face != kNone && current_.node == parent().node; }
  int current_mesh() const { return current_.mesh >= 0 ? current_.mesh : parent().mesh; }

  std::span<const std::byte> bytes_;
  std::string subject_;
  RecordStream stream_;
  NodeTree tree_;
  SurfaceReader surfaces_;
  VertexPalette palette_;
  std::vector<Level> levels_;
  Level root_{.node = 0};
  Level current_;                        // owner of the next push record, matrix or name
  std::uint32_t previous_face_ = kNone;  // face before the newest face in the list of the same node
  int skipped_ = 0;                      // nesting depth of extensions and attributes
  int subface_level_ = 0;
  bool closed_level_ = false;  // a level of records has ended
  bool closed_tree_ = false;   // the level below the header has ended: all nodes are read
  std::vector<MeshState> meshes_;
};

}  // namespace yars::model::scene
