// The vertex palette (records 67 to 71): its vertices in metres, found again by their offsets from record 67.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/scene/node_tree.hpp"
#include "model/scene/record_stream.hpp"

namespace yars::model::scene {

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

}  // namespace yars::model::scene
