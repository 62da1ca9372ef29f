// The entities of a DIS exercise, for whoever wants them as targets: the last state of each, by id, flown on by dead
// reckoning and forgotten when nothing has come of it for a while. Pure; `now` is any clock that does not go back.
// Bounded: a newcomer to a full table is refused. Reports that are older than the last of the same entity are refused.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "databuffer/bridges/dis.hpp"
#include "databuffer/bridges/stamp_order.hpp"

namespace yars::databuffer::bridges {

// The standard's heartbeat of 5 s and its factor 2.4: whoever is silent longer has left.
inline constexpr geo::Duration kEntityTimeout = geo::Duration::seconds(12.0);
inline constexpr std::size_t kMostEntities = 1'000;

// An entity at the moment asked for: records as of ownship, dead-reckoned.
struct TrackedEntity {
  EntityId id;
  EntityKind kind = EntityKind::other;
  EntityDomain domain = EntityDomain::other;
  Ownship place{};    // latitude, longitude, altitude, attitude, velocity
  geo::Duration age;  // since its last report
};

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

}  // namespace yars::databuffer::bridges
