#include "model/scene/openflight/node_records.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

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

}  // namespace yars::model::scene
