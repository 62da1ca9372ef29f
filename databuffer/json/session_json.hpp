// JSON object of `yars watch --json`. Source of its fields and units: docs/commands.md#watch.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "databuffer/session/session.hpp"

namespace yars::databuffer {

// Adds the fields that depend only on the radar state.
void add_radar_state(nlohmann::ordered_json& object, const RadarState& state);

// All fields. Unknown values are null. A radar state or model status that fails validation is replaced by default
// values. `ranging` is null without a target, or if the Outputs record fails validation.
nlohmann::ordered_json watch_object(const Session& session);

}  // namespace yars::databuffer
