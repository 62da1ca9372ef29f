// The hosts of a session that runs on several computers, for Status.
// Inputs: a session, read only; the record that its gateway publishes. A record that fails validation counts as absent.
// Source: docs/network.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "databuffer/json/status.hpp"

namespace yars::databuffer {

// What the gateway of this host knows; nullopt if no gateway runs, or none has published a valid record.
std::optional<NetworkSummary> network_of(const Session& session);

// Sets the host of each role: where it runs; nullopt: nowhere, or no gateway runs. An entry that the gateway keeps for
// another host, after that host has gone, becomes one that does not run. Further entries of the gateway itself are
// removed.
void add_hosts(std::vector<RoleStatus>& roles, const std::optional<NetworkSummary>& network, const Session& session);

// Adds reasons why the session is not OK: hosts that are silent or differ, no session clock.
void add_network_reasons(const std::optional<NetworkSummary>& network, std::vector<std::string>& reasons);

}  // namespace yars::databuffer
