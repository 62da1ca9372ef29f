#include "station/removed_entries.hpp"

#include <algorithm>
#include <string>

namespace yars::station {

using databuffer::WorldState;

void RemovedEntries::note(const WorldState& before, const WorldState& after) {
  databuffer::for_each_list([&]<class Entry>(std::type_identity<Entry>) {
    const auto remaining = databuffer::ListOf<Entry>::entries_in_use(after);
    for (const Entry& entry : databuffer::ListOf<Entry>::entries_in_use(before)) {
      if (std::ranges::find(remaining, entry.id, &Entry::id) != remaining.end()) continue;
      entries_.emplace_front(entry);
      if (entries_.size() > kMaxEntries) entries_.pop_back();
    }
  });
}

error::Expected<void> RemovedEntries::restore(WorldState& world, world::WorldList list, std::uint32_t id) const {
  for (const world::WorldEntry& entry : entries_) {
    if (entry.index() != static_cast<std::size_t>(list)) continue;
    if (std::visit([](const auto& removed) { return removed.id; }, entry) != id) continue;
    return world::restore(world, entry);
  }
  return error::fail("restore", "an entry that a page has removed", "id " + std::to_string(id), "add a new one");
}

}  // namespace yars::station
