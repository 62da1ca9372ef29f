// Entity State PDUs of DIS (IEEE 1278.1: 1995, 1998, 2012), big-endian, 144 + 16 n bytes, from any exercise. Location
// is earth-centred, orientation three turns (psi about z, theta about y, phi about x) from the earth's axes to the
// body's. The height above the ellipsoid is taken for the altitude above mean sea level, as the whole model takes the
// one for the other (docs/conventions.md): the undulation, -107 to +86 m, is not corrected. Velocity is of the earth's
// axes, or of the body's where the dead reckoning algorithm is one of the body's (6 to 9).
#pragma once

#include <array>
#include <compare>
#include <cstdint>

#include "databuffer/bridges/byte_order.hpp"
#include "databuffer/bridges/external_sample.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::databuffer::bridges {

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
failure::Expected<EntityState> decode_entity_state(Bytes packet);

// Whether the datagram is a well-formed PDU of another type: nothing of ours, and no fault.
bool is_other_pdu(Bytes packet);

}  // namespace yars::databuffer::bridges
