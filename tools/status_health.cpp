#include "tools/status_health.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace yars::tools {

namespace {

using nlohmann::ordered_json;

constexpr double kHangsAfter_ms = 2000.0;
constexpr std::int64_t kLastMinute_ns = 60'000'000'000;

struct SetRole {
  const char* name;
  bool needed;  // without it there is no radar
};
constexpr std::array<SetRole, 6> kSet{{{"state-machine", true},
                                       {"radar-model", true},
                                       {"flight-model", false},
                                       {"input-monitor", false},
                                       {"radar-display", false},
                                       {"recorder", false}}};

std::size_t place_of(std::string_view name) {
  return static_cast<std::size_t>(
      std::ranges::find(kSet, name, [](const SetRole& role) { return std::string_view(role.name); }) - kSet.begin());
}

ordered_json role_json(const databuffer::ProcessHere& process, std::int64_t now_ns) {
  const double heartbeat_ms = static_cast<double>(now_ns - process.heartbeat_ns) * 1e-6;
  // Only of the set's own roles is it known that they beat.
  const bool hangs = place_of(process.name) < kSet.size() && heartbeat_ms > kHangsAfter_ms;
  return {{"name", process.name}, {"pid", process.pid}, {"heartbeat_ms", heartbeat_ms}, {"hangs", hangs}};
}

// Counted beside the flight recorder: a flood of its lines changes nothing here.
void count_restarts(ordered_json& role, const databuffer::Session& session, std::int64_t now_ns) {
  const auto index = databuffer::counted_role(role["name"].get<std::string>());
  const databuffer::RecentCount none{};
  const auto& restarts = index ? session.layout().counters.restarts[*index] : none;
  role["restarts"] = restarts.count.load();
  role["restarts_last_minute"] = restarts.within(kLastMinute_ns, now_ns);
}

void judge_roles(const ordered_json& roles, std::vector<std::string>& reasons) {
  for (const auto& role : roles) {
    const auto name = role["name"].get<std::string>();
    if (role["pid"] == 0) reasons.push_back(name + " is not running");
    if (role["hangs"].get<bool>())
      reasons.push_back((name == "radar-display" ? "the glass" : name) + " hangs (heartbeat " +
                        std::to_string(static_cast<int>(role["heartbeat_ms"].get<double>() / 1000.0)) + " s old)");
    const int restarts = role["restarts_last_minute"];
    if (restarts == 0) continue;
    reasons.push_back(name + " was started again " + (restarts == 1 ? "once" : std::to_string(restarts) + " times") +
                      " in the last minute");
  }
}

bool runs(const ordered_json& roles, std::string_view name) {
  return std::ranges::any_of(roles, [name](const auto& role) { return role["name"] == name && role["pid"] != 0; });
}

void judge_radar(const ordered_json& status, std::vector<std::string>& reasons) {
  const auto& watch = status["watch"];
  const auto& model = status["model"];
  if (runs(status["roles"], "state-machine") && watch["power"] == "OFF")
    reasons.emplace_back("the radar is off: yars inject 'power opr' switches it on");
  // What a model that has died left behind tells nothing.
  if (!runs(status["roles"], "radar-model")) return;
  if (watch["ownship"].is_null())
    reasons.push_back(status["ownship_lanes"].empty() ? "no ownship: nobody flies"
                                                      : "no ownship: its source is silent");
  else if (model["terrain_bytes"] == 0 && watch["power"] == "OPR" && watch["sweeps"] > 0)
    reasons.emplace_back("terrain missing: none is loaded for where the aircraft is");
}

// One record out of range is somebody's slip; this many within ten seconds are a writer that goes on with it.
void judge_borders(const ordered_json& status, std::vector<std::string>& reasons) {
  constexpr int kManyRefusals = 3;
  if (!status["clock_problem"].is_null())
    reasons.push_back("the session's clock is damaged (" + status["clock_problem"].get<std::string>() +
                      "): yars sim reset sets it");
  const auto& input = status["input"];
  if (input["sources"] == 0 && input["missing"] > 0) reasons.emplace_back("no input: who sent events has died");
  const auto& refusals = status["refusals"];
  if (refusals["last_10_s"] < kManyRefusals) return;
  const std::string newest = refusals["newest"].is_null() ? "" : ": " + refusals["newest"].get<std::string>();
  reasons.push_back("records are being refused" + newest);
}

}  // namespace

ordered_json roles_json(const databuffer::Session& session) {
  const std::int64_t now_ns = databuffer::monotonic_ns();
  const auto processes = session.processes();
  ordered_json roles = ordered_json::array();
  // In the order of a set, then who is none of its roles.
  for (std::size_t place = 0; place <= kSet.size(); ++place) {
    bool here = false;
    for (const auto& process : processes) {
      if (place_of(process.name) != place) continue;
      roles.push_back(role_json(process, now_ns));
      here = true;
    }
    if (!here && place < kSet.size() && kSet[place].needed)
      roles.push_back({{"name", kSet[place].name}, {"pid", 0}, {"heartbeat_ms", nullptr}, {"hangs", false}});
  }
  for (auto& role : roles) count_restarts(role, session, now_ns);
  return roles;
}

ordered_json health_json(const ordered_json& status) {
  const auto& roles = status["roles"];
  if (std::ranges::none_of(roles, [](const auto& role) { return role["pid"] != 0; }))
    return {{"state", "NOTHING RUNS"}, {"reasons", {"the session is there, but nobody takes part"}}};
  std::vector<std::string> reasons;
  judge_roles(roles, reasons);
  judge_radar(status, reasons);
  if (const auto& recorder = status["recorder"]; !recorder.is_null() && !recorder["problem"].is_null())
    reasons.push_back("the recorder does not write: " + recorder["problem"].get<std::string>());
  if (status["frames_failing"].get<bool>() && runs(roles, "radar-display"))
    reasons.emplace_back("the glass cannot write its frames: see its log");
  judge_borders(status, reasons);
  if (!status["named"].get<bool>())
    reasons.emplace_back(
        "the segment's name was removed from /dev/shm (systemd's RemoveIPC?); the set goes on without");
  return {{"state", reasons.empty() ? "OK" : "DEGRADED"}, {"reasons", reasons}};
}

}  // namespace yars::tools
