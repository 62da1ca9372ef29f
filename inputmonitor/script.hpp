// Events written down with their sim times, one a line:
//   TIME_S EVENT     sim time in seconds, not before the line above
//   +DT_S EVENT      so long after the line above; on the first line after the script's start, and then all times of
//                    the script count from its start
//   [TIME_S] end     the input monitor ends there, or right after the line above; nothing follows
// `#` begins a comment. EVENT is written as in databuffer/records/event_text.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "databuffer/records/input_event.hpp"
#include "lib/failure/error.hpp"

namespace yars::inputmonitor {

struct ScriptedEvent {
  std::int64_t time_ns = 0;
  databuffer::InputEvent event{};
};

struct Script {
  std::vector<ScriptedEvent> events;   // times never descend
  std::optional<std::int64_t> end_ns;  // none: it stays when all is sent
  bool from_start = false;             // times count from the script's start; else they are sim times
};

// `name` is the file's, for errors: they carry the line.
failure::Expected<Script> parse_script(std::string_view text, std::string_view name);

}  // namespace yars::inputmonitor
