// Texts of `yars status` and `yars watch`, on standard output.
#pragma once

#include <map>

#include "databuffer/json/status.hpp"

namespace yars::tools {

// The health in the first line, then clock, roles, ownship, radar, counters and the last notes. `loads`: processor load
// by pid; 1.0 is one fully used core.
void print_status(const databuffer::Status& status, const std::map<int, double>& loads);

// One line: time, switches, message, ownship, designations, sweeps.
void print_watch(const databuffer::Watch& watch);

}  // namespace yars::tools
