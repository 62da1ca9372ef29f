#include "model/scene/openflight_header.hpp"

#include <cmath>
#include <optional>

#include "model/scene/openflight_format.hpp"
#include "model/scene/record_stream.hpp"

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
      return 1852.0;
    default:
      return std::nullopt;
  }
}

// Nothing when it is absent, no place, or exactly 0, 0, which files write that have none.
std::optional<geo::GeoPoint> place_at(const Record& record, std::size_t latitude_at, std::size_t longitude_at) {
  const double latitude_deg = record.number_or<double>(latitude_at, 0.0);
  const double longitude_deg = record.number_or<double>(longitude_at, 0.0);
  if (!(std::abs(latitude_deg) <= 90.0) || !(std::abs(longitude_deg) <= 360.0)) return std::nullopt;
  if (latitude_deg == 0.0 && longitude_deg == 0.0) return std::nullopt;
  return geo::GeoPoint{latitude_deg, geo::wrapped_degrees(longitude_deg)};
}

}  // namespace

failure::Expected<Header> parse_header(std::span<const std::byte> bytes, const std::string& subject) {
  const std::optional<Record> record = record_at(bytes, 0);
  if (!record || record->opcode() != kHeader || !record->has(header::kRevision, 4))
    return failure::fail(subject, "an OpenFlight file, which begins with a header record", "other bytes",
                         "give a .flt file of OpenFlight 14 to 16.5");
  Header found;
  found.revision = *record->number<std::int32_t>(header::kRevision);
  // 14.2 was written as 14, 142 and 1420 by different programs.
  while (found.revision > 0 && found.revision < 1000) found.revision *= 10;
  if (found.revision < header::kOldestRevision || found.revision > header::kNewestRevision)
    return failure::fail(subject, "OpenFlight revision 1400 to 1650", std::to_string(found.revision),
                         "save it as OpenFlight 16");
  const int units = record->number_or<std::uint8_t>(header::kUnits, 0);
  const std::optional<double> scale = metres_per_unit(units);
  if (!scale)
    return failure::fail(subject, "units 0 (m), 1 (km), 4 (ft), 5 (in) or 8 (NM)", std::to_string(units),
                         "save it in metres");
  found.metres_per_unit = *scale;
  found.origin = place_at(*record, header::kOriginLatitude, header::kOriginLongitude);
  found.south_west = place_at(*record, header::kSouthLatitude, header::kWestLongitude);
  found.north_east = place_at(*record, header::kNorthLatitude, header::kEastLongitude);
  return found;
}

}  // namespace yars::model::scene
