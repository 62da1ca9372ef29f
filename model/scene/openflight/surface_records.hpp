// Records of surfaces: vertex palette, meshes, colours, faces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/scene/openflight/node_tree.hpp"
#include "model/scene/openflight/records.hpp"

namespace yars::model::scene {

// The vertex palette (records 67 to 71): its vertices in metres, found again by their offsets from record 67.
class VertexPalette {
 public:
  void begin(const Record& palette);
  // Appends one vertex of any kind.
  void add(const Record& record, double metres_per_unit, std::vector<TreeVertex>& vertices);
  // Appends the vertices of a vertex list; what is returned is an offset at which there is none.
  std::optional<std::size_t> find_corners(const Record& vertex_list, std::vector<std::uint32_t>& corners) const;

 private:
  std::size_t start_ = 0;
  std::vector<std::size_t> offsets_;  // ascending
  std::vector<std::uint32_t> vertices_;
};

// The two records that carry a mesh: its local vertex pool (85) and its primitives (86: strips, fans, quadrilateral
// strips, indexed polygons). Errors: counts that the record's length does not bear out, an index outside the pool.

// Appends the pool's vertices, in metres; how many they are.
error::Expected<std::size_t> read_local_pool(const Record& record, double metres_per_unit, const std::string& subject,
                                             std::vector<TreeVertex>& vertices);

// Polygons of `each` corners, one behind the other, counter-clockwise from outside; corners index the pool.
struct MeshPolygons {
  std::size_t each = 3;
  std::vector<std::uint32_t> corners;
  std::size_t listed = 0;  // indices that the record holds
};

error::Expected<MeshPolygons> read_primitive(const Record& record, std::size_t pool_vertices,
                                             const std::string& subject);

// Colours of an OpenFlight file: the palette (record 32), whose entries come in 128 intensities, and the diffuse
// colours of its materials (record 113). Colours are 0xRRGGBB.
class ColorPalette {
 public:
  void read_colors(const Record& record, std::int32_t revision);
  void read_material(const Record& record);
  // The colour of a face or of a mesh, whose fields lie `shift` bytes further on. In order: packed, by index and
  // intensity, the material's diffuse colour, white.
  std::uint32_t color_of(const Record& face, std::size_t shift, std::int32_t revision) const;
  std::size_t materials() const { return diffuse_.size(); }

 private:
  std::optional<std::uint32_t> by_index(std::int64_t index) const;

  std::vector<std::uint32_t> colors_;
  std::map<std::int32_t, std::uint32_t> diffuse_;
};

// What a face or mesh record says of its surface: kind, sides, level. Hidden ones and those that are no surfaces (wire
// frames, lights) give nothing. Codes beyond 31 count as none given.
class SurfaceReader {
 public:
  void set_revision(std::int32_t revision) { revision_ = revision; }
  ColorPalette& colors() { return colors_; }

  // A face without corners. `shift`: how far its fields lie beyond those of a face record.
  std::optional<TreeFace> of(const Record& record, std::size_t shift, int subface_level);

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
