#include "inputmonitor/script_source.hpp"

#include <algorithm>
#include <utility>

namespace yars::inputmonitor {

ScriptSource::ScriptSource(Script script, std::string name) : script_(std::move(script)), name_(std::move(name)) {}

std::vector<databuffer::InputEvent> ScriptSource::take(const Moment& moment) {
  const bool went_back = last_sim_time_ns_ && moment.sim_time_ns < *last_sim_time_ns_;
  if (script_.from_start && (went_back || !last_sim_time_ns_)) origin_ns_ = moment.sim_time_ns;
  last_sim_time_ns_ = moment.sim_time_ns;
  const std::int64_t time_ns = moment.sim_time_ns - origin_ns_;
  if (went_back) {
    const auto later = std::ranges::lower_bound(script_.events, time_ns, {}, &ScriptedEvent::time_ns);
    next_ = static_cast<std::size_t>(later - script_.events.begin());
  }
  std::vector<databuffer::InputEvent> due;
  for (; next_ < script_.events.size() && script_.events[next_].time_ns <= time_ns; ++next_)
    due.push_back(script_.events[next_].event);
  ended_ = script_.end_ns && time_ns >= *script_.end_ns;
  return due;
}

std::string ScriptSource::description() const {
  return "script " + name_ + ", " + std::to_string(script_.events.size()) + " events";
}

}  // namespace yars::inputmonitor
