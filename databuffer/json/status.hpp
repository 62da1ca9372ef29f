// Status of a session: who takes part, what the radar does, and whether all is well.
// Inputs: a session, read only. A record that fails validation counts as absent.
// Outputs: Status, from which `yars status` and the pages write text and JSON.
// Units: as the suffix of each name says; ages by CLOCK_MONOTONIC.
// Source: docs/commands.md#status, docs/network.md.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "databuffer/session/session.hpp"
#include "databuffer/session/session_layout.hpp"

namespace yars::databuffer {

// An entry of the process table, or a needed role that does not run.
struct RoleStatus {
  std::string name;
  std::int32_t pid = 0;                // 0: not running here. Of a role of another host: the gateway's
  std::optional<double> heartbeat_ms{};  // age of the last heartbeat; nullopt: not running here
  bool hangs = false;                  // a role of a set whose heartbeat is older than 2 s
  std::optional<std::string> host{};     // where it runs; nullopt: nowhere, or no gateway runs
  std::uint64_t restarts = 0;          // by the supervisor
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

// Ticks that a role has skipped in the last 10 s.
struct RoleLag {
  std::string_view role;
  std::uint64_t skipped = 0;
  double share = 0.0;         // of the ticks that were due
  std::uint32_t seconds = 0;  // in which ticks were skipped
};

struct LaneStatus {  // an ownship lane with a running source
  std::size_t lane = 0;
  std::string source;
  std::uint32_t priority = 0;
  std::uint64_t records = 0;
};

struct FrameStatus {  // frames that a display publishes
  std::int32_t publisher = 0;  // pid; 0: nobody now
  GlassFrame newest{};
};

struct TrafficSource {
  std::int32_t pid = 0;
  std::uint32_t entities = 0;
};

enum class Verdict : std::uint8_t { ok, degraded, nothing_runs };
std::string_view name_of(Verdict verdict);  // "OK", "DEGRADED", "NOTHING RUNS"

struct Health {
  Verdict verdict = Verdict::ok;
  std::vector<std::string> reasons;  // sentences, with what to do; empty: OK
};

// What `yars watch` shows: the newest valid records, else their defaults.
struct Watch {
  ClockState clock{};
  std::int64_t sim_time_ns = 0;
  RadarState radar{};
  ModelStatus model{};
  Outputs outputs{};
  PilotAdvice advice{};
  std::optional<double> map_timer_s;
  std::optional<Caption> caption;  // of the tour that runs
  std::uint64_t lost = 0, refused = 0;
  std::vector<ProcessInfo> processes;
  std::int64_t monotonic_ns = 0;  // when it was read

  bool has_ownship() const { return (model.flags & kModelStale) == 0U; }
};
Watch watch_of(const Session& session);

struct Status {
  std::string session;
  Watch watch;
  std::vector<RoleStatus> roles;  // those of a set first
  std::optional<NetworkSummary> network;
  std::vector<RoleLag> lags;
  std::vector<LaneStatus> ownship_lanes;
  std::optional<RecorderStatus> recorder;  // nullopt: none runs
  std::optional<FrameStatus> frames;       // nullopt: none was ever published
  std::optional<TrafficSource> traffic;    // nullopt: none
  std::uint64_t input_sources = 0;         // that run
  std::uint64_t input_missing = 0;         // that ended without closing their lane
  std::uint64_t refusals_last_10_s = 0;
  std::array<std::uint64_t, kNoteKinds> note_counts{};
  std::uint64_t notes_folded = 0;
  std::vector<Note> notes;                   // of the flight recorder, oldest first
  std::optional<std::string> clock_problem;  // nullopt: the clock is valid
  bool named = true;                         // false: the segment's name was removed
  bool frames_failing = false;               // the display cannot write its frames
  Health health;

  // The role runs, on this host or another one.
  bool runs(std::string_view role) const;
  const Note* newest_refusal() const;  // null: none
};
// `name`: of the session.
Status status_of(const Session& session, const std::string& name);

// Word for a kind of note, such as "late tick"; "?" for an unknown one.
const char* note_name(std::uint32_t kind);

}  // namespace yars::databuffer
