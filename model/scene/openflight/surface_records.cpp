#include "model/scene/openflight/surface_records.hpp"

#include <algorithm>
#include <cmath>

#include "lib/geo/frames.hpp"
#include "lib/radar/modes.hpp"
#include "lib/text/plain_text.hpp"
#include "model/scene/openflight/records.hpp"

namespace yars::model::scene {

using namespace openflight;

void VertexPalette::begin(const Record& palette) {
  // A second palette replaces the first. With both, offsets would be ambiguous.
  start_ = palette.start();
  offsets_.clear();
  vertices_.clear();
}

void VertexPalette::add(const Record& record, double metres_per_unit, std::vector<TreeVertex>& vertices) {
  TreeVertex parsed;
  parsed.position =
      metres_per_unit * Vector3{record.number_or<double>(vertex::kX, 0.0), record.number_or<double>(vertex::kY, 0.0),
                                record.number_or<double>(vertex::kZ, 0.0)};
  if (record.opcode() == kVertexColorNormal || record.opcode() == kVertexColorNormalTexture)
    for (std::size_t i = 0; i < 3; ++i) parsed.normal[i] = record.number_or<float>(vertex::kNormal + 4 * i, 0.0F);
  offsets_.push_back(record.start() - start_);
  vertices_.push_back(static_cast<std::uint32_t>(vertices.size()));
  vertices.push_back(parsed);
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

namespace {

constexpr std::size_t kPoolHead = 12, kPrimitiveHead = 12;
enum Primitive : std::int16_t { kStrip = 1, kFan = 2, kQuadrilateralStrip = 3, kPolygon = 4 };

// Layout of a vertex in a local pool: distance between vertices and offset of the normal, in bytes.
struct PoolLayout {
  std::size_t stride = 0;
  std::size_t normal = 0;
  bool has_position = false, has_normal = false;
};

PoolLayout layout_of(std::uint32_t mask) {
  PoolLayout layout;
  layout.has_position = (mask & pool::kPosition) != 0;
  layout.has_normal = (mask & pool::kNormal) != 0;
  if (layout.has_position) layout.stride += 24;
  if ((mask & pool::kColorIndex) != 0) layout.stride += 4;
  if ((mask & pool::kColor) != 0) layout.stride += 4;
  layout.normal = layout.stride;
  if (layout.has_normal) layout.stride += 12;
  for (int texture = 0; texture < pool::kTextures; ++texture)
    if ((mask & pool::kFirstTexture >> static_cast<unsigned>(texture)) != 0) layout.stride += 8;
  return layout;
}

tl::unexpected<error::Error> damaged(const std::string& subject, const Record& record, const std::string& expected,
                                     const std::string& found) {
  return error::fail(subject, expected, found + " in the mesh record at byte " + std::to_string(record.start()),
                     "the file is damaged; fetch it again");
}

std::size_t index_at(const Record& record, std::size_t at, std::size_t bytes) {
  if (bytes == 1) return *record.number<std::uint8_t>(at);
  if (bytes == 2) return *record.number<std::uint16_t>(at);
  return *record.number<std::uint32_t>(at);
}

// Every second triangle of a strip has the opposite orientation, so two corners of each such triangle are swapped.
void add_strip(const std::vector<std::uint32_t>& list, MeshPolygons& polygons) {
  for (std::size_t i = 2; i < list.size(); ++i) {
    const bool odd = i % 2 == 1;
    polygons.corners.insert(polygons.corners.end(), {list[odd ? i - 1 : i - 2], list[odd ? i - 2 : i - 1], list[i]});
  }
}

void add_fan(const std::vector<std::uint32_t>& list, MeshPolygons& polygons) {
  for (std::size_t i = 2; i < list.size(); ++i)
    polygons.corners.insert(polygons.corners.end(), {list[0], list[i - 1], list[i]});
}

void add_quadrilaterals(const std::vector<std::uint32_t>& list, MeshPolygons& polygons) {
  polygons.corners_per_polygon = 4;
  for (std::size_t i = 3; i < list.size(); i += 2)
    polygons.corners.insert(polygons.corners.end(), {list[i - 3], list[i - 2], list[i], list[i - 1]});
}

}  // namespace

error::Expected<std::size_t> read_local_pool(const Record& record, double metres_per_unit, const std::string& subject,
                                             std::vector<TreeVertex>& vertices) {
  const std::size_t count = record.number_or<std::uint32_t>(4, 0);
  const PoolLayout layout = layout_of(record.number_or<std::uint32_t>(8, 0));
  if (count == 0) return std::size_t{0};
  if (!layout.has_position || record.size() < kPoolHead || count > (record.size() - kPoolHead) / layout.stride)
    return damaged(subject, record, "a vertex pool with positions, and long enough for its count",
                   std::to_string(count) + " vertices of " + std::to_string(layout.stride) + " bytes in " +
                       text::counted(record.size(), "byte"));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = kPoolHead + i * layout.stride;
    TreeVertex vertex;
    vertex.position = metres_per_unit * Vector3{*record.number<double>(at), *record.number<double>(at + 8),
                                                *record.number<double>(at + 16)};
    for (std::size_t axis = 0; layout.has_normal && axis < 3; ++axis)
      vertex.normal[axis] = *record.number<float>(at + layout.normal + 4 * axis);
    vertices.push_back(vertex);
  }
  return count;
}

error::Expected<MeshPolygons> read_primitive(const Record& record, std::size_t pool_vertices,
                                             const std::string& subject) {
  const int type = record.number_or<std::int16_t>(4, 0);
  const std::size_t bytes = record.number_or<std::uint16_t>(6, 0);
  const std::size_t count = record.number_or<std::uint32_t>(8, 0);
  if (bytes != 1 && bytes != 2 && bytes != 4)
    return damaged(subject, record, "indices of 1, 2 or 4 bytes", std::to_string(bytes));
  if (record.size() < kPrimitiveHead || count > (record.size() - kPrimitiveHead) / bytes)
    return damaged(subject, record, "a record long enough for its count of indices", std::to_string(count));
  std::vector<std::uint32_t> list(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t index = index_at(record, kPrimitiveHead + i * bytes, bytes);
    if (index >= pool_vertices)
      return damaged(subject, record, "indices below " + std::to_string(pool_vertices), std::to_string(index));
    list[i] = static_cast<std::uint32_t>(index);
  }
  MeshPolygons polygons;
  polygons.listed = count;
  switch (type) {
    case kStrip:
      add_strip(list, polygons);
      break;
    case kFan:
      add_fan(list, polygons);
      break;
    case kQuadrilateralStrip:
      add_quadrilaterals(list, polygons);
      break;
    case kPolygon:
      polygons.corners_per_polygon = count;
      polygons.corners = std::move(list);
      break;
    default:
      return damaged(subject, record, "a primitive of type 1 to 4", std::to_string(type));
  }
  return polygons;
}

namespace {

constexpr std::uint32_t kWhite = 0xFFFFFF;
// First revision with a colour index field. Earlier revisions have the index in the colour name field.
constexpr std::int32_t kIndexRevision = 1510;

// Converts 0xAABBGGRR to 0xRRGGBB.
std::uint32_t rgb_of_abgr(std::uint32_t abgr) {
  return (abgr & 0xFFU) << 16U | (abgr & 0xFF00U) | (abgr >> 16U & 0xFFU);
}

std::uint32_t byte_of(double level) {
  return static_cast<std::uint32_t>(std::lround(255.0 * std::clamp(std::isfinite(level) ? level : 1.0, 0.0, 1.0)));
}

}  // namespace

void ColorPalette::read_colors(const Record& record, std::int32_t revision) {
  // The revision gives the number of colours. The record's length does not, because names may come after the colours.
  const std::size_t max_colors = revision >= kIndexRevision ? palette::kColors : palette::kColors / 2;
  colors_.clear();
  for (std::size_t at = palette::kFirstColor; colors_.size() < max_colors; at += 4) {
    const auto color = record.number<std::uint32_t>(at);
    if (!color) break;
    colors_.push_back(rgb_of_abgr(*color));
  }
}

void ColorPalette::read_material(const Record& record) {
  constexpr std::size_t kIndexAt = 4, kDiffuseAt = 36;
  const auto index = record.number<std::int32_t>(kIndexAt);
  if (!index) return;
  std::uint32_t color = 0;
  for (std::size_t channel = 0; channel < 3; ++channel)
    color = color << 8U | byte_of(record.number_or<float>(kDiffuseAt + 4 * channel, 1.0F));
  diffuse_[*index] = color;
}

std::optional<std::uint32_t> ColorPalette::by_index(std::int64_t index) const {
  if (index < 0 || static_cast<std::size_t>(index / palette::kIntensities) >= colors_.size()) return std::nullopt;
  const std::uint32_t full = colors_[static_cast<std::size_t>(index / palette::kIntensities)];
  const double intensity = static_cast<double>(index % palette::kIntensities) / (palette::kIntensities - 1);
  std::uint32_t color = 0;
  for (const unsigned shift : {16U, 8U, 0U})
    color |= static_cast<std::uint32_t>(std::lround(intensity * (full >> shift & 0xFFU))) << shift;
  return color;
}

std::uint32_t ColorPalette::color_of(const Record& record, std::size_t shift, std::int32_t revision) const {
  const auto flags = record.number_or<std::uint32_t>(face::kFlags + shift, 0);
  if ((flags & face::kNoColor) == 0) {
    if ((flags & face::kPacked) != 0)
      if (const auto packed = record.number<std::uint32_t>(face::kPackedColor + shift)) return rgb_of_abgr(*packed);
    const std::int64_t index = revision >= kIndexRevision
                                   ? record.number_or<std::int32_t>(face::kColorIndex + shift, -1)
                                   : record.number_or<std::int16_t>(face::kColorName + shift, -1);
    if (const auto color = by_index(index)) return *color;
  }
  const auto material = diffuse_.find(record.number_or<std::int16_t>(face::kMaterial + shift, -1));
  return material == diffuse_.end() ? kWhite : material->second;
}

std::optional<TreeFace> SurfaceReader::read(const Record& record, std::size_t shift, int subface_level) {
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
  unknown_codes_ += code >= radar::kMaterials ? 1 : 0;
  kind.feature_id = record.number_or<std::uint16_t>(face::kFeatureId + shift, 0);
  kind.color_rgb = colors_.color_of(record, shift, revision_);
  TreeFace found;
  found.kind = kinds_.number_of(kind);
  found.two_sided = draw_type == face::kSolidTwoSided;
  found.subface_level = static_cast<std::uint8_t>(std::min(subface_level, 255));
  return found;
}

}  // namespace yars::model::scene
