// Commands of the instructor's page that change the world: sea, wind, the entries of its lists, fidelity.
// Inputs: the name of a command and its object of JSON. Outputs: the change, as a function for change_world().
// Errors: an argument that is absent or no number of the right kind, when the command is read; a value out of range or
//   an unknown id, when the change is made. Each says what was expected.
// Threads: any; functions without state.
// Source: docs/station.md#commands; names, units and limits of values: lib/values/world_state.idl.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "databuffer/messages/world_state.hpp"
#include "lib/error/error.hpp"
#include "world/world_edit.hpp"

namespace yars::station {

// Makes the world after the change from the world before it and the sim time.
using WorldEdit =
    std::function<error::Expected<databuffer::WorldState>(databuffer::WorldState world, std::int64_t sim_time_ns)>;

// nullopt: the name is not that of a command of the world.
std::optional<error::Expected<WorldEdit>> world_edit(std::string_view command, const nlohmann::json& object);

// List that an object names; nullopt: none of world_lists().
std::optional<world::WorldList> world_list(const nlohmann::json& object, const char* name);
// Names of the lists, for messages.
std::string world_lists();

// Names of the commands, for messages.
std::string_view world_commands();

}  // namespace yars::station
