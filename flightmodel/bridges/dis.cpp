#include "flightmodel/bridges/dis.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "databuffer/messages/validation.hpp"
#include "flightmodel/bridges/external_flight.hpp"
#include "lib/geo/frames.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::flightmodel::bridges {

namespace {

using geo::Vector3;

// Offsets of the fields [bytes].
constexpr std::size_t kVersion = 0, kExercise = 1, kType = 2, kStamp = 4, kLength = 8;
constexpr std::size_t kSite = 12, kApplication = 14, kEntity = 16, kParameters = 19, kKind = 20, kDomain = 21;
constexpr std::size_t kVelocity = 36, kLocation = 48, kOrientation = 72, kAppearance = 84, kAlgorithm = 88;
constexpr std::size_t kAcceleration = 104, kBodyRates = 116;
constexpr std::size_t kHeaderBytes = 12, kStateBytes = 144, kParameterBytes = 16;

constexpr std::uint8_t kEntityStateType = 1;
constexpr std::uint8_t kOldestVersion = 5, kNewestVersion = 7;  // 1278.1-1995 to 1278.1-2012
constexpr std::uint32_t kFrozenBit = 1U << 21U, kDeactivatedBit = 1U << 23U;
// [s] Unit of a time stamp: 2^31 units are one hour. Bit 0, which marks an absolute clock, is not part of the number.
constexpr double kStampUnit_s = 3600.0 / 2147483648.0;

// [m] Bounds of an entity's distance from the Earth's centre. No aircraft flies outside these bounds. Near the centre
// the conversion to latitude is ill-conditioned.
constexpr double kMinRadius_m = 6'000'000.0, kMaxRadius_m = 7'000'000.0;

struct Algorithm {
  bool body_axes, rotates, accelerates;
  bool turns() const { return body_axes && rotates; }  // true: velocity and acceleration turn with the body
};

// Properties of the standard's dead reckoning algorithms 1 to 9 (IEEE 1278.1-2012 annex E): static, FPW, RPW, RVW, FVW,
// FPB, RPB, RVB, FVB. First letter: R rotates, F does not. Second letter: V accelerates, P does not. Third letter:
// velocity and acceleration are in body axes (B) or in ECEF axes (W).
Algorithm algorithm_of(std::uint8_t number) {
  return {number >= 6 && number <= 9, number == 3 || number == 4 || number == 7 || number == 8,
          number == 4 || number == 5 || number == 8 || number == 9};
}

Vector3 floats_at(memory::Bytes packet, std::size_t offset) {
  return {memory::big_endian<float>(packet, offset), memory::big_endian<float>(packet, offset + 4),
          memory::big_endian<float>(packet, offset + 8)};
}

// Body axes (forward, right, down) in ECEF axes.
struct BodyAxes {
  Vector3 forward, right, down;
};

BodyAxes axes_of(Vector3 orientation) {
  const double sin_psi = std::sin(orientation.x), cos_psi = std::cos(orientation.x);
  const double sin_theta = std::sin(orientation.y), cos_theta = std::cos(orientation.y);
  const double sin_phi = std::sin(orientation.z), cos_phi = std::cos(orientation.z);
  return {{cos_theta * cos_psi, cos_theta * sin_psi, -sin_theta},
          {sin_phi * sin_theta * cos_psi - cos_phi * sin_psi, sin_phi * sin_theta * sin_psi + cos_phi * cos_psi,
           sin_phi * cos_theta},
          {cos_phi * sin_theta * cos_psi + sin_phi * sin_psi, cos_phi * sin_theta * sin_psi - sin_phi * cos_psi,
           cos_phi * cos_theta}};
}

bool is_finite(Vector3 vector) {
  return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}

std::optional<error::Error> fault_of(memory::Bytes packet) {
  const auto error = [](std::string expected, std::string found) {
    return error::Error{"dis", std::move(expected), std::move(found), {}};
  };
  if (packet.size() < kStateBytes)
    return error("an Entity State PDU of at least 144 bytes", text::counted(packet.size(), "byte"));
  const auto version = memory::big_endian<std::uint8_t>(packet, kVersion);
  if (version < kOldestVersion || version > kNewestVersion)
    return error("protocol version 5, 6 or 7", std::to_string(version));
  const auto type = memory::big_endian<std::uint8_t>(packet, kType);
  if (type != kEntityStateType) return error("PDU type 1, entity state", std::to_string(type));
  const std::size_t bytes = kStateBytes + kParameterBytes * memory::big_endian<std::uint8_t>(packet, kParameters);
  if (packet.size() != bytes || memory::big_endian<std::uint16_t>(packet, kLength) != bytes)
    return error("a PDU of " + std::to_string(bytes) + " bytes, which its number of articulation parameters gives",
                 std::to_string(memory::big_endian<std::uint16_t>(packet, kLength)) + " stated, " +
                     std::to_string(packet.size()) + " received");
  return std::nullopt;
}

struct Motion {
  Vector3 location, velocity, orientation;
};

error::Expected<Motion> motion_of(memory::Bytes packet) {
  const Motion motion{{memory::big_endian<double>(packet, kLocation), memory::big_endian<double>(packet, kLocation + 8),
                       memory::big_endian<double>(packet, kLocation + 16)},
                      floats_at(packet, kVelocity),
                      floats_at(packet, kOrientation)};
  if (!is_finite(motion.location) || !is_finite(motion.velocity) || !is_finite(motion.orientation))
    return error::fail("dis", "numbers for location, velocity and orientation", "a value that is not finite");
  const double from_centre_m = glm::length(motion.location);
  if (!(from_centre_m >= kMinRadius_m && from_centre_m <= kMaxRadius_m))
    return error::fail("dis", "a location 6000 to 7000 km from the Earth's centre",
                       std::to_string(from_centre_m / 1000.0) + " km");
  return motion;
}

struct LocalAttitude {
  double heading_deg, pitch_deg, roll_deg;
};

LocalAttitude attitude_in(const geo::LocalTangentFrame& local, const BodyAxes& axes) {
  const Vector3 forward = local.enu_from_ecef_direction(axes.forward);
  const double right_up = local.enu_from_ecef_direction(axes.right).z;
  const double down_up = local.enu_from_ecef_direction(axes.down).z;
  return {std::atan2(forward.x, forward.y) / geo::kRadiansPerDegree,
          std::atan2(forward.z, std::hypot(forward.x, forward.y)) / geo::kRadiansPerDegree,
          std::atan2(-right_up, -down_up) / geo::kRadiansPerDegree};
}

error::Expected<ExternalSample> sample_of(memory::Bytes packet, const Motion& motion, const geo::Geoid& geoid) {
  const auto position = geo::geodetic_from_ecef(motion.location);
  const geo::LocalTangentFrame local(position.point, position.height);
  const BodyAxes axes = axes_of(motion.orientation);
  const LocalAttitude attitude = attitude_in(local, axes);
  const Algorithm algorithm = algorithm_of(memory::big_endian<std::uint8_t>(packet, kAlgorithm));
  const auto ned_from_body = [&](Vector3 body) {
    const Vector3 enu = local.enu_from_ecef_direction(body.x * axes.forward + body.y * axes.right + body.z * axes.down);
    return Vector3{enu.y, enu.x, -enu.z};
  };
  const auto ned_from_reported = [&](Vector3 reported) {
    if (algorithm.body_axes) return ned_from_body(reported);
    const Vector3 enu = local.enu_from_ecef_direction(reported);
    return Vector3{enu.y, enu.x, -enu.z};
  };
  const Vector3 velocity = ned_from_reported(motion.velocity);
  const Reading reading{position.point.latitude_deg,
                        position.point.longitude_deg,
                        geoid.altitude(position.point, position.height).metres(),
                        attitude.heading_deg,
                        attitude.pitch_deg,
                        attitude.roll_deg,
                        velocity.x,
                        velocity.y,
                        velocity.z};
  // Rates that the algorithm does not use are zero. Without a value ExternalFlight would estimate them from reports.
  AttitudeRates rates;
  if (algorithm.rotates) {
    const Vector3 body = (1.0 / geo::kRadiansPerDegree) * floats_at(packet, kBodyRates);
    for (const double rate_dps : {body.x, body.y, body.z})
      if (!(std::abs(rate_dps) <= kMaxAttitudeRate_dps))
        return error::fail("dis", "body rates of at most " + text::text_of_number(kMaxAttitudeRate_dps) + " deg/s",
                           text::text_of_number(rate_dps));
    rates = rates_from_body(body.x, body.y, body.z, attitude.pitch_deg, attitude.roll_deg).value_or(AttitudeRates{});
  }
  Vector3 acceleration;
  if (algorithm.accelerates) acceleration = ned_from_reported(floats_at(packet, kAcceleration));
  const std::string source = "dis/" + (geoid.has_data() ? geoid.name() : std::string("ellipsoid"));
  auto sample = checked_sample(source, reading, rates, acceleration);
  if (sample && algorithm.turns()) sample->turn_radps = ned_from_body(floats_at(packet, kBodyRates));
  return sample;
}

}  // namespace

std::string text_of(EntityId id) {
  return std::to_string(id.site) + ',' + std::to_string(id.application) + ',' + std::to_string(id.entity);
}

bool is_other_pdu(memory::Bytes packet) {
  if (packet.size() < kHeaderBytes) return false;
  const auto version = memory::big_endian<std::uint8_t>(packet, kVersion);
  return version >= kOldestVersion && version <= kNewestVersion &&
         memory::big_endian<std::uint8_t>(packet, kType) != kEntityStateType &&
         memory::big_endian<std::uint16_t>(packet, kLength) == packet.size();
}

std::vector<memory::Bytes> pdus_of(memory::Bytes datagram) {
  std::vector<memory::Bytes> pdus;
  while (datagram.size() >= kHeaderBytes) {
    const std::size_t length = memory::big_endian<std::uint16_t>(datagram, kLength);
    if (length < kHeaderBytes || length > datagram.size()) break;
    pdus.push_back(datagram.first(length));
    datagram = datagram.subspan(length);
  }
  constexpr std::size_t kAlignment = 8;  // [bytes] to which senders of bundles may pad
  const bool is_padding = datagram.size() < kAlignment &&
                          std::ranges::all_of(datagram, [](std::byte byte) { return byte == std::byte{0}; });
  if (pdus.empty() || !is_padding) pdus.push_back(datagram);
  return pdus;
}

error::Expected<EntityState> decode_entity_state(memory::Bytes packet, const geo::Geoid& geoid) {
  if (auto fault = fault_of(packet)) return tl::unexpected(std::move(*fault));
  const auto motion = motion_of(packet);
  if (!motion) return tl::unexpected(motion.error());
  auto sample = sample_of(packet, *motion, geoid);
  if (!sample) return tl::unexpected(sample.error());
  EntityState state;
  state.exercise = memory::big_endian<std::uint8_t>(packet, kExercise);
  state.id = {memory::big_endian<std::uint16_t>(packet, kSite), memory::big_endian<std::uint16_t>(packet, kApplication),
              memory::big_endian<std::uint16_t>(packet, kEntity)};
  state.kind = static_cast<EntityKind>(memory::big_endian<std::uint8_t>(packet, kKind));
  state.domain = static_cast<EntityDomain>(memory::big_endian<std::uint8_t>(packet, kDomain));
  if (const auto stamp = memory::big_endian<std::uint32_t>(packet, kStamp) >> 1U; stamp != 0)
    state.stamp = geo::Duration::seconds(static_cast<double>(stamp) * kStampUnit_s);
  const auto appearance = memory::big_endian<std::uint32_t>(packet, kAppearance);
  state.frozen = (appearance & kFrozenBit) != 0U;
  state.deactivated = (appearance & kDeactivatedBit) != 0U;
  state.sample = *std::move(sample);
  return state;
}

void EntityTable::forget_silent(geo::Duration now) {
  std::erase_if(entries_, [now](const auto& entry) { return now - entry.second.received > kEntityTimeout; });
}

std::optional<std::string> EntityTable::update(const EntityState& state, geo::Duration now) {
  auto found = entries_.find(state.id);
  if (found != entries_.end() && now - found->second.received > kEntityTimeout) {
    entries_.erase(found);
    found = entries_.end();
  }
  if (found == entries_.end()) {
    if (state.deactivated) return std::nullopt;
    if (entries_.size() >= kMaxEntities) forget_silent(now);
    if (entries_.size() >= kMaxEntities) return "more than " + std::to_string(kMaxEntities) + " entities";
    found = entries_.try_emplace(state.id).first;
  }
  Entry& entry = found->second;
  if (const auto reason = state.stamp ? entry.order.order_fault(*state.stamp) : std::nullopt)
    return "no newer report of entity " + text_of(state.id) + ": " + *reason;
  if (state.deactivated) {
    entries_.erase(found);
    return std::nullopt;
  }
  entry.state = state;
  entry.received = now;
  return std::nullopt;
}

std::vector<TrackedEntity> EntityTable::at(geo::Duration now) const {
  std::vector<TrackedEntity> all;
  for (const auto& [id, entry] : entries_) {
    const geo::Duration age = std::max(now - entry.received, geo::Duration());
    if (age > kEntityTimeout) continue;
    databuffer::Ownship state = dead_reckoned(entry.state.sample, entry.state.frozen ? geo::Duration() : age);
    if (entry.state.frozen) state.velocity_north_mps = state.velocity_east_mps = state.velocity_down_mps = 0.0;
    // An extrapolation can leave the range of the record. Such an entity is omitted.
    if (databuffer::validate(state)) continue;
    all.push_back({id, entry.state.kind, entry.state.domain, state, age});
  }
  return all;
}

namespace {

// Combines the three numbers of a DIS id into the 32-bit id of the record. Different DIS ids can give one 32-bit id.
std::uint32_t number_of(EntityId id) {
  const std::uint32_t sender = (static_cast<std::uint32_t>(id.site) << 8U) ^ id.application;
  return sender << 16U | id.entity;
}

databuffer::TrafficEntity target_of(const TrackedEntity& entity) {
  const bool ship = entity.domain == EntityDomain::surface;
  const databuffer::Ownship& state = entity.state;
  return {state.latitude_deg,
          state.longitude_deg,
          state.velocity_north_mps,
          state.velocity_east_mps,
          ship ? kShipHeight_m : kVehicleHeight_m,
          ship ? kShipCrossSection_m2 : kVehicleCrossSection_m2,
          number_of(entity.id),
          0};
}

}  // namespace

databuffer::Traffic surface_traffic(std::span<const TrackedEntity> entities, geo::GeoPoint near) {
  struct Target {
    double distance_m;
    const TrackedEntity* entity;
  };
  std::vector<Target> targets;
  for (const TrackedEntity& entity : entities) {
    const bool on_ground = entity.domain == EntityDomain::land || entity.domain == EntityDomain::surface;
    if (entity.kind != EntityKind::platform || !on_ground) continue;
    const geo::GeoPoint position{entity.state.latitude_deg, entity.state.longitude_deg};
    targets.push_back({geo::geodesic_inverse(near, position).distance.metres(), &entity});
  }
  if (targets.size() > databuffer::kMaxTraffic) {
    std::ranges::stable_sort(targets, {}, &Target::distance_m);
    targets.resize(databuffer::kMaxTraffic);
  }
  databuffer::Traffic traffic{};
  traffic.count = static_cast<std::uint32_t>(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) traffic.entities[i] = target_of(*targets[i].entity);
  return traffic;
}

}  // namespace yars::flightmodel::bridges
