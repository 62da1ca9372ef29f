// JSON object of a world, as `yars world --json` prints it. Names and units of the values: lib/values/world_state.idl.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "databuffer/messages/world_state.hpp"

namespace yars::world {

// `sim_time_ns`: movers are given with position and heading at this time.
nlohmann::ordered_json world_json(const databuffer::WorldState& world, std::int64_t sim_time_ns);

// Name of a jammer's band: "A" to "E", or "all" for -1.
const char* band_name(std::int32_t band);
// Word for the kind of a sequence point, such as "target" (radar::kPointKindNames).
std::string_view kind_name(const databuffer::WorldPoint& point);
// Word for the echo of a mover, such as "swerling1" (radar::kTargetEchoNames).
std::string_view echo_name(const databuffer::WorldMover& mover);

}  // namespace yars::world
