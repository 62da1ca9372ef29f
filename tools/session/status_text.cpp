#include "tools/session/status_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "databuffer/messages/derived_values.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::tools {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t kNotesShown = 10;  // the newest notes that the text shows; --json has all

// Text that other programs wrote, without characters that could control the terminal.
std::string text(const ordered_json& value) {
  std::string words = value.get<std::string>();
  std::replace_if(words.begin(), words.end(), [](char letter) { return letter < ' ' || letter > '~'; }, '?');
  return words;
}

std::string age_text(double seconds) {
  std::array<char, 32> buffer;
  if (seconds < 1.0)
    std::snprintf(buffer.data(), buffer.size(), "%.0f ms", 1000.0 * seconds);
  else if (seconds < 120.0)
    std::snprintf(buffer.data(), buffer.size(), "%.1f s", seconds);
  else if (seconds < 7200.0)
    std::snprintf(buffer.data(), buffer.size(), "%.0f min", seconds / 60.0);
  else
    std::snprintf(buffer.data(), buffer.size(), "%.1f h", seconds / 3600.0);
  return buffer.data();
}

std::string load_text(double fraction) {
  std::array<char, 32> buffer;
  std::snprintf(buffer.data(), buffer.size(), "%.1f %%", 100.0 * fraction);
  return buffer.data();
}

void print_verdict(const ordered_json& status) {
  const auto& health = status["health"];
  std::string reasons;
  for (const auto& reason : health["reasons"]) reasons += (reasons.empty() ? "" : "; ") + text(reason);
  const bool is_frozen = !status["watch"]["running"].get<bool>();
  if (reasons.empty()) reasons = is_frozen ? "the set runs, its sim time is frozen: yars sim run" : "the set runs";
  std::printf("%s: %s\n", text(health["state"]).c_str(), reasons.c_str());
  const auto& watch = status["watch"];
  std::printf("session %s: sim time %.1f s, %s, rate %g, epoch %u\n", text(status["session"]).c_str(),
              watch["sim_time"].get<double>(), watch["running"].get<bool>() ? "running" : "frozen",
              watch["rate"].get<double>(), watch["epoch"].get<unsigned>());
}

// [ms] with the unit that suits.
std::string interval_text(double interval_ms) {
  std::array<char, 32> buffer;
  if (std::abs(interval_ms) < 1.0)
    std::snprintf(buffer.data(), buffer.size(), "%.0f us", 1000.0 * interval_ms);
  else if (std::abs(interval_ms) < 1000.0)
    std::snprintf(buffer.data(), buffer.size(), "%.1f ms", interval_ms);
  else
    std::snprintf(buffer.data(), buffer.size(), "%.3f s", interval_ms / 1000.0);
  return buffer.data();
}

// Pid 0 and heartbeat stand for a role of another host that this host's gateway does not keep.
void print_roles(const ordered_json& status, const std::map<int, double>& loads) {
  const auto& roles = status["roles"];
  const auto& network = status["network"];
  const auto self = network.is_null() || network["hosts"].empty() ? ordered_json(nullptr) : network["hosts"][0]["name"];
  std::printf("  %-20s %8s %10s %8s %9s\n", "role", "pid", "heartbeat", "load", "restarts");
  for (const auto& role : roles) {
    const int pid = role["pid"];
    const bool is_remote = !role["host"].is_null() && role["host"] != self;
    const auto load = is_remote ? loads.end() : loads.find(pid);
    const std::string beat = pid == 0 ? "none" : age_text(role["heartbeat_ms"].get<double>() / 1000.0);
    std::printf("  %-20s %8s %10s %8s %9d%s%s\n", text(role["name"]).c_str(),
                pid == 0 ? "-" : std::to_string(pid).c_str(), beat.c_str(),
                load == loads.end() ? "-" : load_text(load->second).c_str(), role["restarts"].get<int>(),
                role["hangs"].get<bool>() ? "  hangs" : "", is_remote ? ("  on " + text(role["host"])).c_str() : "");
  }
}

std::string joined_text(const ordered_json& words) {
  std::string joined;
  for (const auto& word : words) joined += (joined.empty() ? "" : ", ") + text(word);
  return joined;
}

void print_host(const ordered_json& host) {
  const bool self = host["self"];
  std::string more = joined_text(host["roles"]);
  const auto add = [&more](const std::string& words) { more += (more.empty() ? "" : "; ") + words; };
  if (host["owns_clock"].get<bool>()) add("sets the clock");
  if (!host["differences"].empty()) add(joined_text(host["differences"]));
  const std::string heard = host["present"].get<bool>() ? "yes"
                                                        : (host["left"].get<bool>() ? "left " : "silent ") +
                                                              age_text(host["silent_s"].get<double>());
  const auto& offset = host["offset_ms"];
  const auto number = [&host](const char* field) { return std::to_string(host[field].get<std::uint64_t>()); };
  std::printf("  %-20s %-14s %14s %10s %10s %8s %8s %9s  %s\n", (text(host["name"]) + (self ? " *" : "")).c_str(),
              self ? "this host" : heard.c_str(),
              self               ? "-"
              : offset.is_null() ? "unknown"
                                 : interval_text(offset.get<double>()).c_str(),
              self || offset.is_null() ? "-" : interval_text(host["offset_error_ms"].get<double>()).c_str(),
              self ? "-" : interval_text(host["latency_ms"].get<double>()).c_str(), number("lost").c_str(),
              number("refused").c_str(), number("repeated").c_str(), more.c_str());
}

void print_network(const ordered_json& network) {
  if (network.is_null()) return;
  std::printf("hosts:\n  %-20s %-14s %14s %10s %10s %8s %8s %9s  %s\n", "name", "heard", "offset", "error", "latency",
              "lost", "refused", "repeated", "roles");
  for (const auto& host : network["hosts"]) print_host(host);
  std::printf("gateway: DDS domain %u, %s, %s of a core, %s, %s\n", network["domain"].get<unsigned>(),
              network["secured"].get<bool>() ? "encrypted" : "not encrypted",
              load_text(network["load"].get<double>()).c_str(),
              text::counted(network["takeovers"].get<std::uint64_t>(), "takeover").c_str(),
              text::counted(network["conflicts"].get<std::uint64_t>(), "conflict").c_str());
}

void print_ownship(const ordered_json& status) {
  const auto& own = status["watch"]["ownship"];
  if (own.is_null())
    std::printf("ownship: none\n");
  else
    std::printf("ownship: %s, %.4f %.4f, %.0f ft MSL, track %.0f deg, %.0f kt, %s old\n", text(own["source"]).c_str(),
                own["lat"].get<double>(), own["lon"].get<double>(), own["alt_ft"].get<double>(),
                own["track_deg"].get<double>(), own["ground_speed_kt"].get<double>(),
                age_text(own["age_ms"].get<double>() / 1000.0).c_str());
  for (const auto& lane : status["ownship_lanes"])
    std::printf("  lane %d: %s, priority %u, %s so far\n", lane["lane"].get<int>(), text(lane["source"]).c_str(),
                lane["priority"].get<unsigned>(),
                text::counted(lane["records"].get<std::uint64_t>(), "record").c_str());
}

bool takes_part(const ordered_json& roles, std::string_view name) {
  return std::ranges::any_of(roles, [name](const auto& role) {
    return role["name"] == name && (role["pid"] != 0 || !role["host"].is_null());
  });
}

// What the display says, each with its remedy. Power OFF shows NO STATE MACHINE alone.
void print_display_words(const ordered_json& status) {
  const auto& watch = status["watch"];
  const auto say = [](const std::string& words, const std::string& remedy) {
    std::printf("display says: %s%s%s\n", words.c_str(), remedy.empty() ? "" : "; ", remedy.c_str());
  };
  const bool state_machine = takes_part(status["roles"], "state-machine"),
             model = takes_part(status["roles"], "radar-model");
  if (!state_machine) say("NO STATE MACHINE", databuffer::kRemedyNoStateMachine);
  if (watch["power"] == "OFF") return;
  if (!model) say("NO MODEL", databuffer::kRemedyNoModel);
  if (model && watch["ownship"].is_null()) say("NO OWNSHIP", databuffer::kRemedyNoOwnship);
  const std::string message = text(watch["message"]);
  if (state_machine && !message.empty() && message != "NO OWNSHIP") say(message, text(watch["remedy"]));
}

void print_radar(const ordered_json& status) {
  const auto& watch = status["watch"];
  const auto& model = status["model"];
  const std::string fidelity = text(model["fidelity"]);
  std::printf("radar: %s %s, %.1f NM, fidelity %s, kernel %s of a core, %s, terrain %.1f MB\n",
              text(watch["power"]).c_str(), text(watch["mode"]).c_str(), watch["range_nm"].get<double>(),
              fidelity.empty() ? "unknown" : fidelity.c_str(), load_text(model["load"].get<double>()).c_str(),
              text::counted(watch["sweeps"].get<std::uint64_t>(), "sweep").c_str(),
              static_cast<double>(model["terrain_bytes"].get<std::uint64_t>()) / 1e6);
  print_display_words(status);
  const auto& recorder = status["recorder"];
  if (recorder.is_null()) return;
  std::printf("recorder: %s, %.1f MB", recorder["writing"].get<bool>() ? "writing" : "stopped",
              static_cast<double>(recorder["bytes"].get<std::uint64_t>()) / 1e6);
  if (!recorder["problem"].is_null()) std::printf(", %s", text(recorder["problem"]).c_str());
  std::printf("\n");
}

void print_frames(const ordered_json& frames) {
  if (frames.is_null()) return;
  const auto& pid = frames["publisher"];
  std::printf("frames of the display: %s, newest %llu, %u x %u pixels\n",
              pid.is_null() ? "nobody publishes" : ("pid " + std::to_string(pid.get<int>()) + " publishes").c_str(),
              static_cast<unsigned long long>(frames["newest"].get<std::uint64_t>()), frames["width"].get<unsigned>(),
              frames["height"].get<unsigned>());
}

void print_tour(const ordered_json& caption) {
  if (caption.is_null()) return;
  std::string words;
  for (const auto& line : caption["lines"]) words += (words.empty() ? "" : " ") + text(line);
  std::printf("tour: step %u of %u%s: %s\n", caption["step"].get<unsigned>(), caption["steps"].get<unsigned>(),
              caption["waiting"].get<bool>() ? ", waits for the pilot (key n goes on)" : "", words.c_str());
}

void print_traffic(const ordered_json& traffic) {
  if (traffic.is_null()) return;
  std::printf("traffic: pid %d reports %s\n", traffic["holder"].get<int>(),
              text::counted(traffic["entities"].get<unsigned>(), "ship or vehicle", "ships and vehicles").c_str());
}

void print_notes(const ordered_json& status) {
  std::printf("flight recorder:");
  const char* separator = " ";
  for (const auto& [kind, count] : status["note_counts"].items()) {
    std::printf("%s%s %llu", separator, kind.c_str(), static_cast<unsigned long long>(count.get<std::uint64_t>()));
    separator = ", ";
  }
  if (const auto folded = status["notes_folded"].get<std::uint64_t>(); folded > 0)
    std::printf("; %llu repeated notes are counted, not listed", static_cast<unsigned long long>(folded));
  std::printf("\n");
  const auto& notes = status["notes"];
  for (std::size_t i = notes.size() > kNotesShown ? notes.size() - kNotesShown : 0; i < notes.size(); ++i)
    std::printf("  %7s ago  %-14s %-11s %s\n", age_text(notes[i]["age_s"].get<double>()).c_str(),
                text(notes[i]["process"]).c_str(), text(notes[i]["kind"]).c_str(), text(notes[i]["text"]).c_str());
}

}  // namespace

void print_status(const ordered_json& status, const std::map<int, double>& loads) {
  print_verdict(status);
  print_roles(status, loads);
  print_network(status["network"]);
  print_ownship(status);
  print_radar(status);
  print_frames(status["glass_frames"]);
  print_traffic(status["traffic"]);
  print_tour(status["watch"]["caption"]);
  print_notes(status);
}

}  // namespace yars::tools
