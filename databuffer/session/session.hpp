// Session: the shared segment yars.UID.SESSION with its layout, claims, clock, process table and flight recorder.
// Inputs: name of the session; records to publish through layout(); notes.
// Outputs: the mapped layout, sim time [ns], claims (exclusive rights) on roles and lanes.
// Errors: a segment of another build or user; a role or lane that another process has claimed; a clock out of range.
// Threads: clock() and note() may be called from any thread of the process; all other functions from one thread.
// Only shells (folders in SHELLS of scripts/check_layers.py) use a Session; kernels do not.
// Source: docs/shared_memory.md.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "databuffer/session/session_layout.hpp"
#include "databuffer/session/session_state.hpp"
#include "lib/error/error.hpp"

namespace yars::databuffer {

// Waiting time while another process changes the clock. none: 0, for use in a tick. some: at most 0.2 s.
enum class WaitPolicy { none, some };

struct ProcessInfo {
  std::int32_t pid;
  std::string name;
  std::int64_t heartbeat_ns;  // CLOCK_MONOTONIC of the last heartbeat
  std::uint32_t progress;     // see ProcessEntry
};

class Session {
 public:
  // Attaches to the session, or creates it. `process_name` is shown in the process table.
  static error::Expected<Session> open(const std::string& name, std::string_view process_name);
  // Attaches read-only: no entry in the process table, no lock. Claims and changes of the clock are refused; heartbeats
  // and notes have no effect. If the session has no valid clock, time stands at 0.
  static error::Expected<Session> open_read_only(const std::string& name);

  bool has_name() const;  // false: the segment's file was unlinked; the session continues (docs/operation.md)
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();  // the last participant unlinks the segment

  SessionLayout& layout();  // requires a session opened for writing
  const SessionLayout& layout() const;

  error::Expected<Claim> claim(Role role);                            // an error names the holder's pid and program
  error::Expected<Claim> claim_ownship_lane(std::uint32_t priority);  // the greatest priority wins; clears old records
  error::Expected<Claim> claim_input_lane(std::string_view source);

  bool role_is_held(Role role) const;         // true if this or another process holds the role
  std::int32_t role_holder(Role role) const;  // pid of the holder; 0: none
  // True if another host of the session holds the role and its holder here must release it. False without a gateway.
  bool must_yield(Role role) const;
  // True if this host's gateway holds the role for another host, or held it when the gateway died.
  bool is_mirrored(Role role) const;
  bool ownship_lane_is_held(std::size_t lane) const;
  bool input_lane_is_held(std::size_t lane) const;
  std::vector<ProcessInfo> processes() const;  // entries of the process table whose process is alive
  // Publishes a progress number. Its meaning depends on the role (see ProcessEntry).
  void publish_progress(std::uint32_t progress);
  // Updates the heartbeat shown by `yars status`. Call it each tick or about once a second. Most calls are one store.
  // Twice a second a call also rewrites this process's table entry, and checks that the segment's file still has its
  // name. The loss of the name is reported once, in the log and the flight recorder.
  void heartbeat();

  // Clock of the session, and sim time [ns] now. A clock out of range is refused and noted, and the last valid one
  // stays in use. A process that opens a session without a valid clock sets the clock to 0 in a new epoch.
  ClockState clock() const;
  std::int64_t sim_time_ns() const;
  // [ns] Sim time up to which the session has come: in lockstep that of the last tick that all roles of the run have
  // done, 0 before the first; else sim_time_ns().
  std::int64_t reached_sim_time_ns() const;
  // True if CLOCK_MONOTONIC of this process differs by more than 1 s from that of state-machine (of radar-model if no
  // state-machine runs). A Linux time namespace, as of a container, has this effect. A session clock that this process
  // sets would then be wrong. False also if the difference is unknown: neither role runs in another process, or the
  // role's heartbeat stands still. Waits at most 0.2 s.
  bool has_foreign_clock() const;
  // Reason why the clock in the segment is invalid; nullopt: the clock is valid. A clock with a base time more than 1 s
  // in the future is invalid.
  std::optional<std::string> clock_problem() const;
  // Publishes the last valid clock again if the clock in the segment is invalid. state-machine calls it at each tick.
  void restore_clock(WaitPolicy policy = WaitPolicy::none);
  // Replaces the clock by change(clock) while holding its lock byte, so that no simultaneous change is lost. A result
  // out of range is an error; the clock then stays as it was.
  error::Expected<void> change_clock(const std::function<ClockState(const ClockState&)>& change,
                                     WaitPolicy policy = WaitPolicy::some);

  // Appends a line to the flight recorder and counts it. Within 10 s a process writes at most three similar lines and
  // 20 lines of one note kind (log::RepeatFilter). After these 10 s, heartbeat() writes one line for each group of
  // suppressed lines, with their number.
  void note(NoteKind kind, std::string_view text);
  void note(NoteKind kind, std::string_view text, std::string_view process);  // about another process
  // Counts a restart by the supervisor. `role`: gateway or one of kLockstepRoleNames; other names are not counted.
  void count_restart(std::string_view role);

 private:
  explicit Session(std::unique_ptr<SessionState> state);
  std::unique_ptr<SessionState> state_;
};

// Index of a role in Counters::restarts, by its name in the process table; nullopt for other names.
std::optional<std::size_t> counted_role(std::string_view name);

}  // namespace yars::databuffer
