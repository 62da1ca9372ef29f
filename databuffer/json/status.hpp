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

#include "databuffer/json/participants.hpp"
#include "databuffer/messages/shown_field.hpp"
#include "databuffer/session/session.hpp"
#include "databuffer/session/session_layout.hpp"

namespace yars::databuffer {

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

struct FrameStatus {           // frames that a display publishes
  std::int32_t publisher = 0;  // pid; 0: nobody now
  GlassFrame newest{};
};

struct TrafficSource {
  std::int32_t pid = 0;
  std::uint32_t entities = 0;
};

enum class Verdict : std::uint8_t { ok, degraded, nothing_runs };
std::string_view name_of(Verdict verdict);  // "OK", "DEGRADED", "NOTHING RUNS"

struct ShownRecord {  // a container with @status in segment.idl
  std::string_view name;
  std::vector<ShownField> fields;  // empty: its writer does not run, or has published no valid record
};

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
  std::vector<ShownRecord> records;
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
