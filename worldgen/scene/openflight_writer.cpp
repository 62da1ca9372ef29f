#include "worldgen/scene/openflight_writer.hpp"

#include <cmath>
#include <cstring>

#include "lib/geo/frames.hpp"
#include "model/scene/openflight/records.hpp"

namespace yars::worldgen {

using namespace model::scene::openflight;

namespace {

constexpr std::size_t kGroupBytes = 44, kObjectBytes = 28, kLodBytes = 80, kSwitchBytes = 32, kMatrixBytes = 68;
constexpr std::size_t kInstanceBytes = 8, kExternalBytes = 216, kMaterialBytes = 84, kPaletteHead = 8;

// To 1e-9 degrees, a tenth of a millimetre: the last bits differ with the version of GeographicLib.
geo::GeoPoint rounded(geo::GeoPoint point) {
  constexpr double kSteps = 1e9;  // a degree
  return {std::round(point.latitude_deg * kSteps) / kSteps, std::round(point.longitude_deg * kSteps) / kSteps};
}

}  // namespace

OpenFlightWriter::OpenFlightWriter(std::optional<geo::GeoPoint> origin, std::int32_t revision)
    : origin_(origin), revision_(revision) {}

void OpenFlightWriter::set_corners(geo::GeoPoint south_west, geo::GeoPoint north_east) {
  south_west_ = rounded(south_west);
  north_east_ = rounded(north_east);
}

void OpenFlightWriter::named(std::uint16_t opcode, const std::string& name, std::size_t bytes, RecordBuilder& record) {
  record.begin(opcode, bytes);
  record.put_text(kNameAt, name, kNameBytes - 1);
}

// Writes a long-id record for names of eight letters or more.
void OpenFlightWriter::long_name(const std::string& name) {
  if (name.size() < kNameBytes) return;
  const std::size_t bytes = (4 + name.size() + 1 + 3) / 4 * 4;
  nodes_.begin(kLongId, bytes);
  nodes_.put_text(4, name, bytes - 5);
}

void OpenFlightWriter::write_matrix(const Transform& matrix) {
  nodes_.begin(kMatrix, kMatrixBytes);
  // OpenFlight multiplies row vectors, so the rows in the file are the columns of the matrix.
  std::size_t offset = 4;
  for (glm::length_t row = 0; row < 4; ++row)
    for (glm::length_t column = 0; column < 4; ++column, offset += 4)
      nodes_.put(offset, static_cast<float>(matrix[row][column]));
}

void OpenFlightWriter::begin_group(const std::string& name, const Transform* matrix) {
  named(kGroup, name, kGroupBytes, nodes_);
  long_name(name);
  if (matrix != nullptr) write_matrix(*matrix);
  nodes_.begin(kPushLevel, 4);
}

void OpenFlightWriter::begin_object(const std::string& name) {
  named(kObject, name, kObjectBytes, nodes_);
  long_name(name);
  nodes_.begin(kPushLevel, 4);
}

void OpenFlightWriter::begin_level_of_detail(const std::string& name, double switch_in_m, double switch_out_m,
                                             Vector3 centre) {
  named(kLevelOfDetail, name, kLodBytes, nodes_);
  nodes_.put(16, switch_in_m);
  nodes_.put(24, switch_out_m);
  nodes_.put(40, centre.x);
  nodes_.put(48, centre.y);
  nodes_.put(56, centre.z);
  nodes_.begin(kPushLevel, 4);
}

void OpenFlightWriter::begin_switch(const std::string& name, std::uint32_t mask) {
  named(kSwitch, name, kSwitchBytes, nodes_);
  nodes_.put<std::uint32_t>(20, 1);  // number of masks
  nodes_.put<std::uint32_t>(24, 1);  // words per mask
  nodes_.put(28, mask);
  nodes_.begin(kPushLevel, 4);
}

void OpenFlightWriter::begin_definition(std::uint16_t number) {
  nodes_.begin(kInstanceDefinition, kInstanceBytes);
  nodes_.put(6, number);
  nodes_.begin(kPushLevel, 4);
}

void OpenFlightWriter::end() {
  nodes_.begin(kPopLevel, 4);
}

void OpenFlightWriter::begin_subfaces() {
  nodes_.begin(kPushSubface, 4);
}

void OpenFlightWriter::end_subfaces() {
  nodes_.begin(kPopSubface, 4);
}

void OpenFlightWriter::instance(std::uint16_t number, const Transform& matrix) {
  begin_group(std::string("i").append(std::to_string(number)), &matrix);
  nodes_.begin(kInstanceReference, kInstanceBytes);
  nodes_.put(6, number);
  end();
}

void OpenFlightWriter::external(const std::string& file, const Transform& matrix) {
  nodes_.begin(kExternalReference, kExternalBytes);
  nodes_.put_text(4, file, 199);
  nodes_.put<std::uint32_t>(208, 0xFE000000U);  // the external file uses its own palettes
  write_matrix(matrix);
}

std::int32_t OpenFlightWriter::color_index(std::uint32_t rgb) {
  const auto known = color_numbers_.find(rgb);
  if (known != color_numbers_.end()) return known->second;
  if (colors_.size() < palette::kColors) colors_.push_back(rgb);
  const auto index = static_cast<std::int32_t>(colors_.size() * palette::kIntensities) - 1;
  color_numbers_.emplace(rgb, index);
  return index;
}

std::uint32_t OpenFlightWriter::vertex(const WriterVertex& corner) {
  const std::array<double, 3> position{corner.position.x, corner.position.y, corner.position.z};
  const std::array<float, 3> normal{static_cast<float>(corner.normal.x), static_cast<float>(corner.normal.y),
                                    static_cast<float>(corner.normal.z)};
  std::string key(sizeof(position) + sizeof(normal), '\0');
  std::memcpy(key.data(), position.data(), sizeof(position));
  std::memcpy(key.data() + sizeof(position), normal.data(), sizeof(normal));
  const auto offset = static_cast<std::uint32_t>(kPaletteHead + vertices_.size());
  const auto [known, added] = vertex_offsets_.emplace(std::move(key), offset);
  if (!added) return known->second;
  vertices_.begin(kVertexColorNormal, vertex::kColorNormalBytes);
  vertices_.put(vertex::kFlags, vertex::kNoColor);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    vertices_.put(vertex::kX + 8 * axis, position[axis]);
    vertices_.put(vertex::kNormal + 4 * axis, normal[axis]);
  }
  vertices_.put<std::int32_t>(48, -1);  // no colour index
  return offset;
}

void OpenFlightWriter::face(std::span<const WriterVertex> corners, const SurfaceKind& kind, bool two_sided) {
  nodes_.begin(kFace, face::kBytes);
  nodes_.put(face::kDrawType, two_sided ? face::kSolidTwoSided : face::kSolidOneSided);
  // -1 means none, at these offsets: detail texture 26, texture 28, texture mapping 64, alternate colour 72, shader 78.
  for (const std::size_t absent : {std::size_t{26}, std::size_t{28}}) nodes_.put<std::int16_t>(absent, -1);
  nodes_.put<std::int16_t>(face::kMaterial, kind.material);
  materials_.emplace(kind.material, kind.color_rgb);
  nodes_.put<std::int16_t>(face::kSurfaceMaterial, kind.material);
  nodes_.put(face::kFeatureId, kind.feature_id);
  nodes_.put(face::kLightMode, face::kLitFaceColor);
  nodes_.put<std::int16_t>(64, -1);
  nodes_.put(face::kColorIndex, color_index(kind.color_rgb));
  nodes_.put<std::int32_t>(72, -1);
  nodes_.put<std::int16_t>(78, -1);
  nodes_.begin(kPushLevel, 4);
  std::vector<std::uint32_t> offsets;
  for (const WriterVertex& corner : corners) offsets.push_back(vertex(corner));
  nodes_.begin(kVertexList, 4 + 4 * offsets.size());
  for (std::size_t i = 0; i < offsets.size(); ++i) nodes_.put(4 + 4 * i, offsets[i]);
  nodes_.begin(kPopLevel, 4);
}

void OpenFlightWriter::write_header(RecordBuilder& out) const {
  out.begin(kHeader, header::kBytes);
  out.put_text(kNameAt, "db", kNameBytes);
  out.put(header::kRevision, revision_);
  // The date is fixed, so that equal scenes are equal files.
  out.put_text(20, "Thu Jan  1 00:00:00 1970", 31);
  out.put<std::int16_t>(60, 1);                         // unit multiplier
  out.put<std::uint32_t>(header::kFlags, 1U << 31);     // vertex normals are saved
  out.put<std::int16_t>(header::kVertexStorage, 1);     // coordinates in double precision
  out.put<std::int32_t>(header::kDatabaseOrigin, 100);  // written in OpenFlight format
  if (south_west_ && north_east_) {
    out.put(header::kSouthLatitude, south_west_->latitude_deg);
    out.put(header::kWestLongitude, south_west_->longitude_deg);
    out.put(header::kNorthLatitude, north_east_->latitude_deg);
    out.put(header::kEastLongitude, north_east_->longitude_deg);
  }
  if (origin_) {
    out.put(header::kOriginLatitude, origin_->latitude_deg);
    out.put(header::kOriginLongitude, origin_->longitude_deg);
  }
}

void OpenFlightWriter::write_palettes(RecordBuilder& out) const {
  out.begin(kColorPalette, palette::kBytes);
  for (std::size_t i = 0; i < colors_.size(); ++i) {
    const std::uint32_t rgb = colors_[i];
    const std::uint32_t bgr = (rgb & 0xFFU) << 16U | (rgb & 0xFF00U) | rgb >> 16U;
    out.put<std::uint32_t>(palette::kFirstColor + 4 * i, 0xFF000000U | bgr);
  }
  for (const auto& [code, rgb] : materials_) {
    out.begin(model::scene::openflight::kMaterial, kMaterialBytes);
    out.put<std::int32_t>(4, code);
    out.put_text(8, "surface" + std::to_string(code), 11);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const auto intensity = static_cast<float>(rgb >> (16 - 8 * channel) & 0xFFU) / 255.0F;
      out.put(24 + 4 * channel, intensity);  // ambient
      out.put(36 + 4 * channel, intensity);  // diffuse
    }
    out.put(76, 1.0F);  // opaque
  }
}

std::vector<std::byte> OpenFlightWriter::take() {
  RecordBuilder out;
  write_header(out);
  write_palettes(out);
  out.begin(kVertexPalette, kPaletteHead);
  out.put(4, static_cast<std::uint32_t>(kPaletteHead + vertices_.size()));
  out.append(vertices_);
  out.begin(kPushLevel, 4);
  out.append(nodes_);
  out.begin(kPopLevel, 4);
  return std::move(out.bytes());
}

}  // namespace yars::worldgen
