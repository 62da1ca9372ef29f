// How the supervisor's notes of the flight recorder begin when it has started a role again: `yars note` writes them,
// `yars status` counts them.
#pragma once

#include <string_view>

namespace yars::tools {

inline constexpr std::string_view kRestartNote = "started again: ";

}  // namespace yars::tools
