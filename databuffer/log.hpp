// The programs' log: lines on standard error, and in a file of the session's log folder when one is named. A thin face
// over spdlog, so that only one source pays for its headers.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace yars::databuffer {

inline constexpr std::size_t kLogFileBytes = std::size_t{4} << 20;  // [bytes] then the file is rotated
inline constexpr std::size_t kOldLogFiles = 3;                      // PROGRAM.1.log is the newest of them

// Level names: trace, debug, info, warning, error, off. False: no such level.
bool start_log(const std::string& program, const std::string& level);
// From here on the log also goes to `folder`/PROGRAM.log, mode 0600; the folder is made, mode 0700. What cannot be
// written is one warning. Call it after start_log.
void start_log_file(const std::string& program, const std::string& folder);
void log_debug(std::string_view text);
void log_info(std::string_view text);
void log_warning(std::string_view text);
void log_error(std::string_view text);
// Of lines of one kind (RepeatFilter) ten pass within 10 s, of all kinds two hundred; the rest are counted. This tells
// of those whose time is over, or at the end of the program of all. Session::heartbeat() and run_program() call it.
enum class LeftOut { over, all };
void log_left_out(LeftOut which);
// A line for the file alone: standard error has it already, in other words.
void log_to_file(std::string_view text);

}  // namespace yars::databuffer
