// `yars sim`: controls the session's clock and the aircraft's position.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <thread>
#include <utility>

#include "databuffer/runtime/process.hpp"
#include "databuffer/runtime/program.hpp"
#include "databuffer/session/session.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/text/plain_text.hpp"
#include "tools/command/command.hpp"

namespace yars::tools {

namespace {

using databuffer::ClockState;
using databuffer::Session;

constexpr double kMaxRate = 10.0;  // sim time / real time; at higher rates programs skip late ticks
// Ticks by which `step` advances the clock at once. At most kMaxTicksBehind (20): programs skip ticks that are further
// behind the clock.
constexpr std::int64_t kStepPortion_ticks = 10;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Session open_session(const CommonOptions& common) {
  auto running = Session::open_read_only(common.session);
  if (!running) throw_failure(running.error());
  if (std::as_const(*running).layout().lockstep.enabled.load() != 0)
    throw_failure({"yars sim", "a live session", "a session in lockstep, whose sim time only its programs advance",
                   "use yars sim on a live session", false});
  auto session = Session::open(common.session, "yars sim");
  if (!session) throw_failure(session.error());
  if (session->has_foreign_clock())
    throw_failure({"yars sim", "the CLOCK_MONOTONIC of the session's programs", "another one, as in a time namespace",
                   "run yars sim in the namespace of the session's programs", false});
  return std::move(*session);
}

// The clock with the present time as its base, so that sim time does not jump when `rate` or `running` changes.
ClockState rebased(const ClockState& clock) {
  ClockState next = clock;
  next.base_monotonic_ns = databuffer::monotonic_ns();
  next.base_sim_ns = databuffer::sim_time_at(clock, next.base_monotonic_ns);
  return next;
}

template <class Change>
void change_clock(Session& session, const Change& change) {
  if (auto outcome = session.change_clock(change); !outcome) throw_failure(outcome.error());
}

void report(const Session& session) {
  const ClockState clock = session.clock();
  std::printf("sim time %.3f s, rate %g, %s, epoch %u\n", static_cast<double>(session.sim_time_ns()) * 1e-9, clock.rate,
              clock.running != 0 ? "running" : "frozen", clock.epoch);
}

void set_running(const CommonOptions& common, bool running) {
  auto session = open_session(common);
  change_clock(session, [running](const ClockState& clock) {
    ClockState next = rebased(clock);
    next.running = running ? 1 : 0;
    return next;
  });
  report(session);
}

void set_rate(const CommonOptions& common, double rate) {
  if (!std::isfinite(rate) || rate < 0.0 || rate > kMaxRate)
    throw_failure(error::usage_error("rate", "0 to 10", std::to_string(rate)));
  auto session = open_session(common);
  change_clock(session, [rate](const ClockState& clock) {
    ClockState next = rebased(clock);
    next.rate = rate;
    return next;
  });
  report(session);
}

// Gives the programs of the session time to run the ticks that have become due.
void pause_for_roles() {
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
}

// Freezes the clock and advances it by kStepPortion_ticks at a time, so that no program skips a tick.
void step(const CommonOptions& common, std::int64_t ticks) {
  if (ticks < 1)
    throw_failure(error::usage_error("step", "a number of ticks of 5 ms, 1 or more", std::to_string(ticks)));
  auto session = open_session(common);
  const std::uint32_t epoch = session.clock().epoch;
  while (ticks > 0 && !databuffer::stop_requested()) {
    const std::int64_t portion = std::min(ticks, kStepPortion_ticks);
    change_clock(session, [&](const ClockState& clock) {
      ClockState next = rebased(clock);
      next.running = 0;
      if (clock.epoch != epoch) return next;
      // Rounded down to a whole tick: from any time within a tick, one step leads to the begin of the next tick.
      next.base_sim_ns += portion * radar::kTickNanoseconds - next.base_sim_ns % radar::kTickNanoseconds;
      return next;
    });
    if (session.clock().epoch != epoch)
      throw_failure(
          {"step", "no new epoch while stepping", "a reset or repositioning by another program", "step again", false});
    ticks -= portion;
    pause_for_roles();
  }
  report(session);
}

// Advances a frozen clock by one tick after a new epoch has begun. The programs run the first tick of an epoch in
// no defined order. From the second tick on, each program reads the other programs' records of the new epoch.
void advance_if_frozen(Session& session) {
  if (session.clock().running != 0) return;
  pause_for_roles();
  change_clock(session, [](const ClockState& clock) {
    ClockState next = clock;
    next.base_sim_ns = std::min(next.base_sim_ns + radar::kTickNanoseconds, databuffer::kLatestClockBase_ns);
    return next;
  });
}

void reset(const CommonOptions& common, double time_s) {
  if (!(time_s >= 0.0 && time_s <= databuffer::kLatestSimTime_s))
    throw_failure(error::usage_error("reset",
                                     "a sim time of 0 to " + text::text_of_number(databuffer::kLatestSimTime_s) + " s",
                                     text::text_of_number(time_s)));
  auto session = open_session(common);
  change_clock(session, [time_s](const ClockState& clock) {
    ClockState next = clock;
    next.base_monotonic_ns = databuffer::monotonic_ns();
    // Rounded to a whole tick, because a replay shows the picture of that tick.
    next.base_sim_ns = std::llround(time_s / radar::kTickSeconds) * radar::kTickNanoseconds;
    ++next.epoch;
    next.reposition_latitude_deg = kNaN;
    next.followed = 0;
    return next;
  });
  advance_if_frozen(session);
  report(session);
}

struct Position {
  double latitude_deg = 0.0, longitude_deg = 0.0, altitude_ft = 0.0, heading_deg = 0.0;
};

void reposition(const CommonOptions& common, const Position& position) {
  const auto check = [](const char* name, double value, double low, double high) {
    if (!(value >= low && value <= high))
      throw_failure(error::usage_error(
          "reposition", std::string(name) + " of " + text::text_of_number(low) + " to " + text::text_of_number(high),
          text::text_of_number(value)));
  };
  check("LAT", position.latitude_deg, -90, 90);
  check("LON", position.longitude_deg, -180, 180);
  check("ALT_FT", position.altitude_ft, -3000, 600000);
  check("HDG", position.heading_deg, 0, 360);
  auto session = open_session(common);
  change_clock(session, [&position](const ClockState& clock) {
    ClockState next = rebased(clock);
    ++next.epoch;
    next.followed = 0;
    next.reposition_latitude_deg = position.latitude_deg;
    next.reposition_longitude_deg = position.longitude_deg;
    next.reposition_altitude_m = position.altitude_ft * geo::kMetresPerFoot;
    next.reposition_heading_deg = std::fmod(position.heading_deg, 360.0);
    return next;
  });
  advance_if_frozen(session);
  report(session);
}

}  // namespace

void add_sim_command(databuffer::Command app, const CommonOptions& common) {
  databuffer::Command sim = app.subcommand("sim", "the session's clock and the aircraft's position");
  sim.require_subcommand();
  sim.subcommand("freeze", "stop sim time").callback([&common] { set_running(common, false); });
  sim.subcommand("run", "let sim time run").callback([&common] { set_running(common, true); });
  databuffer::Command rate_command = sim.subcommand("rate", "set the rate of sim time: 0 to 10 times real time");
  auto rate = std::make_shared<double>(1.0);
  rate_command.option("X", *rate).required();
  rate_command.callback([&common, rate] { set_rate(common, *rate); });
  databuffer::Command step_command = sim.subcommand("step", "freeze, then advance by N ticks of 5 ms");
  auto ticks = std::make_shared<std::int64_t>(1);
  step_command.option("N", *ticks);
  step_command.callback([&common, ticks] { step(common, *ticks); });
  databuffer::Command reset_command =
      sim.subcommand("reset", "set sim time to 0 or to S and begin a new epoch; a replay seeks to this time");
  auto time_s = std::make_shared<double>(0.0);
  reset_command.option("S", *time_s, "seconds of sim time");
  reset_command.callback([&common, time_s] { reset(common, *time_s); });
  databuffer::Command reposition_command =
      sim.subcommand("reposition", "move the aircraft to a position and begin a new epoch");
  auto position = std::make_shared<Position>();
  reposition_command.option("LAT", position->latitude_deg, "degrees, north positive").required();
  reposition_command.option("LON", position->longitude_deg, "degrees, east positive").required();
  reposition_command.option("ALT_FT", position->altitude_ft, "feet above mean sea level").required();
  reposition_command.option("HDG", position->heading_deg, "degrees true").required();
  reposition_command.callback([&common, position] { reposition(common, *position); });
}

}  // namespace yars::tools
