// Tick loop of a role (one program of a session). wait() returns once per tick of 5 ms sim time.
// Live (not lockstep): wait() sleeps until a tick is due. At most kMaxTicksBehind late ticks are caught up; older ones
// are skipped and counted.
// Lockstep: wait() returns when the preceding role has finished the tick. Order of the roles: flight-model,
// input-monitor, state-machine, radar-model, radar-display, recorder; then the next tick begins.
// Inputs: the session clock; the option --lockstep.
// Errors: --lockstep differs from the plan of the session, or is missing in a lockstep session; another role does not
// finish its tick in 60 s, or its host has been gone for 10 s (outcome()).
// Threads: one thread per object.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "databuffer/session/session.hpp"
#include "lib/error/error.hpp"

namespace yars::runtime {

// [ticks] Maximum number of late ticks that are caught up, 0.1 s. With a larger value a stall would end in a longer
// burst of late ticks. With a smaller value short stalls would skip ticks.
inline constexpr std::int64_t kMaxTicksBehind = 20;

// Marks a tick of a lockstep run as done by a role, and wakes the roles that wait for it. `role`: index of
// kLockstepRoleNames.
void complete_tick(databuffer::Lockstep& lockstep, std::size_t role, std::int64_t tick);

class TickLoop {
 public:
  // `lockstep`: value of --lockstep; empty: live.
  static error::Expected<TickLoop> create(databuffer::Session& session, databuffer::LockstepRole role,
                                          const std::string& lockstep);

  struct Due {
    std::int64_t tick = 0;         // index of the tick: sim time / 5 ms
    std::int64_t sim_time_ns = 0;  // [ns] sim time of the tick
    databuffer::ClockState clock{};
    std::uint64_t skipped = 0;  // ticks skipped since the previous call
    bool new_epoch = false;     // the epoch has changed since the previous call
  };
  // Waits for the next tick. nullopt: a stop was requested, the last tick of a lockstep run is done, or another role
  // of a lockstep run does not finish its tick (see outcome()). While the clock of a live session is frozen, a
  // tick is due only at the start, in a new epoch or after `yars sim step`.
  std::optional<Due> wait();
  // Must be called after each wait() that returned a tick, when all outputs of the tick are published.
  void done(const Due& due);

  bool lockstep() const { return lockstep_; }
  // Error if a lockstep run ended because another role did not finish its tick in 60 s, or because the gateway says
  // that the host of another role has been gone for 10 s (Network::lost_role); otherwise success.
  error::Expected<void> outcome() const;
  std::uint64_t late_ticks() const { return late_ticks_; }  // number of ticks skipped since the start

 private:
  TickLoop(databuffer::Session& session, databuffer::LockstepRole role)
      : session_(&session), role_(static_cast<std::size_t>(role)) {}
  std::optional<Due> wait_live();
  std::optional<Due> wait_lockstep();
  // Waits until `role` has finished `tick`. False: a stop was requested, 60 s have passed, or a host is gone.
  bool wait_for(std::size_t role, std::int64_t tick);
  void wait_for_all(std::int64_t tick);
  // True if the gateway says that the host of a role is gone which has ticks of this run to do. Notes role and host.
  bool finds_lost_role();
  Due due_at(const databuffer::ClockState& clock, std::int64_t newest);  // `newest`: tick of the present sim time

  databuffer::Session* session_;
  std::size_t role_;
  bool lockstep_ = false;
  bool failed_ = false;    // another role did not finish its tick
  std::string lost_host_;  // the host of awaited_role_, which is gone; empty: 60 s of silence
  bool started_ = false;
  std::size_t predecessor_ = 0;  // the role awaited in each tick
  bool first_in_chain_ = false;  // true: this role begins each tick, after its predecessor ended the previous tick
  std::size_t awaited_role_ = 0;
  std::int64_t awaited_tick_ = 0;
  std::int64_t next_tick_ = 0;
  std::uint32_t epoch_ = 0;
  std::uint64_t late_ticks_ = 0;
};

}  // namespace yars::runtime
