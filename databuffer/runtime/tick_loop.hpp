// The beat of a role: one call a tick of 5 ms sim time. Live, it sleeps until a tick is due, catches up at most
// kMaxTicksBehind late ticks and skips the rest. In lockstep it waits until the role before it in the chain
// (flight-model, input-monitor, state-machine, radar-model, radar-display, recorder, round again) has done its part.
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

inline constexpr std::int64_t kMaxTicksBehind = 20;  // [ticks] 0.1 s: more would make a hiccup visible as a burst

class TickLoop {
 public:
  // `lockstep` is the program's option; empty = live.
  static error::Expected<TickLoop> create(Session& session, LockstepRole role, const std::string& lockstep);

  struct Due {
    std::int64_t tick = 0;         // index of the tick to do: sim time / 5 ms
    std::int64_t sim_time_ns = 0;  // [ns] of that tick
    ClockState clock{};
    std::uint64_t skipped = 0;  // ticks given up since the call before
    bool new_epoch = false;     // the clock's epoch differs from the call before
  };
  // Waits; nullopt = stop was requested, the last tick of a lockstep run is done, or a lockstep partner is gone
  // (then outcome() says so). While the clock is frozen it returns only for a new epoch.
  std::optional<Due> wait();
  // Must follow each wait() that gave a tick, once all its outputs are published.
  void done(const Due& due);

  bool lockstep() const { return lockstep_; }
  // What ended a lockstep run before its last tick; nothing after a clean end.
  error::Expected<void> outcome() const;
  std::uint64_t late_ticks() const { return late_ticks_; }  // skipped since the start

 private:
  TickLoop(Session& session, LockstepRole role) : session_(&session), role_(static_cast<std::size_t>(role)) {}
  std::optional<Due> wait_live();
  std::optional<Due> wait_lockstep();
  // False: stop was requested, or that role was silent for too long.
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
