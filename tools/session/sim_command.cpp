// `yars sim`: controls the session's clock and the aircraft's position.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "databuffer/runtime/process.hpp"
#include "databuffer/runtime/program.hpp"
#include "databuffer/session/session.hpp"
#include "lib/geo/quantity.hpp"
#include "tools/command/command.hpp"
#include "tools/command/json_output.hpp"

namespace yars::tools {

namespace {

using databuffer::ClockState;
using databuffer::Session;

// Options that all subcommands of `yars sim` share.
struct SimOptions {
  const CommonOptions& common;
  bool json = false;
};

constexpr double kMaxRate = 10.0;         // sim time / real time; at higher rates programs skip late ticks
constexpr int kMaxSteps = 1'000'000'000;  // of one `step`: 58 days of sim time
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

void report(const Session& session, bool json) {
  const ClockState clock = session.clock();
  const double sim_time_s = static_cast<double>(session.reached_sim_time_ns()) * 1e-9;
  if (json)
    return print_json(
        {{"sim_time", sim_time_s}, {"rate", clock.rate}, {"running", clock.running != 0}, {"epoch", clock.epoch}});
  std::printf("sim time %.3f s, rate %g, %s, epoch %u%s\n", sim_time_s, clock.rate,
              clock.running != 0 ? "running" : "frozen", clock.epoch,
              clock.running != 0 ? "" : "; yars sim run lets it run");
}

// Reads only, so it works in lockstep, too.
void print_state(const SimOptions& options) {
  const auto session = Session::open_read_only(options.common.session);
  if (!session) throw_failure(session.error());
  report(*session, options.json);
}

void set_running(const SimOptions& options, bool running) {
  auto session = open_session(options.common);
  change_clock(session, [running](const ClockState& clock) {
    ClockState next = rebased(clock);
    next.running = running ? 1 : 0;
    return next;
  });
  report(session, options.json);
}

void set_rate(const SimOptions& options, double rate) {
  auto session = open_session(options.common);
  change_clock(session, [rate](const ClockState& clock) {
    ClockState next = rebased(clock);
    next.rate = rate;
    return next;
  });
  report(session, options.json);
}

// Gives the programs of the session time to run the ticks that have become due.
void pause_for_roles() {
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
}

// Freezes the clock and advances it by kStepPortion_ticks at a time, so that no program skips a tick.
void step(const SimOptions& options, std::int64_t ticks) {
  auto session = open_session(options.common);
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
  report(session, options.json);
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

void reset(const SimOptions& options, double time_s) {
  auto session = open_session(options.common);
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
  report(session, options.json);
}

struct Position {
  double latitude_deg = 0.0, longitude_deg = 0.0, altitude_ft = 0.0, heading_deg = 0.0;
};

void reposition(const SimOptions& options, const Position& position) {
  auto session = open_session(options.common);
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
  report(session, options.json);
}

}  // namespace

void add_sim_command(databuffer::Command app, const CommonOptions& common) {
  databuffer::Command sim = app.subcommand("sim", "the session's clock and the aircraft's position");
  sim.require_subcommand();
  const auto options = std::make_shared<SimOptions>(SimOptions{common});
  const auto add = [&sim, &options](const char* name, const char* help, const std::function<void()>& call) {
    databuffer::Command command = sim.subcommand(name, help);
    add_json_flag(command, options->json);
    command.callback(call);
    return command;
  };
  add("state", "print sim time, rate and epoch", [options] { print_state(*options); });
  add("freeze", "stop sim time", [options] { set_running(*options, false); });
  add("run", "let sim time run", [options] { set_running(*options, true); });
  const auto rate = std::make_shared<double>(1.0);
  add("rate", "set the rate of sim time", [options, rate] { set_rate(*options, *rate); })
      .option("RATE", *rate, "sim time over real time")
      .range(0.0, kMaxRate)
      .required();
  const auto ticks = std::make_shared<std::int64_t>(1);
  add("step", "freeze, then advance by TICKS of 5 ms", [options, ticks] { step(*options, *ticks); })
      .option("TICKS", *ticks, "number of ticks")
      .range(1, kMaxSteps);
  const auto time_s = std::make_shared<double>(0.0);
  add("reset", "set sim time and begin a new epoch; a replay seeks to this time",
      [options, time_s] { reset(*options, *time_s); })
      .option("TIME_S", *time_s, "[s] sim time")
      .range(0.0, databuffer::kLatestSimTime_s);
  const auto position = std::make_shared<Position>();
  databuffer::Command move = add("reposition", "move the aircraft to a position and begin a new epoch",
                                 [options, position] { reposition(*options, *position); });
  move.option("LAT", position->latitude_deg, "[deg] north positive").range(-90.0, 90.0).required();
  move.option("LON", position->longitude_deg, "[deg] east positive").range(-180.0, 180.0).required();
  move.option("ALT_FT", position->altitude_ft, "[ft] above mean sea level").range(-3000.0, 600000.0).required();
  move.option("HDG", position->heading_deg, "[deg] true").range(0.0, 360.0).required();
}

}  // namespace yars::tools
