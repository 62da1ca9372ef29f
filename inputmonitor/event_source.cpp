#include "inputmonitor/event_source.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/world_state.hpp"
#include "lib/file/text_file.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::inputmonitor {

namespace {

using error::Expected;
using error::fail;

// Time [ns] of a word such as "12.5", or "+0.5" relative to `previous_ns`; nullopt if the word is not a valid time.
std::optional<std::int64_t> time_of(std::string_view word, std::int64_t previous_ns) {
  const auto seconds = text::finite_number(word);
  if (!seconds || *seconds < 0.0 || *seconds > databuffer::kLatestSimTime_s) return std::nullopt;
  const std::int64_t time_ns = std::llround(*seconds * 1e9);
  return word.starts_with('+') ? previous_ns + time_ns : time_ns;
}

}  // namespace

Expected<ScriptTimes> read_script_lines(std::string_view text, std::string_view name, std::string_view forms,
                                        std::span<const std::string_view> timeless,
                                        const std::function<Expected<void>(const ScriptLine&)>& take) {
  ScriptTimes times;
  std::int64_t previous_ns = 0;
  bool timed = false;
  for (const auto& line : text::numbered_lines(text)) {
    const std::string location = file::line_location(name, line.number);
    const std::string found = '"' + std::string(line.text) + '"';
    if (times.end_ns) return fail(location, "no line after end", found);
    const std::string_view word = text::words_of(line.text).front();
    std::string_view what = line.text;
    if (line.text != "end" && std::ranges::find(timeless, word) == timeless.end()) {
      const auto time_ns = time_of(word, previous_ns);
      if (!time_ns) return fail(location, std::string(forms), found);
      if (*time_ns < previous_ns)
        return fail(location, "a time not earlier than the time of the line above", found, "sort the lines by time");
      if (!timed) times.from_start = word.starts_with('+');
      timed = true;
      previous_ns = *time_ns;
      what = text::trimmed(line.text.substr(word.size()));
    }
    if (what == "end")
      times.end_ns = previous_ns;
    else if (auto taken = take({previous_ns, what, location}); !taken)
      return tl::unexpected(taken.error());
  }
  return times;
}

namespace {

using databuffer::InputEvent;

constexpr std::int64_t kNanosecondsPerMillisecond = 1'000'000;

}  // namespace

void EventSource::wait(const Moment& moment, int max_wait_ms) {
  if (const auto due_ns = deadline_ns()) {
    // Rounded up. Rounded down, the wait would end up to 1 ms early, and waits of 0 ms would follow until the deadline.
    const std::int64_t left_ms =
        (*due_ns - moment.monotonic_ns + kNanosecondsPerMillisecond - 1) / kNanosecondsPerMillisecond;
    max_wait_ms = static_cast<int>(std::clamp<std::int64_t>(left_ms, 0, max_wait_ms));
  }
  std::vector<pollfd> wanted;
  add_descriptors(wanted);
  poll(wanted.data(), wanted.size(), max_wait_ms);
}

void SourceGroup::wait(const Moment& moment, int max_wait_ms) {
  std::vector<pollfd> unused;
  const auto unpollable =
      std::ranges::find_if(sources_, [&](const auto& source) { return !source->add_descriptors(unused); });
  if (unpollable == sources_.end())
    EventSource::wait(moment, max_wait_ms);
  else
    (*unpollable)->wait(moment, std::min(max_wait_ms, kMaxOwnWait_ms));
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

std::vector<Notice> SourceGroup::notices() {
  std::vector<Notice> all;
  for (const auto& source : sources_)
    for (Notice& one : source->notices()) all.push_back(std::move(one));
  return all;
}

bool SourceGroup::has_captions() const {
  return std::ranges::any_of(sources_, [](const auto& source) { return source->has_captions(); });
}

const databuffer::Caption* SourceGroup::caption() const {
  for (const auto& source : sources_)
    if (const auto* caption = source->caption()) return caption;
  return nullptr;
}

void SourceGroup::observe(const std::vector<SeenEvent>& seen) {
  for (const auto& source : sources_) source->observe(seen);
}

std::string SourceGroup::description() const {
  std::string all;
  for (const auto& source : sources_) all += (all.empty() ? "" : "; ") + source->description();
  return all;
}

error::Expected<Script> parse_script(std::string_view text, std::string_view name) {
  Script script;
  const auto times = read_script_lines(
      text, name, "TIME_S EVENT, +DT_S EVENT or end", {}, [&](const ScriptLine& line) -> error::Expected<void> {
        const auto event = databuffer::event_from_text(line.what);
        if (!event)
          return error::fail(line.location, event.error().expected, event.error().found, event.error().action);
        script.events.push_back({line.time_ns, *event});
        return {};
      });
  if (!times) return tl::unexpected(times.error());
  script.end_ns = times->end_ns;
  script.from_start = times->from_start;
  return script;
}

ScriptSource::ScriptSource(Script script, std::string name) : script_(std::move(script)), name_(std::move(name)) {}

std::vector<InputEvent> ScriptSource::take(const Moment& moment) {
  const bool went_back = last_sim_time_ns_ && moment.sim_time_ns < *last_sim_time_ns_;
  if (script_.from_start && (went_back || !last_sim_time_ns_)) origin_ns_ = moment.sim_time_ns;
  last_sim_time_ns_ = moment.sim_time_ns;
  const std::int64_t time_ns = moment.sim_time_ns - origin_ns_;
  if (went_back) {
    const auto later = std::ranges::lower_bound(script_.events, time_ns, {}, &ScriptedEvent::time_ns);
    next_ = static_cast<std::size_t>(later - script_.events.begin());
  }
  std::vector<InputEvent> due;
  for (; next_ < script_.events.size() && script_.events[next_].time_ns <= time_ns; ++next_)
    due.push_back(script_.events[next_].event);
  ended_ = script_.end_ns && time_ns >= *script_.end_ns;
  return due;
}

std::string ScriptSource::description() const {
  return "script " + name_ + ", " + text::counted(script_.events.size(), "event");
}

}  // namespace yars::inputmonitor
