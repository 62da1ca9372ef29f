// World of a session: what is in effect, and changes of it.
// Inputs: the containers world, world_configured and world_latched of the segment (docs/shared_memory.md#world).
// Outputs: the world in effect; a new wanted world, which radar-model latches at its next tick.
// Errors: no radar-model, or one on another host; the replay of a recording; a change that is refused; another program
// that holds the role instructor for 0.2 s. Threads: any number of programs may change the world: each waits for the
// others, and no change is lost.
#pragma once

#include <functional>
#include <optional>

#include "databuffer/messages/world_state.hpp"
#include "databuffer/session/session.hpp"
#include "lib/error/error.hpp"

namespace yars::databuffer {

// World that radar-model has in effect. nullopt: none was published, as before radar-model's first tick.
std::optional<WorldState> world_in_effect(const SessionLayout& layout);

// World with all changes so far: the one in effect, or a newer one that radar-model has not latched yet. A frozen clock
// delays the latching.
std::optional<WorldState> newest_world(const SessionLayout& layout);

// Makes a changed world out of the newest one, or says why not. See world_edit.hpp.
using WorldChange = std::function<error::Expected<WorldState>(const WorldState&)>;

// Replaces the newest world by change(world) while holding the role instructor, and returns it. Its `edit` is one
// greater.
error::Expected<WorldState> change_world(Session& session, const WorldChange& change);

// Replaces the newest world by that of radar-model's configuration.
error::Expected<WorldState> reset_world(Session& session);

}  // namespace yars::databuffer
