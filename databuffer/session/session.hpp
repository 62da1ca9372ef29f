// One session: the shared segment yars.UID.SESSION with its layout, and what a process may claim in it.
// Only shells (*_main.cpp, *_shell.*) use it.
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

// Whether to wait for who changes the clock just now: a tick may not.
enum class WaitPolicy { none, some };

struct ProcessHere {
  std::int32_t pid;
  std::string name;
  std::int64_t heartbeat_ns;  // CLOCK_MONOTONIC of the last heartbeat
  std::uint32_t progress;     // see ProcessEntry
};

class Session {
 public:
  // Attaches to the session, or creates it. `process_name` goes into the process table, for people.
  static error::Expected<Session> open(const std::string& name, std::string_view process_name);
  // For readers that come and go: maps read-only, is not in the process table, holds no lock. Claims and changes of
  // the clock are refused, heartbeats and notes go nowhere. Where the session has no good clock, time stands at 0.
  static error::Expected<Session> open_read_only(const std::string& name);

  bool created() const;   // this call made the session
  bool has_name() const;  // false: somebody removed the segment's file; the session goes on (docs/operation.md)
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();  // who leaves last unlinks the segment

  SessionLayout& layout();  // only of a session opened for writing
  const SessionLayout& layout() const;

  error::Expected<Claim> claim(Role role);                            // an error names the holder's pid and program
  error::Expected<Claim> claim_ownship_lane(std::uint32_t priority);  // higher wins; clears what a dead writer left
  error::Expected<Claim> claim_input_lane(std::string_view source);

  bool role_is_held(Role role) const;         // by any process, this one included
  std::int32_t role_holder(Role role) const;  // its pid; 0 = nobody holds it
  bool ownship_lane_is_held(std::size_t lane) const;
  bool input_lane_is_held(std::size_t lane) const;
  std::vector<ProcessHere> processes() const;  // who takes part, dead entries left out
  // How far this process has come; what it means is the role's (see ProcessEntry).
  void show_progress(std::uint32_t progress);
  // Shows in `yars status`; call about once a second or each tick (it is one store). Twice a second it writes its entry
  // in the process table anew where that was damaged, and looks whether the segment still has its name; it says so once
  // in log and flight recorder when it has not.
  void heartbeat();

  // Session clock: sim time [ns] of this moment; the state behind it. A state out of range is refused and noted, and
  // the last good one goes on. Who opens a session without a good one sets it to 0 in a new epoch.
  ClockState clock() const;
  std::int64_t sim_time_ns() const;
  // Why what lies in the segment is no clock; nothing when it is one.
  std::optional<std::string> clock_problem() const;
  // Publishes the last good clock again when what lies there is none; state-machine asks for it at each tick.
  void keep_clock(WaitPolicy patience = WaitPolicy::none);
  // Takes the clock's byte for the moment of the change, so that of two changes at once none is lost. A state out of
  // range is an error and changes nothing.
  error::Expected<void> change_clock(const std::function<ClockState(const ClockState&)>& change,
                                     WaitPolicy patience = WaitPolicy::some);
  error::Expected<void> set_clock(const ClockState& state);

  // A line into the flight recorder (also counted): refusals, restarts, losses, late ticks. Of lines of one kind
  // (RepeatFilter) three pass within 10 s, the rest are counted and told in one line by heartbeat().
  void note(NoteKind kind, std::string_view text);
  void note(NoteKind kind, std::string_view text, std::string_view process);  // about another process
  // For the supervisor: the role was started again; `role` a name as in a lockstep plan, others are not counted.
  void count_restart(std::string_view role);

 private:
  explicit Session(std::unique_ptr<SessionState> state);
  std::unique_ptr<SessionState> state_;
};

// A session's name is part of a path: 1 to 40 letters, digits, `-` or `_`. An error of bad usage.
error::Expected<void> check_session_name(const std::string& name);
// Index of a role in Counters::restarts, by its name in the process table; nothing for a name that is none.
std::optional<std::size_t> counted_role(std::string_view name);

}  // namespace yars::databuffer
