#include "station/removed_entries.hpp"

#include <algorithm>
#include <string>

#include "databuffer/messages/inspection.hpp"

namespace yars::station {

namespace {

using databuffer::WorldState;

// Calls use(entry) for each entry of `before` whose id `after` lacks.
template <class Use, class Before, class After>
void for_each_missing(const Before& before, const After& after, const Use& use) {
  const auto id_of = [](const auto& entry) { return entry.id; };
  for (const auto& entry : before)
    if (std::ranges::find(after, entry.id, id_of) == after.end()) use(entry);
}

}  // namespace

void RemovedEntries::note(const WorldState& before, const WorldState& after) {
  const auto remember = [this](const auto& entry) {
    entries_.emplace_front(entry);
    if (entries_.size() > kMaxEntries) entries_.pop_back();
  };
  for_each_missing(databuffer::used(before.rain, before.rain_count), databuffer::used(after.rain, after.rain_count),
                   remember);
  for_each_missing(databuffer::used(before.jammers, before.jammer_count),
                   databuffer::used(after.jammers, after.jammer_count), remember);
  for_each_missing(databuffer::used(before.movers, before.mover_count),
                   databuffer::used(after.movers, after.mover_count), remember);
  for_each_missing(databuffer::used(before.points, before.point_count),
                   databuffer::used(after.points, after.point_count), remember);
}

error::Expected<void> RemovedEntries::restore(WorldState& world, world::WorldList list, std::uint32_t id) const {
  for (const Entry& entry : entries_) {
    if (entry.index() != static_cast<std::size_t>(list)) continue;
    if (std::visit([](const auto& removed) { return removed.id; }, entry) != id) continue;
    return std::visit([&world](const auto& removed) { return world::restore(world, removed); }, entry);
  }
  return error::fail("restore", "an entry that a page has removed", "id " + std::to_string(id), "add a new one");
}

}  // namespace yars::station
