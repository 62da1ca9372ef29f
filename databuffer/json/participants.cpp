#include "databuffer/json/participants.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "databuffer/messages/inspection.hpp"
#include "databuffer/session/receivers.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::databuffer {

namespace {

constexpr std::array kRoles{Role::radar_model, Role::state_machine, Role::recorder,
                            Role::traffic,     Role::glass_frames,  Role::tour};

struct Difference {
  std::uint32_t flag;
  std::string_view text;
  std::string_view remedy;  // what it means and what to do, behind "host NAME "
};
constexpr std::array<Difference, 4> kDifferences{
    {{kHostOtherLayout, "other layout", "has another layout of the records: install the same version on both hosts"},
     {kHostOtherConfiguration, "other configuration",
      "has another configuration: start both hosts with the same --config"},
     {kHostOtherTerrain, "other terrain", "has another terrain: start both hosts with the same --terrain"},
     {kHostSameName, "same name",
      "has the name of another host: give each host a `name` of its own in the form Network"}}};

// The records' times may be any numbers, so the differences are taken as double.
double seconds(std::int64_t time_ns) {
  return 1e-9 * static_cast<double>(time_ns);
}

HostSummary summary_of(const HostStatus& host, std::int64_t now_ns) {
  const auto has = [&host](std::uint32_t flag) { return (host.flags & flag) != 0; };
  HostSummary summary;
  summary.name = text::text_of(host.name);
  summary.version = text::text_of(host.version);
  summary.self = has(kHostSelf);
  summary.present = has(kHostPresent);
  summary.left = has(kHostLeft);
  summary.owns_clock = has(kHostOwnsClock);
  if (!summary.present) summary.silent_s = std::max(0.0, seconds(now_ns) - seconds(host.heard_ns));
  summary.priority = host.priority;
  if (has(kHostOffsetKnown)) {
    summary.offset_ms = 1e3 * seconds(host.offset_ns);
    summary.offset_error_ms = 1e3 * seconds(host.offset_error_ns);
  }
  summary.latency_ms = 1e3 * seconds(host.latency_ns);
  summary.received = host.received;
  summary.lost = host.lost;
  summary.refused = host.refused;
  summary.repeated = host.repeated;
  for (const Role role : kRoles)
    if ((host.held_roles >> static_cast<unsigned>(role) & 1U) != 0) summary.roles.emplace_back(name_of(role));
  for (unsigned i = 0; i < kLockstepRoles; ++i)
    if ((host.held_roles >> (kFirstProcessBit + i) & 1U) != 0) summary.roles.emplace_back(kLockstepRoleNames[i]);
  for (const Difference& difference : kDifferences)
    if (has(difference.flag)) summary.differences.push_back(difference.text);
  return summary;
}

std::string self_name(const NetworkSummary& network) {
  const auto self = std::ranges::find_if(network.hosts, &HostSummary::self);
  return self == network.hosts.end() ? "" : self->name;
}

// Other hosts that hold a role now, "A and B" in a conflict; nullopt: none.
std::optional<std::string> other_holders(const NetworkSummary& network, const std::string& role) {
  std::string names;
  for (const HostSummary& host : network.hosts)
    if (!host.self && host.present && std::ranges::find(host.roles, role) != host.roles.end())
      names += (names.empty() ? "" : " and ") + host.name;
  return names.empty() ? std::nullopt : std::optional(names);
}

}  // namespace

std::optional<NetworkSummary> network_of(const Session& session) {
  const auto status = read_valid(session.layout().network_status);
  if (!status || !session.role_is_held(Role::gateway)) return std::nullopt;
  const std::int64_t now_ns = monotonic_ns();
  NetworkSummary network;
  network.joined = status->joined != 0;
  network.secured = status->secured != 0;
  network.domain = status->domain;
  network.load = status->load;
  network.takeovers = status->takeovers;
  network.conflicts = status->conflicts;
  network.age_ms = std::max(0.0, 1e3 * (seconds(now_ns) - seconds(status->monotonic_ns)));
  for (const auto& host : used(status->hosts, status->host_count)) network.hosts.push_back(summary_of(host, now_ns));
  for (const auto& topic : used(status->topics, status->topic_count))
    network.topics.push_back(
        {std::string(text::text_of(topic.name)), topic.sent, topic.sent_bytes, topic.received, topic.received_bytes});
  return network;
}

void add_hosts(std::vector<RoleStatus>& roles, const std::optional<NetworkSummary>& network, const Session& session) {
  const std::int32_t gateway = session.role_holder(Role::gateway);
  bool has_gateway = false;
  std::vector<RoleStatus> kept;
  for (RoleStatus& role : roles) {
    const bool is_gateway = role.pid != 0 && role.pid == gateway;
    if (is_gateway && role.name == "gateway" && std::exchange(has_gateway, true)) continue;
    if (network) {
      const bool is_elsewhere = role.pid == 0 || (is_gateway && role.name != "gateway");
      role.host = is_elsewhere ? other_holders(*network, role.name) : std::optional(self_name(*network));
      if (is_elsewhere && is_gateway && !role.host) {
        role.pid = 0;
        role.heartbeat_ms.reset();
        role.hangs = false;
      }
    }
    kept.push_back(std::move(role));
  }
  roles = std::move(kept);
}

void add_network_reasons(const std::optional<NetworkSummary>& network, std::vector<std::string>& reasons) {
  if (!network) return;
  for (const HostSummary& host : network->hosts) {
    const std::string name = "host " + host.name;
    if (!host.present && !host.left)
      reasons.push_back(name + " has been silent for " +
                        std::to_string(static_cast<long>(std::min(host.silent_s.value_or(0.0), 1e9))) + " s");
    for (const std::string_view text : host.differences) {
      const auto difference = std::ranges::find(kDifferences, text, &Difference::text);
      reasons.push_back(name + ' ' + std::string(difference->remedy));
    }
  }
  if (!network->joined) reasons.emplace_back("the session clock of the hosts is not known yet");
}

}  // namespace yars::databuffer
