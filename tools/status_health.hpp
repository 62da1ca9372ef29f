// What `yars status` makes of a session at a glance.
#pragma once

#include <nlohmann/json.hpp>

#include "databuffer/session.hpp"

namespace yars::tools {

// Everybody in the process table and the roles that a set cannot be without, in the order of a set:
// [{name, pid (0: not running), heartbeat_ms (null: not running), hangs, restarts, restarts_last_minute}].
// A role hangs when its heartbeat is older than 2 s; restarts are the supervisor's.
nlohmann::ordered_json roles_json(const databuffer::Session& session);

// {"state": "OK", "DEGRADED" or "NOTHING RUNS", "reasons": [words]}, from the object with watch, model, roles,
// recorder, frames_failing, input, refusals, clock_problem and named.
nlohmann::ordered_json health_json(const nlohmann::ordered_json& status);

}  // namespace yars::tools
