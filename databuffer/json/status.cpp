#include "databuffer/json/status.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/messages/shown_fields.hpp"
#include "databuffer/messages/validation.hpp"
#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/receivers.hpp"
#include "lib/radar/modes.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::databuffer {

namespace {

constexpr double kHangsAfter_ms = 2000.0;
// The machine is too slow if a role skips more than this share of its ticks within kLag_s, in at least kMinLagging_s
// different seconds. A single stall, as by a program that starts, is no reason.
constexpr double kMaxSkipped = 0.05;
constexpr std::int64_t kLag_s = 10;
constexpr std::uint32_t kMinLagging_s = 3;
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

RoleStatus role_of(const ProcessInfo& process, std::int64_t now_ns) {
  const double heartbeat_ms = static_cast<double>(now_ns - process.heartbeat_ns) * 1e-6;
  // Other processes need not send heartbeats.
  const bool hangs = set_index(process.name) < kSetRoles.size() && heartbeat_ms > kHangsAfter_ms;
  return {.name = process.name, .pid = process.pid, .heartbeat_ms = heartbeat_ms, .hangs = hangs};
}

// True if a gateway has died that kept roles for other hosts, and nobody has taken them since.
bool misses_gateway(const Session& session) {
  if (session.role_is_held(Role::gateway)) return false;
  return std::ranges::any_of(std::array{Role::radar_model, Role::state_machine},
                             [&](auto role) { return session.is_mirrored(role) && !session.role_is_held(role); });
}

// All entries of the process table, and the needed roles that do not run. The roles come first, in the order of
// kSetRoles, then other processes.
std::vector<RoleStatus> roles_of(const Session& session, const std::optional<NetworkSummary>& network) {
  const std::int64_t now_ns = monotonic_ns();
  const auto processes = session.processes();
  std::vector<RoleStatus> roles;
  for (std::size_t index = 0; index <= kSetRoles.size(); ++index) {
    bool found = false;
    for (const auto& process : processes) {
      if (set_index(process.name) != index) continue;
      roles.push_back(role_of(process, now_ns));
      found = true;
    }
    const bool is_needed = index < kSetRoles.size() &&
                           (kSetRoles[index].needed || (set_index("gateway") == index && misses_gateway(session)));
    if (!found && is_needed) roles.push_back({.name = kSetRoles[index].name});
  }
  add_hosts(roles, network, session);
  for (RoleStatus& role : roles) {
    // Restarts have counters in the segment, because the flight recorder keeps only its last 1,000 lines.
    const auto index = counted_role(role.name);
    if (!index) continue;
    const auto& restarts = session.layout().counters.restarts[*index];
    role.restarts = restarts.count.load();
    role.restarts_last_minute = static_cast<std::uint64_t>(restarts.within(kLastMinute_ns, now_ns));
  }
  return roles;
}

// Roles that skipped none, and a frozen clock's roles, are left out.
std::vector<RoleLag> lags_of(const Session& session) {
  std::vector<RoleLag> lags;
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
    lags.push_back({kLockstepRoleNames[role], static_cast<std::uint64_t>(lag.ticks),
                    std::min(1.0, static_cast<double>(lag.ticks) / due), static_cast<std::uint32_t>(lag.seconds)});
  }
  return lags;
}

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

// A source that has ended leaves its last record in the lane; such lanes are left out.
std::vector<LaneStatus> lanes_of(const Session& session) {
  const SessionLayout& layout = session.layout();
  std::vector<LaneStatus> lanes;
  for (std::size_t i = 0; i < kOwnshipLanes; ++i) {
    const auto own = read_valid(layout.ownship[i]);
    if (!own || !session.ownship_lane_is_held(i)) continue;
    lanes.push_back({i, name_of_source(*own, static_cast<std::uint32_t>(i)), layout.ownship_priority[i].load(),
                     layout.ownship[i].version()});
  }
  return lanes;
}

std::optional<FrameStatus> frames_of(const Session& session) {
  FrameStatus frames{session.role_holder(Role::glass_frames), {}};
  std::vector<std::uint8_t> pixels;
  if (!read_newest_frame(session.layout(), 0, frames.newest, pixels) || validate(frames.newest)) frames.newest = {};
  if (frames.publisher == 0 && frames.newest.id == 0) return std::nullopt;
  return frames;
}

void count_input(Status& status, const Session& session) {
  const std::uint64_t known = session.layout().counters.input_sources.load();
  for (std::size_t lane = 0; lane < kInputLanes; ++lane) {
    const bool here = session.input_lane_is_held(lane);
    status.input_sources += here ? 1 : 0;
    status.input_missing += !here && (known >> lane & 1U) != 0 ? 1 : 0;
  }
}

// Calls of shown_fields(), which exists for records that are in the status.
template <class Part>
std::vector<ShownField> fields_of(const Part& part) {
  if constexpr (requires { shown_fields(*read_valid(part)); })
    if (const auto record = read_valid(part)) return shown_fields(*record);
  return {};
}

std::vector<ShownRecord> records_of(const Session& session, const Status& status) {
  std::vector<ShownRecord> records;
  for_each_container([&](const Container& one, auto member) {
    if (one.status.empty()) return;
    records.push_back({one.status, {}});
    if (status.runs(one.writer)) records.back().fields = fields_of(session.layout().*member);
  });
  return records;
}

// ---- health

void add_role_reasons(const Status& status, std::vector<std::string>& reasons) {
  for (const RoleStatus& role : status.roles) {
    if (!role.runs()) reasons.push_back(role.name + " is not running");
    if (role.hangs)
      reasons.push_back((role.name == "radar-display" ? "the display" : role.name) + " hangs (heartbeat " +
                        std::to_string(static_cast<int>(role.heartbeat_ms.value_or(0.0) / 1000.0)) + " s old)");
    if (role.restarts_last_minute == 0) continue;
    reasons.push_back(role.name + " was started again " +
                      (role.restarts_last_minute == 1 ? "once" : std::to_string(role.restarts_last_minute) + " times") +
                      " in the last minute");
  }
}

// Remedy for a role that is too slow for the clock's rate.
std::string remedy_of_lag(std::string_view role, double rate) {
  std::string remedy;
  if (rate > 1.0) remedy = "let time run slower (yars sim rate 1), ";
  if (role == "radar-model") remedy += "choose a lower fidelity (( Fidelity :preset draft ) or :automatic true), ";
  if (role == "radar-display") remedy += "make the display smaller (--size), ";
  return remedy + (remedy.empty() ? "" : "or ") + "end other programs";
}

void add_lag_reasons(const Status& status, std::vector<std::string>& reasons) {
  for (const RoleLag& lag : status.lags) {
    if (lag.share <= kMaxSkipped || lag.seconds < (lag.share > kMostSkipped ? kMinLagging_s - 1 : kMinLagging_s))
      continue;
    const std::string time = std::to_string(std::lround(100.0 * lag.share)) + " % of ";
    const std::string found = lag.role == "radar-display"
                                  ? "pictures of the display took longer than they may in " + time
                                  : std::string(lag.role) + " skipped " + time + "its ticks in ";
    reasons.push_back("too slow: " + found + "the last " + std::to_string(kLag_s) + " s; " +
                      remedy_of_lag(lag.role, status.watch.clock.rate));
  }
}

void add_radar_reasons(const Status& status, std::vector<std::string>& reasons) {
  const auto power = static_cast<radar::Power>(status.watch.radar.power);
  if (status.runs("state-machine") && power == radar::Power::off)
    reasons.emplace_back("the radar is off: yars inject 'power opr' switches it on");
  // Without a running model, its status in the segment is out of date.
  if (!status.runs("radar-model")) return;
  const ModelStatus& model = status.watch.model;
  if (!status.watch.has_ownship())
    reasons.push_back(status.ownship_lanes.empty() ? "no ownship: no source runs" : "no ownship: its source is silent");
  else if (model.terrain_bytes == 0 && power == radar::Power::operate && model.sweeps > 0)
    reasons.emplace_back("terrain missing: none is loaded at the aircraft's position");
}

// A damaged clock, input sources that have died, and refused records (records that fail validation). One refused record
// may be an accident. kManyRefusals within 10 s mean a faulty writer.
void add_input_reasons(const Status& status, std::vector<std::string>& reasons) {
  constexpr std::uint64_t kManyRefusals = 3;
  if (status.clock_problem)
    reasons.push_back("the session's clock is damaged (" + *status.clock_problem + "): yars sim reset sets it");
  if (status.input_sources == 0 && status.input_missing > 0)
    reasons.emplace_back("no input: all senders of events have died");
  if (status.refusals_last_10_s < kManyRefusals) return;
  const Note* const newest = status.newest_refusal();
  reasons.push_back("records are being refused" +
                    (newest == nullptr ? std::string() : ": " + std::string(text::text_of(newest->text))));
}

Health health_of(const Status& status) {
  if (std::ranges::none_of(status.roles, [](const RoleStatus& role) { return role.pid != 0; }))
    return {Verdict::nothing_runs, {"the session exists, but no program takes part"}};
  std::vector<std::string> reasons;
  add_role_reasons(status, reasons);
  add_network_reasons(status.network, reasons);
  add_lag_reasons(status, reasons);
  add_radar_reasons(status, reasons);
  if (status.recorder && status.recorder->problem[0] != '\0')
    reasons.push_back("the recorder does not write: " + std::string(text::text_of(status.recorder->problem)));
  if (status.frames_failing && status.runs("radar-display"))
    reasons.emplace_back("the display cannot write its frames: see its log");
  add_input_reasons(status, reasons);
  if (!status.named)
    reasons.emplace_back(
        "the segment's name was removed from /dev/shm (systemd's RemoveIPC?); the running set continues without it");
  return {reasons.empty() ? Verdict::ok : Verdict::degraded, std::move(reasons)};
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  constexpr std::array<std::string_view, 3> kNames{"OK", "DEGRADED", "NOTHING RUNS"};
  return kNames[static_cast<std::size_t>(verdict)];
}

const char* note_name(std::uint32_t kind) {
  constexpr std::array<const char*, kNoteKinds> kNames{"restart", "refusal", "loss", "late tick", "supervision"};
  return kind < kNames.size() ? kNames[kind] : "?";
}

bool Status::runs(std::string_view role) const {
  return std::ranges::any_of(roles, [role](const RoleStatus& one) { return one.name == role && one.runs(); });
}

const Note* Status::newest_refusal() const {
  const auto newest =
      std::ranges::find(notes.rbegin(), notes.rend(), static_cast<std::uint32_t>(NoteKind::refusal), &Note::kind);
  return newest == notes.rend() ? nullptr : &*newest;
}

Watch watch_of(const Session& session) {
  const SessionLayout& layout = session.layout();
  Watch watch;
  watch.clock = session.clock();
  watch.sim_time_ns = session.reached_sim_time_ns();
  ModelStatus no_model{};
  no_model.map_timer_s = no_model.map_progress = std::nan("");
  no_model.flags = kModelStale;
  Outputs no_outputs{};
  no_outputs.slant_range_m = std::nan("");
  watch.radar = read_valid(layout.radar_state).value_or(RadarState{});
  watch.model = read_valid(layout.model_status).value_or(no_model);
  watch.outputs = read_valid(layout.outputs).value_or(no_outputs);
  watch.advice = read_valid(layout.advice).value_or(PilotAdvice{});
  watch.map_timer_s = map_timer_s(watch.radar, watch.model);
  watch.caption = read_valid(layout.caption);
  if (watch.caption && (watch.caption->step == 0 || !session.role_is_held(Role::tour))) watch.caption.reset();
  watch.lost = layout.note_counts[static_cast<std::size_t>(NoteKind::loss)].load();
  watch.refused = layout.note_counts[static_cast<std::size_t>(NoteKind::refusal)].load();
  watch.processes = session.processes();
  watch.monotonic_ns = monotonic_ns();
  return watch;
}

Status status_of(const Session& session, const std::string& name) {
  constexpr std::int64_t kRecently_ns = 10'000'000'000;
  const SessionLayout& layout = session.layout();
  Status status;
  status.session = name;
  status.watch = watch_of(session);
  if (session.role_is_held(Role::recorder)) status.recorder = read_valid(layout.recorder_status);
  status.frames = frames_of(session);
  if (const std::int32_t pid = session.role_holder(Role::traffic); pid != 0)
    status.traffic = TrafficSource{pid, read_valid(layout.traffic).value_or(Traffic{}).count};
  status.ownship_lanes = lanes_of(session);
  for (std::size_t kind = 0; kind < kNoteKinds; ++kind) status.note_counts[kind] = layout.note_counts[kind].load();
  status.notes_folded = layout.counters.notes_folded.load();
  status.notes = notes_of(layout);
  status.named = session.has_name();
  status.network = network_of(session);
  status.roles = roles_of(session, status.network);
  status.records = records_of(session, status);
  count_input(status, session);
  status.refusals_last_10_s =
      static_cast<std::uint64_t>(layout.counters.refusals.within(kRecently_ns, status.watch.monotonic_ns));
  status.frames_failing = layout.counters.frames_failing.load() != 0;
  status.clock_problem = session.clock_problem();
  status.lags = lags_of(session);
  status.health = health_of(status);
  return status;
}

}  // namespace yars::databuffer
