// Entity State PDUs (protocol data units) of a DIS exercise (Distributed Interactive Simulation): decoder, table of
// entities, and surface traffic.
// Inputs: datagrams of IEEE 1278.1 (1995, 1998, 2012), big-endian, of one PDU or several behind each other; 144 bytes,
// and 16 bytes for each articulation parameter.
// Outputs: position, attitude and velocity by entity, dead reckoned (extrapolated); a Traffic record.
// Frame: location is ECEF (Earth-centred, Earth-fixed) [m]. Orientation is three successive turns from the ECEF to the
// body axes: psi about z, theta about y, phi about x [rad]. Velocity [m/s] is in ECEF axes, or in body axes for dead
// reckoning algorithms 6 to 9.
// Accuracy: a location has a height above the ellipsoid. With the grid of a geoid it becomes an altitude above mean sea
// level; without one it is taken as such, -107 m to +86 m off (docs/conventions.md).
// Errors: a malformed PDU, or a value out of range, is refused with a reason.
// Source: docs/spec/formats.md#dis.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "databuffer/messages/world_state.hpp"
#include "flightmodel/bridges/external_flight.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/memory/byte_order.hpp"

namespace yars::flightmodel::bridges {

// Identifier of an entity, unique within an exercise.
struct EntityId {
  std::uint16_t site = 0, application = 0, entity = 0;
  // NOLINTNEXTLINE(modernize-use-nullptr): false positive on a defaulted operator
  friend auto operator<=>(const EntityId&, const EntityId&) = default;
};
std::string text_of(EntityId id);  // "SITE,APP,ENTITY"

enum class EntityKind : std::uint8_t { other = 0, platform = 1 };  // as in the PDU; other values are stored unchanged
enum class EntityDomain : std::uint8_t { other = 0, land = 1, air = 2, surface = 3, subsurface = 4, space = 5 };

// Time stamps of DIS wrap each hour.
inline constexpr geo::Duration kDisStampPeriod = geo::Duration::seconds(3600.0);

struct EntityState {
  std::uint8_t exercise = 0;
  EntityId id;
  EntityKind kind = EntityKind::other;
  EntityDomain domain = EntityDomain::other;
  // [0, kDisStampPeriod): time past the hour, or since the sender's start; nullopt: the sender states none (0), and the
  // order of arrival counts.
  std::optional<geo::Duration> stamp;
  bool frozen = false;       // the entity does not move until a PDU without this flag
  bool deactivated = false;  // the entity has left the exercise
  ExternalSample sample;     // rates and acceleration are zero unless the dead reckoning algorithm uses them
};

// The PDUs of a datagram by their length fields. What is left at its end and is no PDU is the last element, which no
// decoder accepts; fewer than 8 zero bytes are padding.
std::vector<memory::Bytes> pdus_of(memory::Bytes datagram);

// Decodes one PDU. The length field must equal the length of the packet. The source of the sample is "dis/" and the
// name of the geoid, or "dis/ellipsoid" without its data.
error::Expected<EntityState> decode_entity_state(memory::Bytes packet, const geo::Geoid& geoid);

// True for a well-formed PDU of a type other than Entity State, which is ignored without a refusal.
bool is_other_pdu(memory::Bytes packet);

// Silence after which an entity counts as gone: the standard's heartbeat of 5 s times its time-out factor of 2.4.
inline constexpr geo::Duration kEntityTimeout = geo::Duration::seconds(12.0);
// Capacity of EntityTable. Without this limit a flood of ids would use all memory.
inline constexpr std::size_t kMaxEntities = 1'000;

// One entity, dead reckoned to the requested time.
struct TrackedEntity {
  EntityId id;
  EntityKind kind = EntityKind::other;
  EntityDomain domain = EntityDomain::other;
  databuffer::Ownship state{};  // latitude, longitude, altitude, attitude, velocity
  geo::Duration age;            // time since the last report
};

// Last report of each entity of a DIS exercise, by id. A report is dead reckoned until kEntityTimeout after its
// arrival. `now` is the time of any clock that does not go back. A new entity is refused when the table holds
// kMaxEntities that have reported within kEntityTimeout. A report that is not newer than the last report of its entity
// is refused (StampOrder).
class EntityTable {
 public:
  // Stores the report; if `deactivated`, removes the entity instead. Returns the reason if the report is refused, else
  // nullopt.
  std::optional<std::string> update(const EntityState& state, geo::Duration now);
  // Entities that have reported within kEntityTimeout, by ascending id. An entity whose extrapolation leaves the ranges
  // of Ownship is omitted.
  std::vector<TrackedEntity> at(geo::Duration now) const;
  void forget(EntityId id) { entries_.erase(id); }

 private:
  struct Entry {
    EntityState state;
    geo::Duration received;
    StampOrder order{kDisStampPeriod};
  };
  void forget_silent(geo::Duration now);

  std::map<EntityId, Entry> entries_;
};

// Radar cross section and height of a lorry and of a freighter at X band.
// Source: Skolnik, Introduction to Radar Systems, table of cross sections. For a ship sigma = 52 f^(1/2) D^(3/2), with
// frequency f = 10,000 MHz and displacement D = 2 kilotons.
inline constexpr double kVehicleCrossSection_m2 = 200.0, kVehicleHeight_m = 3.0;
inline constexpr double kShipCrossSection_m2 = 15'000.0, kShipHeight_m = 15.0;

// Surface traffic of an exercise: its platforms on land and on the sea. PDUs contain no cross section; the constants
// above are used. `near`: position of the aircraft. If there are more than kMaxTraffic such platforms, the farthest
// from the aircraft are left out. The caller sets epoch and source_time_ns.
databuffer::Traffic surface_traffic(std::span<const TrackedEntity> entities, geo::GeoPoint near);

}  // namespace yars::flightmodel::bridges
