#include "databuffer/bridges/flightgear.hpp"

#include <array>
#include <string>

#include "lib/geo/quantity.hpp"

namespace yars::databuffer::bridges {

namespace {

struct Form {
  std::uint32_t version;
  std::size_t bytes;
};
constexpr std::array<Form, 2> kForms{{{24, 408}, {25, 552}}};

// Where the fields stand [bytes].
constexpr std::size_t kLongitude = 8, kLatitude = 16, kAltitude = 24;      // f64: rad, rad, m
constexpr std::size_t kRoll = 36, kPitch = 40, kHeading = 44;              // f32: rad
constexpr std::size_t kRollRate = 56, kPitchRate = 60, kHeadingRate = 64;  // f32: rad/s
constexpr std::size_t kNorth = 76, kEast = 80, kDown = 84;                 // f32: ft/s

double degrees_at(Bytes packet, std::size_t offset) {
  return static_cast<double>(big_endian<float>(packet, offset)) / geo::kRadiansPerDegree;
}

double speed_at(Bytes packet, std::size_t offset) {
  return static_cast<double>(big_endian<float>(packet, offset)) * geo::kMetresPerFoot;
}

bool is_known_form(Bytes packet) {
  if (packet.size() < sizeof(std::uint32_t)) return false;
  const auto version = big_endian<std::uint32_t>(packet, 0);
  for (const Form& form : kForms)
    if (form.version == version && form.bytes == packet.size()) return true;
  return false;
}

std::string form_of(Bytes packet) {
  const std::string bytes = std::to_string(packet.size()) + " bytes";
  if (packet.size() < sizeof(std::uint32_t)) return bytes;
  return "version " + std::to_string(big_endian<std::uint32_t>(packet, 0)) + " and " + bytes;
}

}  // namespace

failure::Expected<ExternalSample> decode_flightgear(Bytes packet) {
  if (!is_known_form(packet))
    return failure::fail("flightgear", "version 24 and 408 bytes, or 25 and 552", form_of(packet),
                         "send it by --native-fdm=socket,out,30,HOST,PORT,udp");
  Reading reading{};
  reading.latitude_deg = big_endian<double>(packet, kLatitude) / geo::kRadiansPerDegree;
  reading.longitude_deg = big_endian<double>(packet, kLongitude) / geo::kRadiansPerDegree;
  reading.altitude_msl_m = big_endian<double>(packet, kAltitude);
  reading.heading_deg = degrees_at(packet, kHeading);
  reading.pitch_deg = degrees_at(packet, kPitch);
  reading.roll_deg = degrees_at(packet, kRoll);
  reading.velocity_north_mps = speed_at(packet, kNorth);
  reading.velocity_east_mps = speed_at(packet, kEast);
  reading.velocity_down_mps = speed_at(packet, kDown);
  const AttitudeRates rates{degrees_at(packet, kHeadingRate), degrees_at(packet, kPitchRate),
                            degrees_at(packet, kRollRate)};
  return checked_sample("flightgear", reading, rates);
}

}  // namespace yars::databuffer::bridges
