// JSON object of `yars status --json`, which is also the input of print_status() (status_text.hpp).
// Inputs: a session, read only. Records that fail validation are left out.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "databuffer/session/session.hpp"

namespace yars::tools {

nlohmann::ordered_json status_json(const databuffer::Session& session, const std::string& name);

}  // namespace yars::tools
