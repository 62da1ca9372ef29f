// The two records that carry a mesh: its local vertex pool (85) and its primitives (86: strips, fans, quadrilateral
// strips, indexed polygons). Errors: counts that the record's length does not bear out, an index outside the pool.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "model/scene/node_tree.hpp"
#include "model/scene/record_stream.hpp"

namespace yars::model::scene {

// Appends the pool's vertices, in metres; how many they are.
failure::Expected<std::size_t> read_local_pool(const Record& record, double metres_per_unit, const std::string& subject,
                                               std::vector<TreeVertex>& vertices);

// Polygons of `each` corners, one behind the other, counter-clockwise from outside; corners index the pool.
struct MeshPolygons {
  std::size_t each = 3;
  std::vector<std::uint32_t> corners;
  std::size_t listed = 0;  // indices that the record holds
};

failure::Expected<MeshPolygons> read_primitive(const Record& record, std::size_t pool_vertices,
                                               const std::string& subject);

}  // namespace yars::model::scene
