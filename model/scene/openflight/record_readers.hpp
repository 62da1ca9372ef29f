// Readers of the records of nodes and surfaces: the header, levels of detail, switches, matrices, degrees of freedom;
// vertex palette, meshes, colours, faces.
// Inputs: records; the file's unit of length. A field of a node that is absent or no number counts as not given.
// Units: metres; colours 0xRRGGBB.
// Errors: counts that exceed a record's length, an index outside its pool, a vertex pool without positions, an unknown
// type of primitive or size of indices.
// Source: docs/spec/formats.md#openflight, #openflight-face, #openflight-vertex.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/scene/openflight/node_tree.hpp"
#include "model/scene/openflight/records.hpp"

namespace yars::model::scene {

// Parses the header record: revision, unit, origin, covered area. A position of exactly 0, 0 counts as absent, because
// some files without a position have 0, 0. `bytes` may end after the header. Errors: not a header record, a revision
// outside 14 to 16.7, an unknown unit.
error::Expected<Header> parse_header(std::span<const std::byte> bytes, const std::string& subject);

// Range and centre of a level of detail. Without a range, the level is drawn from everywhere.
LevelOfDetail level_of_detail_of(const Record& record, double metres_per_unit);

// Bits of the current mask of a switch, one for each child; empty: all are shown.
std::vector<std::uint32_t> switch_mask_of(const Record& record);

// The matrix of the node before it; nullopt if a number is NaN or infinite.
std::optional<Transform> matrix_of(const Record& record, double metres_per_unit);

// Current pose of a degree of freedom: scale, then rotation by yaw, roll and pitch, then translation, each along the
// local axes of the record. Points that span no axes give those of the node above. nullopt if points are absent or no
// numbers.
std::optional<Transform> pose_of(const Record& record, double metres_per_unit);

// Vertex palette (records with opcodes 67 to 71). A vertex is identified by the offset of its record from the start of
// the record with opcode 67, in bytes.
class VertexPalette {
 public:
  void begin(const Record& palette);
  // Appends the vertex of a record with opcode 68 to 71.
  void add(const Record& record, double metres_per_unit, std::vector<TreeVertex>& vertices);
  // Appends the vertex indices of a vertex list (record 72) to `corners`. Returns the first offset in the list at which
  // the palette has no vertex, or nullopt if all vertices exist.
  std::optional<std::size_t> find_corners(const Record& vertex_list, std::vector<std::uint32_t>& corners) const;

 private:
  std::size_t start_ = 0;
  std::vector<std::size_t> offsets_;     // [bytes] of the vertices' records, ascending
  std::vector<std::uint32_t> vertices_;  // index of each vertex in NodeTree::vertices, parallel to offsets_
};

// Appends the vertices of a local vertex pool (record 85) and returns their number.
error::Expected<std::size_t> read_local_pool(const Record& record, double metres_per_unit, const std::string& subject,
                                             std::vector<TreeVertex>& vertices);

// Polygons of a mesh primitive. All have the same number of corners, counter-clockwise as seen from the visible side.
// Corners are indices into the local vertex pool.
struct MeshPolygons {
  std::size_t corners_per_polygon = 3;
  std::vector<std::uint32_t> corners;
  std::size_t listed = 0;  // number of indices in the record
};

// Reads a mesh primitive (record 86): strip, fan, quadrilateral strip or indexed polygon.
error::Expected<MeshPolygons> read_primitive(const Record& record, std::size_t pool_vertices,
                                             const std::string& subject);

// Colours: the palette (record 32), each colour in 128 intensities, and the diffuse colours of materials (record 113).
// These materials are for optical display only. The radar uses SurfaceKind::material, the surface material code.
class ColorPalette {
 public:
  void read_colors(const Record& record, std::int32_t revision);
  void read_material(const Record& record);
  // Colour of a face or mesh record: its packed colour, else its palette colour, else the diffuse colour of its
  // material, else white. `shift`: 0 for a face record, kMeshShift for a mesh record.
  std::uint32_t color_of(const Record& face, std::size_t shift, std::int32_t revision) const;
  std::size_t materials() const { return diffuse_.size(); }

 private:
  std::optional<std::uint32_t> by_index(std::int64_t index) const;

  std::vector<std::uint32_t> colors_;
  std::map<std::int32_t, std::uint32_t> diffuse_;
};

// Reads the surface of face and mesh records: surface kind, one or two sides, subface level. Hidden faces, wireframes
// and lights give nullopt. A surface material code below 0 or above 31 counts as none; unknown_codes() is the number of
// codes above 31.
class SurfaceReader {
 public:
  void set_revision(std::int32_t revision) { revision_ = revision; }
  ColorPalette& colors() { return colors_; }

  // Returns a face without corners. `shift`: 0 for a face record, kMeshShift for a mesh record.
  std::optional<TreeFace> read(const Record& record, std::size_t shift, int subface_level);

  const std::vector<SurfaceKind>& kinds() const { return kinds_.kinds(); }
  std::uint64_t hidden_faces() const { return hidden_faces_; }
  std::uint64_t unknown_codes() const { return unknown_codes_; }

 private:
  std::int32_t revision_ = 0;
  ColorPalette colors_;
  KindTable kinds_;
  std::uint64_t hidden_faces_ = 0;
  std::uint64_t unknown_codes_ = 0;
};

}  // namespace yars::model::scene
