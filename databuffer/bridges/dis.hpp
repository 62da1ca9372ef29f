// Entities of a DIS exercise: their PDUs, the table of the last states, surface traffic.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "databuffer/bridges/external_flight.hpp"
#include "databuffer/messages/world_state.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/memory/byte_order.hpp"

namespace yars::databuffer::bridges {

// Entity State PDUs of DIS (IEEE 1278.1: 1995, 1998, 2012), big-endian, 144 + 16 n bytes, from any exercise. Location
// is earth-centred, orientation three turns (psi about z, theta about y, phi about x) from the earth's axes to the
// body's. The height above the ellipsoid is taken for the altitude above mean sea level, as the whole model takes the
// one for the other (docs/conventions.md): the undulation, -107 to +86 m, is not corrected. Velocity is of the earth's
// axes, or of the body's where the dead reckoning algorithm is one of the body's (6 to 9).
struct EntityId {
  std::uint16_t site = 0, application = 0, entity = 0;
  // NOLINTNEXTLINE(modernize-use-nullptr): the order is the compiler's
  friend auto operator<=>(const EntityId&, const EntityId&) = default;
};
std::string text_of(EntityId id);  // "SITE,APP,ENTITY"

enum class EntityKind : std::uint8_t { other = 0, platform = 1 };  // as in the PDU; others keep their number
enum class EntityDomain : std::uint8_t { other = 0, land = 1, air = 2, surface = 3, subsurface = 4, space = 5 };

inline constexpr geo::Duration kDisStampPeriod = geo::Duration::seconds(3600.0);

struct EntityState {
  EntityId id;
  EntityKind kind = EntityKind::other;
  EntityDomain domain = EntityDomain::other;
  geo::Duration stamp;       // past the hour, or since some start: [0, kDisStampPeriod)
  bool frozen = false;       // stands until told otherwise
  bool deactivated = false;  // it is gone
  ExternalSample sample;     // rates and acceleration where the algorithm uses them
};

// The length that the PDU tells of itself must be that of the datagram.
error::Expected<EntityState> decode_entity_state(memory::Bytes packet);

// Whether the datagram is a well-formed PDU of another type: nothing of ours, and no fault.
bool is_other_pdu(memory::Bytes packet);

// The standard's heartbeat of 5 s and its factor 2.4: whoever is silent longer has left.
inline constexpr geo::Duration kEntityTimeout = geo::Duration::seconds(12.0);
inline constexpr std::size_t kMaxEntities = 1'000;

// An entity at the moment asked for: records as of ownship, dead-reckoned.
struct TrackedEntity {
  EntityId id;
  EntityKind kind = EntityKind::other;
  EntityDomain domain = EntityDomain::other;
  Ownship place{};    // latitude, longitude, altitude, attitude, velocity
  geo::Duration age;  // since its last report
};

// The entities of a DIS exercise, for whoever wants them as targets: the last state of each, by id, flown on by dead
// reckoning and forgotten when nothing has come of it for a while. Pure; `now` is any clock that does not go back.
// Bounded: a newcomer to a full table is refused. Reports that are older than the last of the same entity are refused.
class EntityTable {
 public:
  // Nothing: taken. Else why not.
  std::optional<std::string> update(const EntityState& state, geo::Duration now);
  // All that have reported within kEntityTimeout, by ascending id.
  std::vector<TrackedEntity> at(geo::Duration now) const;
  void forget(EntityId id) { entries_.erase(id); }
  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    EntityState state;
    geo::Duration received;
    StampOrder order{kDisStampPeriod};
  };
  void forget_silent(geo::Duration now);

  std::map<EntityId, Entry> entries_;
};

// Echo of a lorry and of a freighter at X band (Skolnik, Introduction to Radar Systems, table of cross sections; a
// ship's 52 f^(1/2) D^(3/2) with f 10 GHz in MHz and D 2 kt), and the height of what returns.
inline constexpr double kVehicleEcho_m2 = 200.0, kVehicleHeight_m = 3.0;
inline constexpr double kShipEcho_m2 = 15'000.0, kShipHeight_m = 15.0;

// The record of surface traffic from the entities of an exercise: platforms on land and on the sea. What they return is
// not told by their packets and is taken by domain; more than fit are left out, the farthest first.
// `near`: the aircraft. Epoch and stamp are the caller's to fill.
Traffic surface_traffic(std::span<const TrackedEntity> entities, geo::GeoPoint near);

}  // namespace yars::databuffer::bridges
