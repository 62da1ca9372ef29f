#include "databuffer/json/network_json.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "databuffer/messages/inspection.hpp"
#include "databuffer/session/validated.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::databuffer {

namespace {

using nlohmann::ordered_json;

constexpr std::array kRoles{Role::radar_model, Role::state_machine, Role::recorder,
                            Role::traffic,     Role::glass_frames,  Role::tour};

struct Difference {
  std::uint32_t flag;
  const char* text;
};
constexpr std::array<Difference, 4> kDifferences{{{kHostOtherLayout, "other layout"},
                                                  {kHostOtherConfiguration, "other configuration"},
                                                  {kHostOtherTerrain, "other terrain"},
                                                  {kHostSameName, "same name"}}};

// What a difference means and what to do, behind "host NAME ".
std::string remedy_of(std::string_view difference) {
  if (difference == "other layout") return "has another layout of the records: install the same version on both hosts";
  if (difference == "other configuration") return "has another configuration: start both hosts with the same --config";
  if (difference == "other terrain") return "has another terrain: start both hosts with the same --terrain";
  return "has the name of another host: give each host a `name` of its own in the form Network";
}

// The records' times may be any numbers, so the differences are taken as double.
double seconds(std::int64_t time_ns) {
  return 1e-9 * static_cast<double>(time_ns);
}

ordered_json host_json(const HostStatus& host, std::int64_t now_ns) {
  const auto has = [&host](std::uint32_t flag) { return (host.flags & flag) != 0; };
  ordered_json roles = ordered_json::array(), differences = ordered_json::array();
  for (const Role role : kRoles)
    if ((host.held_roles >> static_cast<unsigned>(role) & 1U) != 0) roles.push_back(name_of(role));
  for (unsigned i = 0; i < kLockstepRoles; ++i)
    if ((host.held_roles >> (kFirstProcessBit + i) & 1U) != 0) roles.push_back(kLockstepRoleNames[i]);
  for (const Difference& difference : kDifferences)
    if (has(difference.flag)) differences.push_back(difference.text);
  const bool measured = has(kHostOffsetKnown);
  const bool present = has(kHostPresent);
  const auto number = [](bool is_known, double value) {
    return is_known ? ordered_json(value) : ordered_json(nullptr);
  };
  return {{"name", text::text_of(host.name)},
          {"version", text::text_of(host.version)},
          {"self", has(kHostSelf)},
          {"present", present},
          {"left", has(kHostLeft)},
          {"silent_s", number(!present, std::max(0.0, seconds(now_ns) - seconds(host.heard_ns)))},
          {"owns_clock", has(kHostOwnsClock)},
          {"priority", host.priority},
          {"offset_ms", number(measured, 1e3 * seconds(host.offset_ns))},
          {"offset_error_ms", number(measured, 1e3 * seconds(host.offset_error_ns))},
          {"latency_ms", 1e3 * seconds(host.latency_ns)},
          {"received", host.received},
          {"lost", host.lost},
          {"refused", host.refused},
          {"repeated", host.repeated},
          {"roles", roles},
          {"differences", differences}};
}

std::string self_name(const ordered_json& network) {
  for (const auto& host : network["hosts"])
    if (host["self"].get<bool>()) return host["name"];
  return "";
}

// Other hosts that hold a role now, "A and B" in a conflict; null: none.
ordered_json other_holders(const ordered_json& network, const std::string& role) {
  std::string names;
  for (const auto& host : network["hosts"]) {
    const auto& roles = host["roles"];
    if (host["self"].get<bool>() || !host["present"].get<bool>() ||
        std::find(roles.begin(), roles.end(), role) == roles.end())
      continue;
    names += (names.empty() ? "" : " and ") + host["name"].get<std::string>();
  }
  return names.empty() ? ordered_json(nullptr) : ordered_json(names);
}

}  // namespace

ordered_json network_json(const Session& session) {
  const auto status = read_valid(session.layout().network_status);
  if (!status || !session.role_is_held(Role::gateway)) return nullptr;
  const std::int64_t now_ns = monotonic_ns();
  ordered_json hosts = ordered_json::array(), topics = ordered_json::array();
  for (const auto& host : used(status->hosts, status->host_count)) hosts.push_back(host_json(host, now_ns));
  for (const auto& topic : used(status->topics, status->topic_count))
    topics.push_back({{"name", text::text_of(topic.name)},
                      {"sent", topic.sent},
                      {"sent_bytes", topic.sent_bytes},
                      {"received", topic.received},
                      {"received_bytes", topic.received_bytes}});
  return {{"joined", status->joined != 0},
          {"domain", status->domain},
          {"secured", status->secured != 0},
          {"load", status->load},
          {"takeovers", status->takeovers},
          {"conflicts", status->conflicts},
          {"age_ms", std::max(0.0, 1e3 * (seconds(now_ns) - seconds(status->monotonic_ns)))},
          {"hosts", hosts},
          {"topics", topics}};
}

void add_hosts(ordered_json& roles, const ordered_json& network, const Session& session) {
  const std::int32_t gateway = session.role_holder(Role::gateway);
  bool has_gateway = false;
  ordered_json kept = ordered_json::array();
  for (auto& role : roles) {
    const int pid = role["pid"];
    const auto name = role["name"].get<std::string>();
    const bool is_gateway = pid != 0 && pid == gateway;
    if (is_gateway && name == "gateway" && std::exchange(has_gateway, true)) continue;
    role["host"] = nullptr;
    if (!network.is_null())
      role["host"] = pid == 0 || (is_gateway && name != "gateway") ? other_holders(network, name)
                                                                   : ordered_json(self_name(network));
    if (is_gateway && name != "gateway" && role["host"].is_null() && !network.is_null()) {
      role["pid"] = 0;
      role["heartbeat_ms"] = nullptr;
      role["hangs"] = false;
    }
    kept.push_back(std::move(role));
  }
  roles = std::move(kept);
}

void add_network_reasons(const ordered_json& network, std::vector<std::string>& reasons) {
  if (network.is_null()) return;
  for (const auto& host : network["hosts"]) {
    const auto name = "host " + host["name"].get<std::string>();
    if (!host["present"].get<bool>() && !host["left"].get<bool>())
      reasons.push_back(name + " has been silent for " +
                        std::to_string(static_cast<long>(std::min(host["silent_s"].get<double>(), 1e9))) + " s");
    for (const auto& difference : host["differences"])
      reasons.push_back(name + " " + remedy_of(difference.get<std::string>()));
  }
  if (!network["joined"].get<bool>()) reasons.emplace_back("the session clock of the hosts is not known yet");
}

}  // namespace yars::databuffer
