#include "inputmonitor/source_group.hpp"

#include <algorithm>

namespace yars::inputmonitor {

using databuffer::InputEvent;

void SourceGroup::wait(const Moment& moment, int longest_ms) {
  std::vector<pollfd> unused;
  const auto deaf =
      std::ranges::find_if(sources_, [&](const auto& source) { return !source->add_descriptors(unused); });
  if (deaf == sources_.end())
    EventSource::wait(moment, longest_ms);
  else
    (*deaf)->wait(moment, std::min(longest_ms, kLongestDeaf_ms));
}

bool SourceGroup::add_descriptors(std::vector<pollfd>& wanted) const {
  bool all = true;
  for (const auto& source : sources_) all = source->add_descriptors(wanted) && all;
  return all;
}

std::optional<std::int64_t> SourceGroup::deadline_ns() const {
  std::optional<std::int64_t> first_ns;
  for (const auto& source : sources_)
    if (const auto due_ns = source->deadline_ns()) first_ns = std::min(first_ns.value_or(*due_ns), *due_ns);
  return first_ns;
}

std::vector<InputEvent> SourceGroup::take(const Moment& moment) {
  std::vector<InputEvent> events;
  for (const auto& source : sources_) {
    const auto more = source->take(moment);
    events.insert(events.end(), more.begin(), more.end());
  }
  return events;
}

std::vector<InputEvent> SourceGroup::release() {
  std::vector<InputEvent> events;
  for (const auto& source : sources_) {
    const auto more = source->release();
    events.insert(events.end(), more.begin(), more.end());
  }
  return events;
}

bool SourceGroup::ended() const {
  return std::ranges::any_of(sources_, [](const auto& source) { return source->ended(); });
}

bool SourceGroup::follows_sim_time() const {
  return std::ranges::any_of(sources_, [](const auto& source) { return source->follows_sim_time(); });
}

std::vector<News> SourceGroup::news() {
  std::vector<News> all;
  for (const auto& source : sources_)
    for (News& one : source->news()) all.push_back(std::move(one));
  return all;
}

std::string SourceGroup::description() const {
  std::string all;
  for (const auto& source : sources_) all += (all.empty() ? "" : "; ") + source->description();
  return all;
}

}  // namespace yars::inputmonitor
