// The object that `yars watch --json` prints. Source of its fields: docs/spec/commands.md#watch.
#pragma once

#include <nlohmann/json.hpp>

#include "databuffer/session/session.hpp"

namespace yars::tools {

// The fields that come from the radar state alone.
void add_radar_state(nlohmann::ordered_json& object, const databuffer::RadarState& state);

nlohmann::ordered_json watch_object(const databuffer::Session& session);

}  // namespace yars::tools
