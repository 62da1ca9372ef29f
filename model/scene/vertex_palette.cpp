#include "model/scene/vertex_palette.hpp"

#include <algorithm>

#include "model/scene/openflight_format.hpp"

namespace yars::model::scene {

using namespace openflight;

void VertexPalette::begin(const Record& palette) {
  // A second palette replaces the first: offsets would be ambiguous.
  start_ = palette.start();
  offsets_.clear();
  vertices_.clear();
}

void VertexPalette::add(const Record& record, double metres_per_unit, std::vector<TreeVertex>& vertices) {
  TreeVertex made;
  made.place =
      metres_per_unit * Vector3{record.number_or<double>(vertex::kX, 0.0), record.number_or<double>(vertex::kY, 0.0),
                                record.number_or<double>(vertex::kZ, 0.0)};
  if (record.opcode() == kVertexColorNormal || record.opcode() == kVertexColorNormalTexture)
    for (std::size_t i = 0; i < 3; ++i) made.normal[i] = record.number_or<float>(vertex::kNormal + 4 * i, 0.0F);
  offsets_.push_back(record.start() - start_);
  vertices_.push_back(static_cast<std::uint32_t>(vertices.size()));
  vertices.push_back(made);
}

std::optional<std::size_t> VertexPalette::find_corners(const Record& list, std::vector<std::uint32_t>& corners) const {
  for (std::size_t at = 4; list.has(at, 4); at += 4) {
    const std::size_t offset = *list.number<std::uint32_t>(at);
    const auto found = std::lower_bound(offsets_.begin(), offsets_.end(), offset);
    if (found == offsets_.end() || *found != offset) return offset;
    corners.push_back(vertices_[static_cast<std::size_t>(found - offsets_.begin())]);
  }
  return std::nullopt;
}

}  // namespace yars::model::scene
