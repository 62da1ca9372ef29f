#include "flightmodel/bridges/bridge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lib/geo/frames.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::flightmodel::bridges {

namespace {

struct Form {
  std::uint32_t version;
  std::size_t bytes;
};
constexpr std::array<Form, 2> kForms{{{24, 408}, {25, 552}}};

// Offsets of the fields of FlightGear's packet [bytes].
namespace fdm {
constexpr std::size_t kLongitude = 8, kLatitude = 16, kAltitude = 24;      // f64: rad, rad, m
constexpr std::size_t kRoll = 36, kPitch = 40, kHeading = 44;              // f32: rad
constexpr std::size_t kRollRate = 56, kPitchRate = 60, kHeadingRate = 64;  // f32: rad/s
constexpr std::size_t kNorth = 76, kEast = 80, kDown = 84;                 // f32: ft/s
}  // namespace fdm

double degrees_at(memory::Bytes packet, std::size_t offset) {
  return static_cast<double>(memory::big_endian<float>(packet, offset)) / geo::kRadiansPerDegree;
}

double speed_at(memory::Bytes packet, std::size_t offset) {
  return static_cast<double>(memory::big_endian<float>(packet, offset)) * geo::kMetresPerFoot;
}

bool is_known_form(memory::Bytes packet) {
  if (packet.size() < sizeof(std::uint32_t)) return false;
  const auto version = memory::big_endian<std::uint32_t>(packet, 0);
  for (const Form& form : kForms)
    if (form.version == version && form.bytes == packet.size()) return true;
  return false;
}

std::string form_of(memory::Bytes packet) {
  std::string bytes = text::counted(packet.size(), "byte");
  if (packet.size() < sizeof(std::uint32_t)) return bytes;
  return "version " + std::to_string(memory::big_endian<std::uint32_t>(packet, 0)) + " and " + bytes;
}

}  // namespace

error::Expected<ExternalSample> decode_flightgear(memory::Bytes packet) {
  if (!is_known_form(packet))
    return error::fail("flightgear", "version 24 and 408 bytes, or 25 and 552", form_of(packet),
                       "send it by --native-fdm=socket,out,30,HOST,PORT,udp");
  Reading reading{};
  const auto latitude_rad = memory::big_endian<double>(packet, fdm::kLatitude),
             longitude_rad = memory::big_endian<double>(packet, fdm::kLongitude);
  // Angles in degrees are the usual mistake of other programs.
  for (const auto& [name, angle_rad] : {std::pair("latitude", latitude_rad), std::pair("longitude", longitude_rad)})
    if (std::abs(angle_rad) > 2.0 * std::numbers::pi)
      return error::fail("flightgear", std::string(name) + " in radians", text::text_of_number(angle_rad));
  reading.latitude_deg = latitude_rad / geo::kRadiansPerDegree;
  reading.longitude_deg = longitude_rad / geo::kRadiansPerDegree;
  reading.altitude_msl_m = memory::big_endian<double>(packet, fdm::kAltitude);
  reading.heading_deg = degrees_at(packet, fdm::kHeading);
  reading.pitch_deg = degrees_at(packet, fdm::kPitch);
  reading.roll_deg = degrees_at(packet, fdm::kRoll);
  reading.velocity_north_mps = speed_at(packet, fdm::kNorth);
  reading.velocity_east_mps = speed_at(packet, fdm::kEast);
  reading.velocity_down_mps = speed_at(packet, fdm::kDown);
  const AttitudeRates rates{degrees_at(packet, fdm::kHeadingRate), degrees_at(packet, fdm::kPitchRate),
                            degrees_at(packet, fdm::kRollRate)};
  return checked_sample("flightgear", reading, rates);
}

namespace {

constexpr std::string_view kLabels = "<LABELS>";

namespace jsbsim {
enum Value : std::size_t { kLatitude, kLongitude, kAltitude, kRoll, kPitch, kHeading, kNorth, kEast, kDown, kTime };
}

constexpr std::array<std::string_view, kJsbsimValues> kNames{"position/lat-geod-deg",  "position/long-gc-deg",
                                                             "position/h-sl-ft",       "attitude/phi-deg",
                                                             "attitude/theta-deg",     "attitude/psi-deg",
                                                             "velocities/v-north-fps", "velocities/v-east-fps",
                                                             "velocities/v-down-fps",  "Time"};

// Labels of geocentric latitude. It differs from geodetic latitude by 0.19 deg at 45 deg, which is 11 NM.
constexpr std::array<std::string_view, 4> kGeocentric{"lat-gc-deg", "lat-gc-rad", "Latitude (deg)",
                                                      "Latitude Geocentric (deg)"};

constexpr std::size_t kMaxShownCharacters = 24;  // maximum length of a malformed field that an error quotes

std::string_view last_part(std::string_view name) {
  return name.substr(name.find_last_of('/') + 1);
}

// True if the label names the property. Some versions of JSBSim print the whole name, others only its last part.
bool names(std::string_view label, std::string_view property) {
  return label == property || last_part(label) == last_part(property);
}

// Printable form of a field, shortened for a message.
std::string shown(std::string_view field) {
  std::string text(field.substr(0, kMaxShownCharacters));
  std::ranges::replace_if(text, [](char character) { return character < ' ' || character > '~'; }, '?');
  return text;
}

error::Error missing_columns(const std::vector<std::string_view>& labels, const std::string& missing) {
  const bool geocentric = std::ranges::any_of(labels, [](std::string_view label) {
    return std::ranges::find(kGeocentric, last_part(label)) != kGeocentric.end();
  });
  const std::string found = std::to_string(labels.size()) + " columns without " + missing +
                            (geocentric ? " (the given latitude is geocentric, up to 11 NM off)" : "");
  return {"jsbsim", "columns of position, attitude and velocity", found,
          "put <property>NAME</property> for each of them into the <output> of the aircraft"};
}

}  // namespace

error::Expected<JsbsimColumns> parse_jsbsim_labels(std::string_view line) {
  if (!line.starts_with(kLabels)) return error::fail("jsbsim", std::string(kLabels), "another line");
  line.remove_prefix(kLabels.size());
  std::vector<std::string_view> labels = text::fields_of(line, ',');
  // A comma follows <LABELS>, which makes an empty first label.
  if (labels.front().empty()) labels.erase(labels.begin());
  JsbsimColumns columns;
  columns.count = labels.size();
  std::string missing;
  for (std::size_t value = 0; value < kJsbsimValues; ++value) {
    const auto found =
        std::ranges::find_if(labels, [&](std::string_view label) { return names(label, kNames[value]); });
    columns.of_value[value] = static_cast<std::size_t>(found - labels.begin());
    if (found == labels.end()) missing += (missing.empty() ? "" : ", ") + std::string(kNames[value]);
  }
  if (!missing.empty()) return tl::unexpected(missing_columns(labels, missing));
  return columns;
}

error::Expected<JsbsimState> parse_jsbsim_line(const JsbsimColumns& columns, std::string_view line) {
  const std::vector<std::string_view> fields = text::fields_of(line, ',');
  if (fields.size() != columns.count)
    return error::fail("jsbsim", std::to_string(columns.count) + " columns, one for each label",
                       std::to_string(fields.size()));
  std::array<double, kJsbsimValues> values{};
  for (std::size_t value = 0; value < kJsbsimValues; ++value) {
    const std::string_view field = fields[columns.of_value[value]];
    const auto number = text::finite_number(field);
    if (!number) return error::fail("jsbsim", std::string(kNames[value]) + ", a number", '"' + shown(field) + '"');
    values[value] = *number;
  }
  const Reading reading{values[jsbsim::kLatitude],
                        values[jsbsim::kLongitude],
                        values[jsbsim::kAltitude] * geo::kMetresPerFoot,
                        values[jsbsim::kHeading],
                        values[jsbsim::kPitch],
                        values[jsbsim::kRoll],
                        values[jsbsim::kNorth] * geo::kMetresPerFoot,
                        values[jsbsim::kEast] * geo::kMetresPerFoot,
                        values[jsbsim::kDown] * geo::kMetresPerFoot};
  auto sample = checked_sample("jsbsim", reading);
  if (!sample) return tl::unexpected(sample.error());
  return JsbsimState{geo::Duration::seconds(values[jsbsim::kTime]), *sample};
}

void JsbsimBridge::keep(const JsbsimColumns& columns) {
  std::erase_if(labels_, [this](const Labels& labels) { return labels.sender == sender_; });
  // At the limit the oldest labels are dropped, but never those of the sender that flies the aircraft.
  const auto flies = [this](const Labels& labels) { return labels.sender == flying_sender_; };
  if (labels_.size() >= kMaxSenders) labels_.erase(std::ranges::find_if_not(labels_, flies));
  labels_.push_back({sender_, columns});
}

const JsbsimColumns* JsbsimBridge::columns() const {
  const auto found = std::ranges::find(labels_, sender_, &Labels::sender);
  if (found != labels_.end()) return &found->columns;
  return columns_ ? &*columns_ : nullptr;
}

error::Expected<std::optional<ExternalSample>> JsbsimBridge::receive(memory::Bytes datagram, geo::Duration) {
  if (datagram.size() > kMaxJsbsimLine)
    return error::fail("jsbsim", "a line of at most " + std::to_string(kMaxJsbsimLine) + " characters",
                       std::to_string(datagram.size()));
  const std::string_view line = text::trimmed({reinterpret_cast<const char*>(datagram.data()), datagram.size()});
  if (line.starts_with(kLabels)) {
    auto columns = parse_jsbsim_labels(line);
    if (!columns) return tl::unexpected(columns.error());
    keep(*columns);
    return std::nullopt;
  }
  const JsbsimColumns* const columns = this->columns();
  if (columns == nullptr)
    return error::fail("jsbsim", "a line of labels first", "a line of numbers",
                       "start flight-model before JSBSim, which sends its labels once, or name them: "
                       "jsbsim:PORT,Time,lat-geod-deg,...");
  const auto state = parse_jsbsim_line(*columns, line);
  if (!state) return tl::unexpected(state.error());
  if (const auto reason = order_.order_fault(state->time)) return error::fail("jsbsim", "a newer line", *reason);
  flying_sender_ = sender_;
  return state->sample;
}

namespace {

constexpr std::size_t kRequestBytes = 413;
constexpr std::size_t kHeadBytes = 5;  // "RREF" and one byte that is not evaluated
constexpr std::size_t kPairBytes = 8;
constexpr std::string_view kMark = "RREF";
constexpr std::uint32_t kAllReceived = (1U << kXplaneDatarefs) - 1U;
// Minimum time without a reply before requests are repeated.
constexpr geo::Duration kRequestInterval = geo::Duration::seconds(1.0);

namespace xplane {
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
}  // namespace xplane

// Velocity east, north, up at the aircraft, from X-Plane's axes (x east, y up, z south at the reference point).
geo::Vector3 enu_velocity(const std::array<float, kXplaneDatarefs>& values) {
  const auto frame_at = [](double latitude_deg, double longitude_deg) {
    return geo::LocalTangentFrame({latitude_deg, longitude_deg}, geo::HeightAboveEllipsoid());
  };
  const geo::Vector3 at_reference{values[xplane::kVx], -static_cast<double>(values[xplane::kVz]), values[xplane::kVy]};
  const geo::Vector3 ecef =
      frame_at(values[xplane::kRefLatitude], values[xplane::kRefLongitude]).ecef_from_enu_direction(at_reference);
  return frame_at(values[xplane::kLatitude], values[xplane::kLongitude]).enu_from_ecef_direction(ecef);
}

error::Expected<ExternalSample> sample_of(const std::array<float, kXplaneDatarefs>& values) {
  // LocalTangentFrame in enu_velocity() requires valid coordinates.
  for (const std::size_t latitude : {xplane::kLatitude, xplane::kRefLatitude})
    if (!(std::abs(values[latitude]) <= 90.0F))
      return error::fail("xplane", std::string(kXplaneNames[latitude]) + " in [-90, 90]",
                         text::text_of_number(values[latitude]));
  for (const std::size_t longitude : {xplane::kLongitude, xplane::kRefLongitude})
    if (!(std::abs(values[longitude]) <= 180.0F))
      return error::fail("xplane", std::string(kXplaneNames[longitude]) + " in [-180, 180]",
                         text::text_of_number(values[longitude]));
  const geo::Vector3 velocity = enu_velocity(values);
  const Reading reading{values[xplane::kLatitude],
                        values[xplane::kLongitude],
                        values[xplane::kElevation],
                        values[xplane::kHeading],
                        values[xplane::kPitch],
                        values[xplane::kRoll],
                        velocity.y,
                        velocity.x,
                        -velocity.z};
  return checked_sample("xplane", reading,
                        rates_from_body(values[xplane::kRollRate], values[xplane::kPitchRate], values[xplane::kYawRate],
                                        values[xplane::kPitch], values[xplane::kRoll]));
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
    std::ranges::copy(memory::bytes_of(word, std::endian::little),
                      request.begin() + static_cast<std::ptrdiff_t>(offset));
  };
  std::memcpy(request.data(), kMark.data(), kMark.size());
  put(kHeadBytes, static_cast<std::uint32_t>(times_a_second));
  put(kHeadBytes + 4, static_cast<std::uint32_t>(number));
  std::memcpy(request.data() + kHeadBytes + 8, kXplaneNames[number].data(), kXplaneNames[number].size());
  return request;
}

error::Expected<std::optional<ExternalSample>> XplaneBridge::receive(memory::Bytes datagram, geo::Duration now) {
  const bool marked = datagram.size() >= kHeadBytes && std::memcmp(datagram.data(), kMark.data(), kMark.size()) == 0;
  if (!marked || (datagram.size() - kHeadBytes) % kPairBytes != 0)
    return error::fail("xplane", "RREF, a byte, and pairs of 8 bytes", text::counted(datagram.size(), "byte"));
  for (std::size_t offset = kHeadBytes; offset < datagram.size(); offset += kPairBytes) {
    const auto number = memory::little_endian<std::uint32_t>(datagram, offset);
    if (number >= kXplaneDatarefs) continue;
    const auto value = memory::little_endian<float>(datagram, offset + 4);
    if (!std::isfinite(value))
      return error::fail("xplane", std::string(kXplaneNames[number]) + ", a number", text::text_of_number(value));
    values_[number] = value;
    received_mask_ |= 1U << number;
    last_reply_ = now;
  }
  if (received_mask_ != kAllReceived) return std::nullopt;
  received_mask_ = 0;
  const auto sample = sample_of(values_);
  if (!sample) return tl::unexpected(sample.error());
  return *sample;
}

std::vector<Datagram> XplaneBridge::requests(geo::Duration now) {
  const auto over = [now](const std::optional<geo::Duration>& then) {
    return !then || now - *then >= kRequestInterval;
  };
  if (!over(last_request_) || !over(last_reply_)) return {};
  last_request_ = now;
  std::vector<Datagram> all;
  for (std::size_t number = 0; number < kXplaneDatarefs; ++number)
    all.push_back(xplane_request(number, kXplaneRate_hz));
  return all;
}

std::vector<Datagram> XplaneBridge::closing_datagrams() const {
  std::vector<Datagram> all;
  for (std::size_t number = 0; number < kXplaneDatarefs; ++number) all.push_back(xplane_request(number, 0));
  return all;
}

}  // namespace yars::flightmodel::bridges
