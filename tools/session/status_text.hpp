// `yars status` for people: the verdict in the first line, then roles, ownship, radar, counters and the last notes.
#pragma once

#include <map>
#include <nlohmann/json.hpp>

namespace yars::tools {

// `loads`: shares of a core by pid.
void print_status(const nlohmann::ordered_json& status, const std::map<int, double>& loads);

}  // namespace yars::tools
