// JSON object of `yars status --json`. Source of its fields and units: docs/commands.md#status.
// Inputs: a session, read only. A record that fails validation counts as absent. An absent value is null,
// omitted, or the default of its type.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "databuffer/session/session.hpp"

namespace yars::databuffer {

// The object for an open session. `name`: the session's name.
nlohmann::ordered_json status_json(const Session& session, const std::string& name);

}  // namespace yars::databuffer
