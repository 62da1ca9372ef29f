#include "databuffer/bridges/entity_table.hpp"

#include <algorithm>

#include "databuffer/bridges/dead_reckoning.hpp"
#include "databuffer/records/validation.hpp"

namespace yars::databuffer::bridges {

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
    if (entries_.size() >= kMostEntities) forget_silent(now);
    if (entries_.size() >= kMostEntities)
      return "expected at most " + std::to_string(kMostEntities) + " entities, found one more";
    found = entries_.try_emplace(state.id).first;
  }
  Entry& entry = found->second;
  if (const auto reason = entry.order.why_not_news(state.stamp))
    return "entity " + text_of(state.id) + ": expected a newer report, found " + *reason;
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
    Ownship place = dead_reckoned(entry.state.sample, entry.state.frozen ? geo::Duration() : age);
    if (entry.state.frozen) place.velocity_north_mps = place.velocity_east_mps = place.velocity_down_mps = 0.0;
    // One that its own acceleration has carried beyond what a record may hold says nothing any more.
    if (why_refused(place)) continue;
    all.push_back({id, entry.state.kind, entry.state.domain, place, age});
  }
  return all;
}

}  // namespace yars::databuffer::bridges
