#include "tools/status_health.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "databuffer/records/plain_text.hpp"
#include "tools/restart_note.hpp"

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

void count_restarts(ordered_json& role, const std::vector<databuffer::Note>& notes, std::int64_t now_ns) {
  int all = 0;
  int recent = 0;
  for (const databuffer::Note& note : notes) {
    if (note.kind != static_cast<std::uint32_t>(databuffer::NoteKind::supervision) ||
        databuffer::text_of(note.process) != role["name"].get<std::string>() ||
        !std::string_view(databuffer::text_of(note.text)).starts_with(kRestartNote))
      continue;
    ++all;
    if (now_ns - note.monotonic_ns < kLastMinute_ns) ++recent;
  }
  role["restarts"] = all;
  role["restarts_last_minute"] = recent;
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
  // What a model that has died left behind tells nothing.
  if (!runs(status["roles"], "radar-model")) return;
  if (watch["ownship"].is_null())
    reasons.push_back(status["ownship_lanes"].empty() ? "no ownship: nobody flies"
                                                      : "no ownship: its source is silent");
  else if (model["terrain_bytes"] == 0 && watch["power"] == "OPR" && watch["sweeps"] > 0)
    reasons.emplace_back("terrain missing: none is loaded for where the aircraft is");
}

}  // namespace

ordered_json roles_json(const databuffer::Session& session, const std::vector<databuffer::Note>& notes) {
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
  for (auto& role : roles) count_restarts(role, notes, now_ns);
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
    reasons.push_back("the recorder has stopped: " + recorder["problem"].get<std::string>());
  if (!status["named"].get<bool>())
    reasons.emplace_back(
        "the segment's name was removed from /dev/shm (systemd's RemoveIPC?); the set goes on without");
  return {{"state", reasons.empty() ? "OK" : "DEGRADED"}, {"reasons", reasons}};
}

}  // namespace yars::tools
