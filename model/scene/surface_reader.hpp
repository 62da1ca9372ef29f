// What a face or mesh record says of its surface: kind, sides, level. Hidden ones and those that are no surfaces (wire
// frames, lights) give nothing. Codes beyond 31 count as none given.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/scene/color_palette.hpp"
#include "model/scene/kind_table.hpp"
#include "model/scene/node_tree.hpp"

namespace yars::model::scene {

class SurfaceReader {
 public:
  void set_revision(std::int32_t revision) { revision_ = revision; }
  ColorPalette& colors() { return colors_; }

  // A face without corners. `shift`: how far its fields lie beyond those of a face record.
  std::optional<TreeFace> of(const Record& record, std::size_t shift, int subface_level);

  const std::vector<SurfaceKind>& kinds() const { return kinds_.kinds(); }
  std::uint64_t hidden_faces() const { return hidden_faces_; }
  std::uint64_t foreign_codes() const { return foreign_codes_; }

 private:
  std::int32_t revision_ = 0;
  ColorPalette colors_;
  KindTable kinds_;
  std::uint64_t hidden_faces_ = 0;
  std::uint64_t foreign_codes_ = 0;
};

}  // namespace yars::model::scene
