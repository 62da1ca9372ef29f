// The object that `yars watch --json` prints: spec of its fields in docs/commands.md.
#pragma once

#include <nlohmann/json.hpp>

#include "databuffer/session.hpp"

namespace yars::tools {

nlohmann::ordered_json watch_object(const databuffer::Session& session);

}  // namespace yars::tools
