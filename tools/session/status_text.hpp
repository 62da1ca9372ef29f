// Text output of `yars status`: the verdict in the first line, then roles, ownship, radar, counters and the last notes.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>

namespace yars::tools {

// `status`: from status_json(). `loads`: CPU load by pid, as a fraction of one core.
void print_status(const nlohmann::ordered_json& status, const std::map<int, double>& loads);

}  // namespace yars::tools
