// Text of `yars status`, made of the object of `--json`.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>

namespace yars::tools {

// Prints the text to standard output: the health in the first line, then clock, roles, ownship, radar, counters and the
// last notes. `status`: from status_json(). `loads`: processor load by pid; 1.0 is one fully used core.
void print_status(const nlohmann::ordered_json& status, const std::map<int, double>& loads);

}  // namespace yars::tools
