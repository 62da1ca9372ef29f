#include "databuffer/session/clock_changes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "databuffer/session/session_state.hpp"
#include "lib/radar/modes.hpp"

namespace yars::databuffer {

namespace {

ClockState rebased(const ClockState& clock) {
  return rebased(clock, monotonic_ns());
}

}  // namespace

ClockState rebased(ClockState clock, std::int64_t base_ns) {
  clock.base_sim_ns = sim_time_at(clock, base_ns);
  clock.base_monotonic_ns = base_ns;
  return clock;
}

ClockState with_running(const ClockState& clock, bool running) {
  ClockState next = rebased(clock);
  next.running = running ? 1 : 0;
  return next;
}

ClockState with_rate(const ClockState& clock, double rate) {
  ClockState next = rebased(clock);
  next.rate = rate;
  return next;
}

ClockState stepped(const ClockState& clock, std::int64_t ticks) {
  ClockState next = with_running(clock, false);
  next.base_sim_ns +=
      std::min(ticks, kStepPortion_ticks) * radar::kTickNanoseconds - next.base_sim_ns % radar::kTickNanoseconds;
  return next;
}

ClockState reset_to(const ClockState& clock, double time_s) {
  ClockState next = clock;
  next.base_monotonic_ns = monotonic_ns();
  next.base_sim_ns = std::llround(time_s / radar::kTickSeconds) * radar::kTickNanoseconds;
  ++next.epoch;
  next.reposition_latitude_deg = std::numeric_limits<double>::quiet_NaN();
  next.followed = 0;
  return next;
}

ClockState repositioned(const ClockState& clock, const Repositioning& to) {
  ClockState next = rebased(clock);
  ++next.epoch;
  next.followed = 0;
  next.reposition_latitude_deg = to.position.latitude_deg;
  next.reposition_longitude_deg = to.position.longitude_deg;
  next.reposition_altitude_m = to.altitude.metres();
  next.reposition_heading_deg = to.heading.degrees();
  next.reposition_speed_mps = to.ground_speed.value_or(geo::Speed()).metres_per_second();
  return next;
}

void begin_at_aircraft(ClockState& clock, const Ownship& ownship, geo::Bearing heading) {
  clock.reposition_latitude_deg = ownship.latitude_deg;
  clock.reposition_longitude_deg = ownship.longitude_deg;
  clock.reposition_altitude_m = ownship.altitude_msl_m;
  clock.reposition_heading_deg = heading.degrees();
  clock.reposition_speed_mps = 0.0;
  clock.followed = 1;
}

ClockState after_first_tick(const ClockState& clock) {
  ClockState next = clock;
  next.base_sim_ns = std::min(next.base_sim_ns + radar::kTickNanoseconds, kLatestClockBase_ns);
  return next;
}

}  // namespace yars::databuffer
