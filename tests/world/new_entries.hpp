// New entries of a world by their types, for tests.
#pragma once

#include <string_view>
#include <variant>

#include "world/world_edit.hpp"

namespace yars::world {

template <class Entry>
error::Expected<Entry> new_entry(const databuffer::WorldState& world, geo::GeoPoint position,
                                 std::int64_t sim_time_ns = 0) {
  const auto entry = default_entry(world, databuffer::ListOf<Entry>::list, position, sim_time_ns);
  if (!entry) return tl::unexpected(entry.error());
  return std::get<Entry>(*entry);
}

inline databuffer::WorldRainCell new_rain_cell(geo::GeoPoint position) {
  return new_entry<databuffer::WorldRainCell>({}, position).value();
}
inline databuffer::WorldJammer new_jammer(geo::GeoPoint position) {
  return new_entry<databuffer::WorldJammer>({}, position).value();
}
inline databuffer::WorldMover new_mover(geo::GeoPoint position, std::int64_t sim_time_ns) {
  return new_entry<databuffer::WorldMover>({}, position, sim_time_ns).value();
}
inline error::Expected<databuffer::WorldPoint> new_point(const databuffer::WorldState& world, geo::GeoPoint position) {
  return new_entry<databuffer::WorldPoint>(world, position);
}

// set_name() of an entry whose type is known.
template <class Entry>
error::Expected<void> name_it(Entry& entry, std::string_view name) {
  WorldEntry named = entry;
  auto outcome = set_name(named, name);
  if (outcome) entry = std::get<Entry>(named);
  return outcome;
}

inline error::Expected<databuffer::WorldPoint> point_with(const databuffer::WorldState& world, std::uint32_t id) {
  const auto entry = entry_with(world, WorldList::points, id, 0);
  if (!entry) return tl::unexpected(entry.error());
  return std::get<databuffer::WorldPoint>(*entry);
}

}  // namespace yars::world
