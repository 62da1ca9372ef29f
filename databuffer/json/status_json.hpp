// Output of `yars status`: the JSON object of `--json`, and the text made of it (status_text.cpp).
// Inputs: a session, read only. A record that fails validation counts as absent. An absent value is null,
// omitted, or the default of its type.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "databuffer/session/session.hpp"

namespace yars::tools {

// The object of `--json` for an open session. `name`: the session's name.
nlohmann::ordered_json status_json(const databuffer::Session& session, const std::string& name);

// Prints the text to standard output: the health in the first line, then clock, roles, ownship, radar, counters and the
// last notes. `status`: from status_json(). `loads`: CPU load by pid; 1.0 is one fully used core.
void print_status(const nlohmann::ordered_json& status, const std::map<int, double>& loads);

}  // namespace yars::tools
