#include "databuffer/bridges/surface_traffic.hpp"

#include <algorithm>
#include <vector>

namespace yars::databuffer::bridges {

namespace {

// The record has one number for what DIS says in three; sites that count alike may share one.
std::uint32_t number_of(EntityId id) {
  const std::uint32_t sender = (static_cast<std::uint32_t>(id.site) << 8U) ^ id.application;
  return sender << 16U | id.entity;
}

TrafficEntity target_of(const TrackedEntity& entity) {
  const bool ship = entity.domain == EntityDomain::surface;
  const Ownship& place = entity.place;
  return {place.latitude_deg,
          place.longitude_deg,
          place.velocity_north_mps,
          place.velocity_east_mps,
          ship ? kShipHeight_m : kVehicleHeight_m,
          ship ? kShipEcho_m2 : kVehicleEcho_m2,
          number_of(entity.id),
          0};
}

}  // namespace

Traffic surface_traffic(std::span<const TrackedEntity> entities, geo::GeoPoint near) {
  struct Target {
    double distance_m;
    const TrackedEntity* entity;
  };
  std::vector<Target> targets;
  for (const TrackedEntity& entity : entities) {
    const bool on_ground = entity.domain == EntityDomain::land || entity.domain == EntityDomain::surface;
    if (entity.kind != EntityKind::platform || !on_ground) continue;
    const geo::GeoPoint place{entity.place.latitude_deg, entity.place.longitude_deg};
    targets.push_back({geo::geodesic_inverse(near, place).distance.metres(), &entity});
  }
  if (targets.size() > kMostTraffic) {
    std::ranges::stable_sort(targets, {}, &Target::distance_m);
    targets.resize(kMostTraffic);
  }
  Traffic traffic{};
  traffic.count = static_cast<std::uint32_t>(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) traffic.entities[i] = target_of(*targets[i].entity);
  return traffic;
}

}  // namespace yars::databuffer::bridges
