#include "model/scene/mesh_record.hpp"

#include "model/scene/openflight_format.hpp"

namespace yars::model::scene {

using namespace openflight;

namespace {

constexpr std::size_t kPoolHead = 12, kPrimitiveHead = 12;
enum Primitive : std::int16_t { kStrip = 1, kFan = 2, kQuadrilateralStrip = 3, kPolygon = 4 };

// Where a vertex's parts lie in a pool.
struct PoolLayout {
  std::size_t stride = 0;
  std::size_t normal = 0;
  bool has_place = false, has_normal = false;
};

PoolLayout layout_of(std::uint32_t mask) {
  PoolLayout layout;
  layout.has_place = (mask & pool::kPosition) != 0;
  layout.has_normal = (mask & pool::kNormal) != 0;
  if (layout.has_place) layout.stride += 24;
  if ((mask & pool::kColorIndex) != 0) layout.stride += 4;
  if ((mask & pool::kColor) != 0) layout.stride += 4;
  layout.normal = layout.stride;
  if (layout.has_normal) layout.stride += 12;
  for (int texture = 0; texture < pool::kTextures; ++texture)
    if ((mask & pool::kFirstTexture >> static_cast<unsigned>(texture)) != 0) layout.stride += 8;
  return layout;
}

tl::unexpected<failure::Error> damaged(const std::string& subject, const Record& record, const std::string& expected,
                                       const std::string& found) {
  return failure::fail(subject, expected, found + " in the mesh record at byte " + std::to_string(record.start()),
                       "the file is damaged; fetch it again");
}

std::size_t index_at(const Record& record, std::size_t at, std::size_t bytes) {
  if (bytes == 1) return *record.number<std::uint8_t>(at);
  if (bytes == 2) return *record.number<std::uint16_t>(at);
  return *record.number<std::uint32_t>(at);
}

// Every second triangle of a strip turns the other way round.
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
  polygons.each = 4;
  for (std::size_t i = 3; i < list.size(); i += 2)
    polygons.corners.insert(polygons.corners.end(), {list[i - 3], list[i - 2], list[i], list[i - 1]});
}

}  // namespace

failure::Expected<std::size_t> read_local_pool(const Record& record, double metres_per_unit, const std::string& subject,
                                               std::vector<TreeVertex>& vertices) {
  const std::size_t count = record.number_or<std::uint32_t>(4, 0);
  const PoolLayout layout = layout_of(record.number_or<std::uint32_t>(8, 0));
  if (count == 0) return std::size_t{0};
  if (!layout.has_place || record.size() < kPoolHead || count > (record.size() - kPoolHead) / layout.stride)
    return damaged(subject, record, "a vertex pool of places, as long as its count says",
                   std::to_string(count) + " vertices of " + std::to_string(layout.stride) + " bytes in " +
                       std::to_string(record.size()));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = kPoolHead + i * layout.stride;
    TreeVertex vertex;
    vertex.place = metres_per_unit *
                   Vector3{*record.number<double>(at), *record.number<double>(at + 8), *record.number<double>(at + 16)};
    for (std::size_t axis = 0; layout.has_normal && axis < 3; ++axis)
      vertex.normal[axis] = *record.number<float>(at + layout.normal + 4 * axis);
    vertices.push_back(vertex);
  }
  return count;
}

failure::Expected<MeshPolygons> read_primitive(const Record& record, std::size_t pool_vertices,
                                               const std::string& subject) {
  const int type = record.number_or<std::int16_t>(4, 0);
  const std::size_t bytes = record.number_or<std::uint16_t>(6, 0);
  const std::size_t count = record.number_or<std::uint32_t>(8, 0);
  if (bytes != 1 && bytes != 2 && bytes != 4)
    return damaged(subject, record, "indices of 1, 2 or 4 bytes", std::to_string(bytes));
  if (record.size() < kPrimitiveHead || count > (record.size() - kPrimitiveHead) / bytes)
    return damaged(subject, record, "as many indices as their count says", std::to_string(count));
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
      polygons.each = count;
      polygons.corners = std::move(list);
      break;
    default:
      return damaged(subject, record, "a primitive of type 1 to 4", std::to_string(type));
  }
  return polygons;
}

}  // namespace yars::model::scene
