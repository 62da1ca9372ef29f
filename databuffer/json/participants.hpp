// Participants of a session: its roles, and its hosts if it runs on several computers. Parts of Status.
// Inputs: a session, read only; the record that its gateway publishes. A record that fails validation counts as absent.
// Source: docs/network.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "databuffer/session/session.hpp"

namespace yars::databuffer {

// An entry of the process table, or a needed role that does not run.
struct RoleStatus {
  std::string name;
  std::int32_t pid = 0;                  // 0: not running here. Of a role of another host: the gateway's
  std::optional<double> heartbeat_ms{};  // age of the last heartbeat; nullopt: not running here
  bool hangs = false;                    // a role of a set whose heartbeat is older than 2 s
  std::optional<std::string> host{};     // where it runs; nullopt: nowhere, or no gateway runs
  std::uint64_t restarts = 0;            // by the supervisor
  std::uint64_t restarts_last_minute = 0;

  bool runs() const { return pid != 0 || host; }
};

// A host of a session on several computers, as the gateway of this host knows it.
struct HostSummary {
  std::string name, version;
  bool self = false, present = false, left = false, owns_clock = false;
  std::optional<double> silent_s;  // nullopt: present
  std::uint32_t priority = 0;
  std::optional<double> offset_ms, offset_error_ms;  // of its clock; nullopt: not measured
  double latency_ms = 0.0;
  std::uint64_t received = 0, lost = 0, refused = 0, repeated = 0;  // messages
  std::vector<std::string> roles;
  std::vector<std::string_view> differences;  // "other layout", ...
};
struct TopicSummary {
  std::string name;
  std::uint64_t sent = 0, sent_bytes = 0, received = 0, received_bytes = 0;
};
struct NetworkSummary {
  bool joined = false, secured = false;
  std::uint32_t domain = 0;
  double load = 0.0;  // share of a core
  std::uint64_t takeovers = 0, conflicts = 0;
  double age_ms = 0.0;  // of the record
  std::vector<HostSummary> hosts;
  std::vector<TopicSummary> topics;
};

// What the gateway of this host knows; nullopt if no gateway runs, or none has published a valid record.
std::optional<NetworkSummary> network_of(const Session& session);

// Sets the host of each role: where it runs; nullopt: nowhere, or no gateway runs. An entry that the gateway keeps for
// another host, after that host has gone, becomes one that does not run. Further entries of the gateway itself are
// removed.
void add_hosts(std::vector<RoleStatus>& roles, const std::optional<NetworkSummary>& network, const Session& session);

// Adds reasons why the session is not OK: hosts that are silent or differ, no session clock.
void add_network_reasons(const std::optional<NetworkSummary>& network, std::vector<std::string>& reasons);

}  // namespace yars::databuffer
