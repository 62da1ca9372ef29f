// A small OpenFlight file with the main kinds of records that the reader supports: groups, objects, levels of detail, a
// switch, instances, an external reference, replication, subfaces, a concave polygon, a mesh of all four primitives
// with a continuation.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lib/geo/frames.hpp"
#include "model/scene/openflight/records.hpp"
#include "tests/model/scene/support.hpp"
#include "worldgen/scene/openflight_writer.hpp"

namespace yars::model::scene {

// Builds a file record by record, including records that worldgen::OpenFlightWriter does not write.
class ByteFile {
 public:
  // Writes the header. `units`: code of the unit of length. `header_bytes`: length of its record.
  explicit ByteFile(std::int32_t revision = 1600, int units = 0,
                    std::size_t header_bytes = openflight::header::kBytes) {
    out_.begin(openflight::kHeader, header_bytes);
    out_.put(openflight::header::kRevision, revision);
    out_.put(openflight::header::kUnits, static_cast<std::uint8_t>(units));
  }
  // Writes a vertex palette. Vertex i begins at byte 8 + 40 i of the palette.
  void palette(const std::vector<Vector3>& positions) {
    constexpr std::size_t kVertexBytes = 40;
    out_.begin(openflight::kVertexPalette, 8);
    out_.put(4, static_cast<std::uint32_t>(8 + kVertexBytes * positions.size()));
    for (const Vector3& position : positions) {
      out_.begin(openflight::kVertexColor, kVertexBytes);
      out_.put(8, position.x);
      out_.put(16, position.y);
      out_.put(24, position.z);
    }
  }
  // Record without data.
  void plain(std::uint16_t opcode) { out_.begin(opcode, 4); }
  void push() { plain(openflight::kPushLevel); }
  void pop() { plain(openflight::kPopLevel); }
  void node(std::uint16_t opcode, const std::string& name, std::size_t bytes) {
    out_.begin(opcode, bytes);
    out_.put_text(4, name, 7);
  }
  void group(const std::string& name) { node(openflight::kGroup, name, 44); }
  void replicate(std::int16_t copies) {
    out_.begin(openflight::kReplicate, 8);
    out_.put(4, copies);
  }
  void matrix(const Transform& m) {
    out_.begin(openflight::kMatrix, 68);
    // Rows of the file are columns of the matrix.
    std::size_t offset = 4;
    for (glm::length_t row = 0; row < 4; ++row)
      for (glm::length_t column = 0; column < 4; ++column, offset += 4)
        out_.put(offset, static_cast<float>(m[row][column]));
  }
  void instance_definition(std::uint16_t number) {
    out_.begin(openflight::kInstanceDefinition, 8);
    out_.put(6, number);
  }
  void instance(std::uint16_t number) {
    out_.begin(openflight::kInstanceReference, 8);
    out_.put(6, number);
  }
  void external(const std::string& name) {
    out_.begin(openflight::kExternalReference, 216);
    out_.put_text(4, name, 199);
  }
  // `bytes`: length of the record, below 80 in older revisions. `code`: surface material code.
  void face(std::size_t bytes = 80, std::uint8_t draw_type = 0, std::int16_t code = 0, std::uint32_t flags = 0) {
    out_.begin(openflight::kFace, bytes);
    out_.put(18, draw_type);
    out_.put(30, std::int16_t{-1});
    if (bytes >= 36) out_.put(32, code);
    if (bytes >= 48) out_.put(44, flags);
  }
  // Level of detail: viewing distances in the file's unit.
  void level(double switch_in, double switch_out, Vector3 centre = {}, std::uint32_t flags = 0) {
    out_.begin(openflight::kLevelOfDetail, 80);
    out_.put(16, switch_in);
    out_.put(24, switch_out);
    out_.put(36, flags);
    for (int axis = 0; axis < 3; ++axis) out_.put(40 + 8 * static_cast<std::size_t>(axis), centre[axis]);
  }
  // Degree of freedom with the local axes of its parent, at `origin`; the numbers at the offsets are its current pose.
  void degree_of_freedom(Vector3 origin, const std::vector<std::pair<std::size_t, double>>& pose) {
    out_.begin(openflight::kDegreeOfFreedom, 384);
    const Vector3 x{1, 0, 0}, xy{1, 1, 0};
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t at = 8 * static_cast<std::size_t>(axis);
      out_.put(16 + at, origin[axis]);
      out_.put(40 + at, origin[axis] + x[axis]);
      out_.put(64 + at, origin[axis] + xy[axis]);
    }
    for (const auto& [offset, value] : pose) out_.put(offset, value);
  }
  void put_u32(std::size_t offset, std::uint32_t value) { out_.put(offset, value); }
  void corners(const std::vector<std::uint32_t>& vertices) {
    out_.begin(openflight::kVertexList, 4 + 4 * vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) out_.put(4 + 4 * i, 8 + 40 * vertices[i]);
  }
  void polygon(const std::vector<std::uint32_t>& vertices, std::int16_t code = 0) {
    face(80, 0, code);
    push();
    corners(vertices);
    pop();
  }
  void mesh(std::int16_t code) {
    out_.begin(openflight::kMesh, 84);
    out_.put(36, code);
  }
  // Vertex pool with positions only. `split`: the second half is in a continuation record.
  void pool(const std::vector<Vector3>& positions, bool split = false) {
    const std::size_t first = split ? positions.size() / 2 : positions.size();
    out_.begin(openflight::kLocalVertexPool, 12 + 24 * first);
    out_.put(4, static_cast<std::uint32_t>(positions.size()));
    out_.put(8, openflight::pool::kPosition);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (split && i == first) out_.begin(openflight::kContinuation, 4 + 24 * (positions.size() - first));
      const std::size_t at = split && i >= first ? 4 + 24 * (i - first) : 12 + 24 * i;
      out_.put(at, positions[i].x);
      out_.put(at + 8, positions[i].y);
      out_.put(at + 16, positions[i].z);
    }
  }
  void primitive(std::int16_t type, const std::vector<std::uint16_t>& indices) {
    out_.begin(openflight::kMeshPrimitive, 12 + 2 * indices.size());
    out_.put(4, type);
    out_.put<std::uint16_t>(6, 2);
    out_.put(8, static_cast<std::uint32_t>(indices.size()));
    for (std::size_t i = 0; i < indices.size(); ++i) out_.put(12 + 2 * i, indices[i]);
  }
  // A square of the palette kSquare in a level of its own.
  void square_below() {
    push();
    polygon({0, 1, 2, 3});
    pop();
  }
  void append(const std::vector<std::byte>& bytes) {
    out_.bytes().insert(out_.bytes().end(), bytes.begin(), bytes.end());
  }
  std::vector<std::byte>& bytes() { return out_.bytes(); }

 private:
  worldgen::RecordBuilder out_;
};

inline std::vector<std::byte> every_record() {
  ByteFile file;
  file.palette({{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}, {5, 2, 0}, {5, 5, 8}});
  file.push();
  file.instance_definition(1);
  file.push();
  file.node(openflight::kObject, "part", 28);
  file.push();
  file.polygon({0, 1, 5}, 3);
  file.pop();
  file.pop();
  file.group("a");
  file.matrix(translation({100, 0, 0}));
  file.replicate(2);
  file.push();
  file.instance(1);
  file.node(openflight::kLevelOfDetail, "fine", 80);
  file.push();
  file.node(openflight::kObject, "plate", 28);
  file.push();
  file.face(80, 1, 9, 0);
  file.push();
  file.corners({0, 1, 4, 2, 3});  // concave
  file.plain(openflight::kPushSubface);
  file.polygon({0, 1, 4}, 6);
  file.plain(openflight::kPopSubface);
  file.pop();
  file.pop();
  file.pop();
  file.node(openflight::kSwitch, "sw", 32);
  file.put_u32(20, 1);
  file.put_u32(24, 1);
  file.put_u32(28, 1);
  file.push();
  file.group("on");
  file.group("off");
  file.pop();
  file.external("none.flt");
  file.node(openflight::kObject, "mesh", 28);
  file.push();
  file.mesh(1);
  file.pool({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}, {1, 2, 0}}, true);
  file.push();
  file.primitive(1, {0, 1, 2, 3});
  file.primitive(2, {0, 1, 3, 2});
  file.primitive(3, {0, 1, 2, 3, 4, 5});
  file.primitive(4, {0, 1, 3, 5, 4, 2});
  file.pop();
  file.pop();
  file.pop();
  file.pop();
  return std::move(file.bytes());
}

}  // namespace yars::model::scene
