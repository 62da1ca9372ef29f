#include "databuffer/json/status_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "databuffer/json/network_json.hpp"
#include "databuffer/json/session_json.hpp"
#include "databuffer/messages/validation.hpp"
#include "databuffer/runtime/receivers.hpp"
#include "databuffer/runtime/tick_loop.hpp"
#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/session.hpp"
#include "databuffer/session/validated.hpp"
#include "lib/radar/modes.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::databuffer {

// All entries of the process table, and the needed roles that do not run. The roles come first, in the order of
// kSetRoles.
// [{name, pid (0: not running here), heartbeat_ms (age of the last heartbeat; null: not running), hangs, host (where it
// runs; null: nowhere, or unknown), restarts, restarts_last_minute}]. pid of a role of another host: the gateway's.
// A role of kSetRoles hangs if its heartbeat is older than 2 s. Only restarts by the supervisor count.
// `network`: of network_json().
nlohmann::ordered_json roles_json(const Session& session, const nlohmann::ordered_json& network);

// How far each role of kLockstepRoleNames lags behind the clock: {ROLE: {"skipped": ticks, "share": of the ticks that
// were due, "seconds": in which ticks were skipped}}, over the last kLag_s. Roles that skipped none, and a frozen
// clock's roles, are left out.
nlohmann::ordered_json lag_json(const Session& session);

// {"state": "OK", "DEGRADED" or "NOTHING RUNS", "reasons": [texts]}. `status` must have watch, model, roles, recorder,
// lag, ownship_lanes, frames_failing, input, refusals, clock_problem, named and network.
nlohmann::ordered_json health_json(const nlohmann::ordered_json& status);

namespace {

using nlohmann::ordered_json;

constexpr double kHangsAfter_ms = 2000.0;
// The machine is too slow if a role skips more than this share of its ticks within kLag_s, in at least kMinLagging_s
// different seconds. A single stall, as by a program that starts, is no reason.
constexpr double kMaxSkipped = 0.05;
constexpr std::int64_t kLag_s = 10;
constexpr int kMinLagging_s = 3;
constexpr double kMostSkipped = 0.5;  // above it one second less is enough, because stalls may last seconds
constexpr std::int64_t kLastMinute_ns = 60'000'000'000;

struct SetRole {
  const char* name;
  bool needed;  // the radar does not work without this role
};
constexpr std::array<SetRole, 7> kSetRoles{{{"state-machine", true},
                                            {"radar-model", true},
                                            {"flight-model", false},
                                            {"input-monitor", false},
                                            {"radar-display", false},
                                            {"recorder", false},
                                            {"gateway", false}}};

// Index in kSetRoles; kSetRoles.size() for another process.
std::size_t set_index(std::string_view name) {
  return static_cast<std::size_t>(
      std::ranges::find(kSetRoles, name, [](const SetRole& role) { return std::string_view(role.name); }) -
      kSetRoles.begin());
}

ordered_json role_json(const ProcessInfo& process, std::int64_t now_ns) {
  const double heartbeat_ms = static_cast<double>(now_ns - process.heartbeat_ns) * 1e-6;
  // Other processes need not send heartbeats.
  const bool hangs = set_index(process.name) < kSetRoles.size() && heartbeat_ms > kHangsAfter_ms;
  return {{"name", process.name}, {"pid", process.pid}, {"heartbeat_ms", heartbeat_ms}, {"hangs", hangs}};
}

// True if the role runs, on this host or another one.
bool runs(const ordered_json& role) {
  return role["pid"] != 0 || !role["host"].is_null();
}

// True if a gateway has died that kept roles for other hosts, and nobody has taken them since.
bool misses_gateway(const Session& session) {
  if (session.role_is_held(Role::gateway)) return false;
  return std::ranges::any_of(std::array{Role::radar_model, Role::state_machine},
                             [&](auto role) { return session.is_mirrored(role) && !session.role_is_held(role); });
}

// Restarts have counters in the segment, because the flight recorder keeps only its last 1,000 lines.
void add_restarts(ordered_json& role, const Session& session, std::int64_t now_ns) {
  const auto index = counted_role(role["name"].get<std::string>());
  const RecentCount none{};
  const auto& restarts = index ? session.layout().counters.restarts[*index] : none;
  role["restarts"] = restarts.count.load();
  role["restarts_last_minute"] = restarts.within(kLastMinute_ns, now_ns);
}

void add_role_reasons(const ordered_json& roles, std::vector<std::string>& reasons) {
  for (const auto& role : roles) {
    const auto name = role["name"].get<std::string>();
    if (!runs(role)) reasons.push_back(name + " is not running");
    if (role["hangs"].get<bool>())
      reasons.push_back((name == "radar-display" ? "the display" : name) + " hangs (heartbeat " +
                        std::to_string(static_cast<int>(role["heartbeat_ms"].get<double>() / 1000.0)) + " s old)");
    const int restarts = role["restarts_last_minute"];
    if (restarts == 0) continue;
    reasons.push_back(name + " was started again " + (restarts == 1 ? "once" : std::to_string(restarts) + " times") +
                      " in the last minute");
  }
}

// What a user can do for a role that is too slow at a clock of this rate.
std::string remedy_of_lag(const std::string& role, double rate) {
  std::string remedy;
  if (rate > 1.0) remedy = "let time run slower (yars sim rate 1), ";
  if (role == "radar-model") remedy += "choose a lower fidelity (( Fidelity :preset draft ) or :automatic true), ";
  if (role == "radar-display") remedy += "make the display smaller (--size), ";
  return remedy + (remedy.empty() ? "" : "or ") + "end other programs";
}

std::string reason_of_lag(const std::string& role, double share, double rate) {
  const std::string time = std::to_string(std::lround(100.0 * share)) + " % of ";
  const std::string found = role == "radar-display" ? "pictures of the display took longer than they may in " + time
                                                    : role + " skipped " + time + "its ticks in ";
  return "too slow: " + found + "the last " + std::to_string(kLag_s) + " s; " + remedy_of_lag(role, rate);
}

void add_lag_reasons(const ordered_json& status, std::vector<std::string>& reasons) {
  for (const auto& [role, lag] : status["lag"].items()) {
    const double share = lag["share"];
    if (share <= kMaxSkipped || lag["seconds"] < (share > kMostSkipped ? kMinLagging_s - 1 : kMinLagging_s)) continue;
    reasons.push_back(reason_of_lag(role, share, status["watch"]["rate"]));
  }
}

bool runs(const ordered_json& roles, std::string_view name) {
  return std::ranges::any_of(roles, [name](const auto& role) { return role["name"] == name && runs(role); });
}

void add_radar_reasons(const ordered_json& status, std::vector<std::string>& reasons) {
  const auto& watch = status["watch"];
  const auto& model = status["model"];
  if (runs(status["roles"], "state-machine") && watch["power"] == "OFF")
    reasons.emplace_back("the radar is off: yars inject 'power opr' switches it on");
  // Without a running model, its status in the segment is out of date.
  if (!runs(status["roles"], "radar-model")) return;
  if (watch["ownship"].is_null())
    reasons.push_back(status["ownship_lanes"].empty() ? "no ownship: no source runs"
                                                      : "no ownship: its source is silent");
  else if (model["terrain_bytes"] == 0 && watch["power"] == "OPR" && watch["sweeps"] > 0)
    reasons.emplace_back("terrain missing: none is loaded at the aircraft's position");
}

// Adds reasons about a damaged clock, input sources that have died, and refused records (records that fail validation).
// One refused record may be an accident. kManyRefusals within 10 s mean a faulty writer.
void add_input_reasons(const ordered_json& status, std::vector<std::string>& reasons) {
  constexpr int kManyRefusals = 3;
  if (!status["clock_problem"].is_null())
    reasons.push_back("the session's clock is damaged (" + status["clock_problem"].get<std::string>() +
                      "): yars sim reset sets it");
  const auto& input = status["input"];
  if (input["sources"] == 0 && input["missing"] > 0) reasons.emplace_back("no input: all senders of events have died");
  const auto& refusals = status["refusals"];
  if (refusals["last_10_s"] < kManyRefusals) return;
  const std::string newest = refusals["newest"].is_null() ? "" : ": " + refusals["newest"].get<std::string>();
  reasons.push_back("records are being refused" + newest);
}

}  // namespace

ordered_json roles_json(const Session& session, const ordered_json& network) {
  const std::int64_t now_ns = monotonic_ns();
  const auto processes = session.processes();
  ordered_json roles = ordered_json::array();
  // First the roles in the order of kSetRoles, then other processes.
  for (std::size_t index = 0; index <= kSetRoles.size(); ++index) {
    bool found = false;
    for (const auto& process : processes) {
      if (set_index(process.name) != index) continue;
      roles.push_back(role_json(process, now_ns));
      found = true;
    }
    const bool is_needed = index < kSetRoles.size() &&
                           (kSetRoles[index].needed || (set_index("gateway") == index && misses_gateway(session)));
    if (!found && is_needed)
      roles.push_back({{"name", kSetRoles[index].name}, {"pid", 0}, {"heartbeat_ms", nullptr}, {"hangs", false}});
  }
  add_hosts(roles, network, session);
  for (auto& role : roles) add_restarts(role, session, now_ns);
  return roles;
}

ordered_json lag_json(const Session& session) {
  ordered_json lags = ordered_json::object();
  const ClockState clock = session.clock();
  if (clock.running == 0 || !(clock.rate > 0.0)) return lags;
  const std::int64_t now_ns = monotonic_ns();
  for (std::size_t role = 0; role < kLockstepRoles; ++role) {
    const auto lag = session.layout().skipped_ticks[role].within(kLag_s, now_ns);
    if (lag.ticks == 0) continue;
    // A late picture of the display counts by real time.
    const bool is_display = role == static_cast<std::size_t>(LockstepRole::radar_display);
    const double due = static_cast<double>(kLag_s) * 1e9 / static_cast<double>(radar::kTickNanoseconds) *
                       (is_display ? 1.0 : clock.rate);
    lags[std::string(kLockstepRoleNames[role])] = {{"skipped", lag.ticks},
                                                   {"share", std::min(1.0, static_cast<double>(lag.ticks) / due)},
                                                   {"seconds", lag.seconds}};
  }
  return lags;
}

ordered_json health_json(const ordered_json& status) {
  const auto& roles = status["roles"];
  if (std::ranges::none_of(roles, [](const auto& role) { return role["pid"] != 0; }))
    return {{"state", "NOTHING RUNS"}, {"reasons", {"the session exists, but no program takes part"}}};
  std::vector<std::string> reasons;
  add_role_reasons(roles, reasons);
  add_network_reasons(status["network"], reasons);
  add_lag_reasons(status, reasons);
  add_radar_reasons(status, reasons);
  if (const auto& recorder = status["recorder"]; !recorder.is_null() && !recorder["problem"].is_null())
    reasons.push_back("the recorder does not write: " + recorder["problem"].get<std::string>());
  if (status["frames_failing"].get<bool>() && runs(roles, "radar-display"))
    reasons.emplace_back("the display cannot write its frames: see its log");
  add_input_reasons(status, reasons);
  if (!status["named"].get<bool>())
    reasons.emplace_back(
        "the segment's name was removed from /dev/shm (systemd's RemoveIPC?); the running set continues without it");
  return {{"state", reasons.empty() ? "OK" : "DEGRADED"}, {"reasons", reasons}};
}

namespace {

using nlohmann::ordered_json;

constexpr std::array<const char*, kNoteKinds> kNoteNames{"restart", "refusal", "loss", "late tick", "supervision"};

std::vector<Note> notes_of(const SessionLayout& layout) {
  std::vector<Note> notes;
  const std::uint64_t total = layout.notes.total();
  Note note{};
  for (std::uint64_t i = total > kNotes ? total - kNotes : 0; i < total; ++i)
    if (layout.notes.read(i, note)) {
      // Limits a damaged time stamp to the time between boot (0) and now.
      note.monotonic_ns = std::clamp<std::int64_t>(note.monotonic_ns, 0, monotonic_ns());
      notes.push_back(note);
    }
  return notes;
}

const char* note_name(std::uint32_t kind) {
  return kind < kNoteNames.size() ? kNoteNames[kind] : "?";
}

// Ownship lanes with a running source. A source that has ended leaves its last record in the lane; such lanes are left
// out.
ordered_json lanes_json(const Session& session) {
  const SessionLayout& layout = session.layout();
  ordered_json lanes = ordered_json::array();
  for (std::size_t i = 0; i < kOwnshipLanes; ++i) {
    const auto own = read_valid(layout.ownship[i]);
    if (!own || !session.ownship_lane_is_held(i)) continue;
    lanes.push_back({{"lane", i},
                     {"source", name_of_source(*own, static_cast<std::uint32_t>(i))},
                     {"priority", layout.ownship_priority[i].load()},
                     {"records", layout.ownship[i].version()}});
  }
  return lanes;
}

// Status of the recorder; null if no recorder runs or its status fails validation.
ordered_json recorder_json(const Session& session) {
  const auto status = read_valid(session.layout().recorder_status);
  if (!status || !session.role_is_held(Role::recorder)) return nullptr;
  const std::string problem(text::text_of(status->problem));
  return {{"writing", status->writing != 0},
          {"bytes", status->bytes},
          {"problem", problem.empty() ? ordered_json(nullptr) : ordered_json(problem)}};
}

// Frames are images of the display. pid of the process that publishes them (null: none), and id and size of the newest.
// Null if no process publishes frames and none has done so before.
ordered_json frames_json(const Session& session) {
  const std::int32_t publisher = session.role_holder(Role::glass_frames);
  GlassFrame newest{};
  std::vector<std::uint8_t> pixels;
  if (!read_newest_frame(session.layout(), 0, newest, pixels) || validate(newest)) newest = {};
  if (publisher == 0 && newest.id == 0) return nullptr;
  return {{"publisher", publisher == 0 ? ordered_json(nullptr) : ordered_json(publisher)},
          {"newest", newest.id},
          {"width", newest.width},
          {"height", newest.height}};
}

// Traffic: ships and vehicles that another program sends. pid of that program, and number of ships and vehicles. Null
// if no process publishes traffic.
ordered_json traffic_json(const Session& session) {
  const std::int32_t holder = session.role_holder(Role::traffic);
  if (holder == 0) return nullptr;
  const auto newest = read_valid(session.layout().traffic).value_or(Traffic{});
  return {{"holder", holder}, {"entities", newest.count}};
}

// `sources`: number of running input sources. `missing`: sources that ended without closing their lane.
ordered_json input_json(const Session& session) {
  const std::uint64_t known = session.layout().counters.input_sources.load();
  std::uint64_t held = 0, missing = 0;
  for (std::size_t lane = 0; lane < kInputLanes; ++lane) {
    const bool here = session.input_lane_is_held(lane);
    held += here ? 1 : 0;
    missing += !here && (known >> lane & 1U) != 0 ? 1 : 0;
  }
  return {{"sources", held}, {"missing", missing}};
}

ordered_json refusals_json(const Session& session, const std::vector<Note>& notes) {
  constexpr std::int64_t kRecently_ns = 10'000'000'000;
  const auto newest =
      std::ranges::find(notes.rbegin(), notes.rend(), static_cast<std::uint32_t>(NoteKind::refusal), &Note::kind);
  const auto& refusals = session.layout().counters.refusals;
  return {{"last_10_s", refusals.within(kRecently_ns, monotonic_ns())},
          {"newest", newest == notes.rend() ? ordered_json(nullptr) : ordered_json(text::text_of(newest->text))}};
}

}  // namespace

ordered_json status_json(const Session& session, const std::string& name) {
  const auto model = read_valid(session.layout().model_status).value_or(ModelStatus{});
  ordered_json object;
  object["session"] = name;
  object["watch"] = watch_object(session);
  object["model"] = {{"fidelity", text::text_of(model.fidelity)},
                     {"load", model.load},
                     {"scan", model.scan},
                     {"terrain_bytes", model.terrain_bytes},
                     {"posts_pending", model.posts_pending}};
  object["recorder"] = recorder_json(session);
  object["glass_frames"] = frames_json(session);
  object["traffic"] = traffic_json(session);
  object["ownship_lanes"] = lanes_json(session);
  ordered_json counts = ordered_json::object();
  for (std::size_t kind = 0; kind < kNoteKinds; ++kind)
    counts[kNoteNames[kind]] = session.layout().note_counts[kind].load();
  object["note_counts"] = counts;
  object["notes_folded"] = session.layout().counters.notes_folded.load();
  const std::int64_t now_ns = monotonic_ns();
  const std::vector<Note> lines = notes_of(session.layout());
  ordered_json notes = ordered_json::array();
  for (const auto& note : lines)
    notes.push_back({{"sim_time", static_cast<double>(note.sim_time_ns) * 1e-9},
                     {"age_s", static_cast<double>(now_ns - note.monotonic_ns) * 1e-9},
                     {"process", text::text_of(note.process)},
                     {"pid", note.pid},
                     {"kind", note_name(note.kind)},
                     {"text", text::text_of(note.text)}});
  object["notes"] = notes;
  object["named"] = session.has_name();
  object["network"] = network_json(session);
  object["roles"] = roles_json(session, object["network"]);
  object["input"] = input_json(session);
  object["refusals"] = refusals_json(session, lines);
  object["frames_failing"] = session.layout().counters.frames_failing.load() != 0;
  const auto problem = session.clock_problem();
  object["clock_problem"] = problem ? ordered_json(*problem) : ordered_json(nullptr);
  object["lag"] = lag_json(session);
  object["health"] = health_json(object);
  return object;
}

}  // namespace yars::databuffer
