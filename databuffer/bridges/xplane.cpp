#include "databuffer/bridges/xplane.hpp"

#include <cmath>
#include <cstring>
#include <string>

#include "databuffer/records/plain_text.hpp"
#include "lib/geo/frames.hpp"

namespace yars::databuffer::bridges {

namespace {

constexpr std::size_t kRequestBytes = 413;
constexpr std::size_t kHeadBytes = 5;  // "RREF" and a byte that is X-Plane's own
constexpr std::size_t kPairBytes = 8;
constexpr std::string_view kMark = "RREF";
constexpr std::uint32_t kAllCame = (1U << kXplaneDatarefs) - 1U;
constexpr geo::Duration kPatience = geo::Duration::seconds(1.0);  // without replies, before asking again

enum Dataref : std::size_t {
  kLatitude,
  kLongitude,
  kElevation,
  kVx,
  kVy,
  kVz,
  kRefLatitude,
  kRefLongitude,
  kHeading,
  kPitch,
  kRoll,
  kRollRate,
  kPitchRate,
  kYawRate
};

// X-Plane's frame: x east, y up, z south, level at its reference point.
geo::Vector3 enu_velocity(const std::array<float, kXplaneDatarefs>& values) {
  const auto frame_at = [](double latitude_deg, double longitude_deg) {
    return geo::LocalTangentFrame({latitude_deg, longitude_deg}, geo::HeightAboveEllipsoid());
  };
  const geo::Vector3 at_reference{values[kVx], -static_cast<double>(values[kVz]), values[kVy]};
  const geo::Vector3 ecef = frame_at(values[kRefLatitude], values[kRefLongitude]).ecef_from_enu_direction(at_reference);
  return frame_at(values[kLatitude], values[kLongitude]).enu_from_ecef_direction(ecef);
}

failure::Expected<ExternalSample> sample_of(const std::array<float, kXplaneDatarefs>& values) {
  // Frames are for places on the Earth alone.
  for (const std::size_t latitude : {kLatitude, kRefLatitude})
    if (!(std::abs(values[latitude]) <= 90.0F))
      return failure::fail("xplane", std::string(kXplaneNames[latitude]) + " in [-90, 90]",
                           text_of_number(values[latitude]));
  for (const std::size_t longitude : {kLongitude, kRefLongitude})
    if (!(std::abs(values[longitude]) <= 180.0F))
      return failure::fail("xplane", std::string(kXplaneNames[longitude]) + " in [-180, 180]",
                           text_of_number(values[longitude]));
  const geo::Vector3 velocity = enu_velocity(values);
  const Reading reading{values[kLatitude], values[kLongitude], values[kElevation], values[kHeading], values[kPitch],
                        values[kRoll],     velocity.y,         velocity.x,         -velocity.z};
  return checked_sample(
      "xplane", reading,
      rates_from_body(values[kRollRate], values[kPitchRate], values[kYawRate], values[kPitch], values[kRoll]));
}

}  // namespace

const std::array<std::string_view, kXplaneDatarefs> kXplaneNames{
    "sim/flightmodel/position/latitude",   "sim/flightmodel/position/longitude", "sim/flightmodel/position/elevation",
    "sim/flightmodel/position/local_vx",   "sim/flightmodel/position/local_vy",  "sim/flightmodel/position/local_vz",
    "sim/flightmodel/position/lat_ref",    "sim/flightmodel/position/lon_ref",   "sim/flightmodel/position/true_psi",
    "sim/flightmodel/position/true_theta", "sim/flightmodel/position/true_phi",  "sim/flightmodel/position/P",
    "sim/flightmodel/position/Q",          "sim/flightmodel/position/R"};

Datagram xplane_request(std::size_t number, int times_a_second) {
  Datagram request(kRequestBytes, std::byte{0});
  const auto put = [&request](std::size_t offset, std::uint32_t word) {
    for (std::size_t byte = 0; byte < sizeof word; ++byte)
      request[offset + byte] = static_cast<std::byte>(word >> (8 * byte) & 0xffU);
  };
  std::memcpy(request.data(), kMark.data(), kMark.size());
  put(kHeadBytes, static_cast<std::uint32_t>(times_a_second));
  put(kHeadBytes + 4, static_cast<std::uint32_t>(number));
  std::memcpy(request.data() + kHeadBytes + 8, kXplaneNames[number].data(), kXplaneNames[number].size());
  return request;
}

failure::Expected<std::optional<ExternalSample>> XplaneBridge::receive(Bytes datagram, geo::Duration now) {
  const bool marked = datagram.size() >= kHeadBytes && std::memcmp(datagram.data(), kMark.data(), kMark.size()) == 0;
  if (!marked || (datagram.size() - kHeadBytes) % kPairBytes != 0)
    return failure::fail("xplane", "RREF, a byte, and pairs of 8 bytes", std::to_string(datagram.size()) + " bytes");
  for (std::size_t offset = kHeadBytes; offset < datagram.size(); offset += kPairBytes) {
    const auto number = little_endian<std::uint32_t>(datagram, offset);
    if (number >= kXplaneDatarefs) continue;
    const auto value = little_endian<float>(datagram, offset + 4);
    if (!std::isfinite(value))
      return failure::fail("xplane", std::string(kXplaneNames[number]) + ", a number", text_of_number(value));
    values_[number] = value;
    come_ |= 1U << number;
    heard_ = now;
  }
  if (come_ != kAllCame) return std::nullopt;
  come_ = 0;
  const auto sample = sample_of(values_);
  if (!sample) return tl::unexpected(sample.error());
  return *sample;
}

std::vector<Datagram> XplaneBridge::requests(geo::Duration now) {
  const auto over = [now](const std::optional<geo::Duration>& then) { return !then || now - *then >= kPatience; };
  if (!over(asked_) || !over(heard_)) return {};
  asked_ = now;
  std::vector<Datagram> all;
  for (std::size_t number = 0; number < kXplaneDatarefs; ++number) all.push_back(xplane_request(number, kXplaneRate));
  return all;
}

std::vector<Datagram> XplaneBridge::farewell() const {
  std::vector<Datagram> all;
  for (std::size_t number = 0; number < kXplaneDatarefs; ++number) all.push_back(xplane_request(number, 0));
  return all;
}

}  // namespace yars::databuffer::bridges
