#include "inputmonitor/script.hpp"

#include <cmath>
#include <string>

#include "databuffer/records/clock_state.hpp"
#include "databuffer/records/event_text.hpp"
#include "databuffer/records/plain_text.hpp"

namespace yars::inputmonitor {

namespace {

using failure::Expected;
using failure::fail;

// The time that a word means, or nothing when it means none.
std::optional<std::int64_t> time_of(std::string_view word, std::int64_t previous_ns) {
  const auto seconds = databuffer::finite_number(word);
  if (!seconds || *seconds < 0.0 || *seconds > databuffer::kLatestSimTime_s) return std::nullopt;
  const std::int64_t time_ns = std::llround(*seconds * 1e9);
  return word.starts_with('+') ? previous_ns + time_ns : time_ns;
}

}  // namespace

Expected<Script> parse_script(std::string_view text, std::string_view name) {
  Script script;
  std::int64_t previous_ns = 0;
  for (const auto& line : databuffer::numbered_lines(text)) {
    const std::string place = std::string(name) + ':' + std::to_string(line.number);
    const std::string found = '"' + std::string(line.text) + '"';
    if (script.end_ns) return fail(place, "nothing behind end", found);
    if (line.text == "end") {
      script.end_ns = previous_ns;
      continue;
    }
    const std::string_view word = databuffer::words_of(line.text).front();
    const auto time_ns = time_of(word, previous_ns);
    if (!time_ns) return fail(place, "TIME_S EVENT, +DT_S EVENT or end", found);
    if (*time_ns < previous_ns)
      return fail(place, "a time not before that of the line above", found,
                  "put the lines in the order of their times");
    if (script.events.empty()) script.from_start = word.starts_with('+');
    previous_ns = *time_ns;
    const std::string_view rest = databuffer::trimmed(line.text.substr(word.size()));
    if (rest == "end") {
      script.end_ns = previous_ns;
      continue;
    }
    const auto event = databuffer::event_from_text(rest);
    if (!event) return fail(place, event.error().expected, event.error().found);
    script.events.push_back({previous_ns, *event});
  }
  return script;
}

}  // namespace yars::inputmonitor
