// Changes of the session's clock that users ask for: run, freeze, rate, step, reset, reposition. For
// Session::change_clock().
// Inputs: the clock before. Outputs: the clock after, with the present time as its base.
// Threads: any; functions without state. They read CLOCK_MONOTONIC.
// Source: docs/commands.md#sim.
#pragma once

#include <cstdint>
#include <optional>

#include "databuffer/messages/clock_limits.hpp"
#include "databuffer/messages/world_state.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::databuffer {

// Ticks by which a step advances the clock at once. At most kMaxTicksBehind (20): programs skip ticks that are further
// behind the clock.
inline constexpr std::int64_t kStepPortion_ticks = 10;
// [ms] Time that programs need to run the ticks of a portion, and the first tick of an epoch.
inline constexpr int kPortionTime_ms = 30;

// The clock with its base moved to the CLOCK_MONOTONIC time `base_ns`; sim time does not change.
ClockState rebased(ClockState clock, std::int64_t base_ns);
ClockState with_running(const ClockState& clock, bool running);
ClockState with_rate(const ClockState& clock, double rate);
// Freezes and advances by at most kStepPortion_ticks. From any time within a tick, the first step leads to the start
// of the next tick.
ClockState stepped(const ClockState& clock, std::int64_t ticks);
// Begins an epoch at sim time `time_s`, rounded to a whole tick, because a replay shows the picture of that tick.
ClockState reset_to(const ClockState& clock, double time_s);

struct Repositioning {
  geo::GeoPoint position;
  geo::AltitudeMsl altitude;
  geo::Bearing heading;
  std::optional<geo::Speed> ground_speed{};  // the aircraft then flies straight and level; nullopt: its source chooses
};
// Begins an epoch with the aircraft at another position.
ClockState repositioned(const ClockState& clock, const Repositioning& to);

// Notes in a clock whose epoch begins at the position of the aircraft, which no user asked for. A speed of an earlier
// repositioning ends.
void begin_at_aircraft(ClockState& clock, const Ownship& ownship, geo::Bearing heading);

// A frozen clock advanced by one tick, kPortionTime_ms after a new epoch has begun. The programs run the first tick of
// an epoch in no defined order. From the second tick on, each reads the other programs' records of the new epoch.
ClockState after_first_tick(const ClockState& clock);

}  // namespace yars::databuffer
