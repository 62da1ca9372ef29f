#include "model/scene/surface_reader.hpp"

#include <algorithm>

#include "lib/radar/world.hpp"
#include "model/scene/openflight_format.hpp"

namespace yars::model::scene {

using namespace openflight;

std::optional<TreeFace> SurfaceReader::of(const Record& record, std::size_t shift, int subface_level) {
  const auto draw_type = record.number_or<std::uint8_t>(face::kDrawType + shift, face::kSolidOneSided);
  const auto flags = record.number_or<std::uint32_t>(face::kFlags + shift, 0);
  if ((flags & face::kHidden) != 0) {
    ++hidden_faces_;
    return std::nullopt;
  }
  if (draw_type != face::kSolidOneSided && draw_type != face::kSolidTwoSided && draw_type != face::kSurround)
    return std::nullopt;
  SurfaceKind kind;
  const int code = record.number_or<std::int16_t>(face::kSurfaceMaterial + shift, 0);
  if (code > 0 && code < radar::kMaterials) kind.material = static_cast<std::uint8_t>(code);
  foreign_codes_ += code >= radar::kMaterials ? 1 : 0;
  kind.feature_id = record.number_or<std::uint16_t>(face::kFeatureId + shift, 0);
  kind.color_rgb = colors_.color_of(record, shift, revision_);
  TreeFace found;
  found.kind = kinds_.number_of(kind);
  found.two_sided = draw_type == face::kSolidTwoSided;
  found.subface_level = static_cast<std::uint8_t>(std::min(subface_level, 255));
  return found;
}

}  // namespace yars::model::scene
