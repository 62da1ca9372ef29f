// The hosts of a session that runs on several computers, for `yars status`.
// Inputs: a session, read only; the record that its gateway publishes. A record that fails validation counts as absent.
// Outputs: JSON objects and texts. Times in ms or s as their names say.
// Source: docs/network.md.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "databuffer/session/session.hpp"

namespace yars::databuffer {

// What the gateway of this host knows; null if no gateway runs, or none has published a valid record.
// {"joined", "domain", "secured", "load" (share of a core), "takeovers", "conflicts", "age_ms" (of the record),
// "hosts": [{"name", "version", "self", "present", "silent_s" (null: present), "owns_clock", "priority", "offset_ms",
// "offset_error_ms" (both null: not measured), "latency_ms", "received", "lost", "refused", "repeated", "roles":
// [names], "differences": [texts]}], "topics": [{"name", "sent", "sent_bytes", "received", "received_bytes"}]}
nlohmann::ordered_json network_json(const Session& session);

// Adds "host" to each entry of roles_json(): the host where the role runs; null: nowhere, or no gateway runs. An entry
// that the gateway keeps for another host, after that host has gone, becomes one that does not run. Further entries of
// the gateway itself are removed.
void add_hosts(nlohmann::ordered_json& roles, const nlohmann::ordered_json& network, const Session& session);

// Adds reasons why the session is not OK: hosts that are silent or differ, no session clock. `network`: of
// network_json().
void add_network_reasons(const nlohmann::ordered_json& network, std::vector<std::string>& reasons);

}  // namespace yars::databuffer
