// The object that `yars status --json` prints, and print_status() for people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "databuffer/session/session.hpp"

namespace yars::tools {

nlohmann::ordered_json status_json(const databuffer::Session& session, const std::string& name);

}  // namespace yars::tools
