#include "inputmonitor/script_lines.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace yars::inputmonitor
