#include "model/scene/openflight/record_readers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "lib/geo/frames.hpp"
#include "lib/radar/modes.hpp"
#include "lib/text/plain_text.hpp"
#include "model/scene/openflight/records.hpp"

namespace yars::model::scene {

using namespace openflight;

namespace {

std::optional<double> metres_per_unit(int code) {
  switch (code) {
    case 0:
      return 1.0;
    case 1:
      return 1000.0;
    case 4:
      return 0.3048;
    case 5:
      return 0.0254;
    case 8:
      return geo::kMetresPerNauticalMile;
    default:
      return std::nullopt;
  }
}

// Position from two fields; nullopt if absent, out of range, or exactly 0, 0.
std::optional<geo::GeoPoint> position_at(const Record& record, std::size_t latitude_at, std::size_t longitude_at) {
  const double latitude_deg = record.number_or<double>(latitude_at, 0.0);
  const double longitude_deg = record.number_or<double>(longitude_at, 0.0);
  if (!(std::abs(latitude_deg) <= 90.0) || !(std::abs(longitude_deg) <= 360.0)) return std::nullopt;
  if (latitude_deg == 0.0 && longitude_deg == 0.0) return std::nullopt;
  return geo::GeoPoint{latitude_deg, geo::wrapped_degrees(longitude_deg)};
}

}  // namespace

error::Expected<Header> parse_header(std::span<const std::byte> bytes, const std::string& subject) {
  const std::optional<Record> record = record_at(bytes, 0);
  if (!record || record->opcode() != kHeader || !record->has(header::kRevision, 4))
    return error::fail(subject, "an OpenFlight file, which begins with a header record", "other bytes",
                       "give a .flt file of OpenFlight 14 to 16.7");
  Header found;
  found.revision = *record->number<std::int32_t>(header::kRevision);
  // Programs write revision 14.2 as 1420, as 142 or only as 14. 14 is read as 14.0.
  while (found.revision > 0 && found.revision < 1000) found.revision *= 10;
  if (found.revision < header::kOldestRevision || found.revision > header::kNewestRevision)
    return error::fail(subject, "OpenFlight revision 1400 to 1670", std::to_string(found.revision),
                       "save it as OpenFlight 16");
  const int units = record->number_or<std::uint8_t>(header::kUnits, 0);
  const std::optional<double> scale = metres_per_unit(units);
  if (!scale)
    return error::fail(subject, "units 0 (m), 1 (km), 4 (ft), 5 (in) or 8 (NM)", std::to_string(units),
                       "save it in metres");
  found.metres_per_unit = *scale;
  found.origin = position_at(*record, header::kOriginLatitude, header::kOriginLongitude);
  found.south_west = position_at(*record, header::kSouthLatitude, header::kWestLongitude);
  found.north_east = position_at(*record, header::kNorthLatitude, header::kEastLongitude);
  return found;
}

namespace {

// Three numbers from `offset` on; nullopt if one is absent or not finite.
std::optional<Vector3> vector_at(const Record& record, std::size_t offset) {
  const Vector3 found(record.number_or<double>(offset, NAN), record.number_or<double>(offset + 8, NAN),
                      record.number_or<double>(offset + 16, NAN));
  return std::isfinite(found.x) && std::isfinite(found.y) && std::isfinite(found.z) ? std::optional(found)
                                                                                    : std::nullopt;
}

double finite_or(const Record& record, std::size_t offset, double otherwise) {
  const double found = record.number_or<double>(offset, otherwise);
  return std::isfinite(found) ? found : otherwise;
}

}  // namespace

LevelOfDetail level_of_detail_of(const Record& record, double metres_per_unit) {
  LevelOfDetail level;
  const double in_m = metres_per_unit * std::max(0.0, finite_or(record, level_of_detail::kSwitchIn, 0.0));
  const double out_m = metres_per_unit * std::max(0.0, finite_or(record, level_of_detail::kSwitchOut, 0.0));
  // Without a range, the level is drawn from everywhere.
  if (in_m != out_m) std::tie(level.switch_out_m, level.switch_in_m) = std::minmax(in_m, out_m);
  level.centre = metres_per_unit * vector_at(record, level_of_detail::kCentre).value_or(Vector3{});
  return level;
}

std::vector<std::uint32_t> switch_mask_of(const Record& record) {
  constexpr std::size_t kCurrentAt = 16, kMasksAt = 20, kWordsAt = 24, kFirstWordAt = 28;
  const std::size_t current = record.number_or<std::uint32_t>(kCurrentAt, 0);
  const std::size_t words = record.number_or<std::uint32_t>(kWordsAt, 0);
  std::vector<std::uint32_t> found;
  if (current >= record.number_or<std::uint32_t>(kMasksAt, 0)) return found;
  for (std::size_t word = 0; word < words; ++word) {
    const auto mask = record.number<std::uint32_t>(kFirstWordAt + 4 * (current * words + word));
    if (!mask) break;
    found.push_back(*mask);
  }
  return found;
}

std::optional<Transform> matrix_of(const Record& record, double metres_per_unit) {
  std::array<double, 16> m{};
  for (std::size_t i = 0; i < m.size(); ++i) {
    m[i] = static_cast<double>(record.number_or<float>(4 + 4 * i, i % 5 == 0 ? 1.0F : 0.0F));
    if (!std::isfinite(m[i])) return std::nullopt;
  }
  // The file's matrix acts on row vectors, so its rows are the columns of Transform.
  Transform matrix(m[0], m[1], m[2], 0, m[4], m[5], m[6], 0, m[8], m[9], m[10], 0, 0, 0, 0, 1);
  matrix[3] = glm::dvec4(metres_per_unit * Vector3(m[12], m[13], m[14]), 1.0);
  return matrix;
}

std::optional<Transform> pose_of(const Record& record, double metres_per_unit) {
  using namespace degree_of_freedom;
  const auto origin = vector_at(record, kOrigin), on_x = vector_at(record, kPointOnX),
             in_plane = vector_at(record, kPointInXY);
  if (!origin || !on_x || !in_plane) return std::nullopt;
  Vector3 x = *on_x - *origin, z = cross(x, *in_plane - *origin), y = cross(z, x);
  if (!std::isnormal(length(y))) std::tie(x, y, z) = std::tuple(Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1));
  const auto axis = [](Vector3 along) { return glm::dvec4((1.0 / length(along)) * along, 0.0); };
  const Transform parent_from_local(axis(x), axis(y), axis(z), glm::dvec4(metres_per_unit * *origin, 1.0));
  const auto rotation = [&](std::size_t offset, Vector3 about) {
    return glm::rotate(Transform(1.0), finite_or(record, offset, 0.0) * geo::kRadiansPerDegree, about);
  };
  // Older revisions have no scale, and some programs write 0 for none.
  const auto scale = [&](std::size_t offset) {
    const double found = finite_or(record, offset, 1.0);
    return found == 0.0 ? 1.0 : found;
  };
  const Vector3 moved(finite_or(record, kX, 0.0), finite_or(record, kY, 0.0), finite_or(record, kZ, 0.0));
  return parent_from_local * translation(metres_per_unit * moved) * rotation(kPitch, {1, 0, 0}) *
         rotation(kRoll, {0, 1, 0}) * rotation(kYaw, {0, 0, 1}) *
         scaling({scale(kScaleX), scale(kScaleY), scale(kScaleZ)}) * glm::inverse(parent_from_local);
}

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
