// Lines of a script: their times, and the last line `end`. Scripts and tours share this syntax.
// Input: text of a file; `#` begins a comment.
// Output: each line with its time, in order; the time of `end`.
// Units: [ns] of sim time.
// Errors: file name and line, what was expected, what was found.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lib/error/error.hpp"

namespace yars::inputmonitor {

// One line without its time.
struct ScriptLine {
  std::int64_t time_ns = 0;
  std::string_view what;  // the words after the time
  std::string location;   // file name and line number, for errors
};

struct ScriptTimes {
  std::optional<std::int64_t> end_ns;  // time of `end`; nullopt: there is no such line
  bool from_start = false;             // true: times count from the start of the script; false: simulation times
};

// Line:  TIME_S WHAT | +DT_S WHAT | [TIME_S] end
//   TIME_S     simulation time [s], not before the time of the line above
//   +DT_S      interval after the time of the line above [s]. If the first line has this form, all times count from the
//              moment when the script starts.
//   end        end of the script, by default at the time of the line above; must be the last line
// A line that begins with a word of `timeless` has the time of the line above. `forms`: valid lines, for errors.
// `take` gets each line except `end`; its error ends the reading.
error::Expected<ScriptTimes> read_script_lines(std::string_view text, std::string_view name, std::string_view forms,
                                               std::span<const std::string_view> timeless,
                                               const std::function<error::Expected<void>(const ScriptLine&)>& take);

}  // namespace yars::inputmonitor
