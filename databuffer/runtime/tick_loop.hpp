// Tick loop of a role: one call for each tick of 5 ms sim time.
// Live: sleeps until a tick is due, catches up at most kMaxTicksBehind late ticks, skips the rest and counts them.
// Lockstep: waits until the preceding role of the chain has done its part. The chain is flight-model, input-monitor,
// state-machine, radar-model, radar-display, recorder, and round again.
// Inputs: the session clock; --lockstep.
// Errors: a plan that differs from the session's; a lockstep partner silent for 60 s (outcome()).
// Threads: the ticking thread only.
#pragma once

#include <cstdint>
#include <optional>

#include "databuffer/session/session.hpp"
#include "lib/error/error.hpp"

namespace yars::databuffer {

enum class LockstepRole : std::uint8_t {
  flight_model = 0,
  input_monitor = 1,
  state_machine = 2,
  radar_model = 3,
  radar_display = 4,
  recorder = 5
};

inline constexpr std::int64_t kMaxTicksBehind = 20;  // [ticks] 0.1 s: more makes a hiccup visible as a burst

class TickLoop {
 public:
  // `lockstep`: the program's option; empty: live.
  static error::Expected<TickLoop> create(Session& session, LockstepRole role, const std::string& lockstep);

  struct Due {
    std::int64_t tick = 0;         // index of the tick: sim time / 5 ms
    std::int64_t sim_time_ns = 0;  // [ns] of that tick
    ClockState clock{};
    std::uint64_t skipped = 0;  // ticks skipped since the previous call
    bool new_epoch = false;     // the epoch differs from that of the previous call
  };
  // Waits for the next tick. nullopt: a stop was requested, the last tick of a lockstep run is done, or a lockstep
  // partner is silent (see outcome()). While the clock is frozen only the first tick or a new epoch returns.
  std::optional<Due> wait();
  // Must follow each wait() that returned a tick, once all outputs are published.
  void done(const Due& due);

  bool lockstep() const { return lockstep_; }
  // Reason why a lockstep run ended before its last tick; success after a clean end.
  error::Expected<void> outcome() const;
  std::uint64_t late_ticks() const { return late_ticks_; }  // skipped since the start

 private:
  TickLoop(Session& session, LockstepRole role) : session_(&session), role_(static_cast<std::size_t>(role)) {}
  std::optional<Due> wait_live();
  std::optional<Due> wait_lockstep();
  // False: a stop was requested, or that role was silent for too long.
  bool wait_for(std::size_t role, std::int64_t tick);
  void wait_for_all(std::int64_t tick);
  Due due_at(const ClockState& clock, std::int64_t newest);

  Session* session_;
  std::size_t role_;
  bool lockstep_ = false;
  bool failed_ = false;  // a partner was silent for too long
  bool started_ = false;
  std::size_t predecessor_ = 0;
  bool first_in_chain_ = false;
  std::size_t awaited_role_ = 0;
  std::int64_t awaited_tick_ = 0;
  std::int64_t next_tick_ = 0;
  std::uint32_t epoch_ = 0;
  std::uint64_t late_ticks_ = 0;
};

}  // namespace yars::databuffer
