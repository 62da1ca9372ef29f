// JSON objects of `yars status --json` and `yars watch --json`. Source of their fields and units:
// docs/commands.md#status, docs/commands.md#watch. Unknown values are null.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "databuffer/json/status.hpp"

namespace yars::databuffer {

nlohmann::ordered_json status_json(const Status& status);
nlohmann::ordered_json watch_json(const Watch& watch);
// Adds the fields that depend only on the radar state.
void add_radar_state(nlohmann::ordered_json& object, const RadarState& state);

}  // namespace yars::databuffer
