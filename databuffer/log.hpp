// The programs' log: lines on standard error, and in the session's log file when one is named. A thin face over
// spdlog, so that only one source pays for its headers.
#pragma once

#include <string>
#include <string_view>

namespace yars::databuffer {

// Level names: trace, debug, info, warning, error, off. False: no such level.
bool start_log(const std::string& program, const std::string& level);
void log_debug(std::string_view text);
void log_info(std::string_view text);
void log_warning(std::string_view text);
void log_error(std::string_view text);

}  // namespace yars::databuffer
