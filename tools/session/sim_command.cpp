// `yars sim`: the session's clock and the aircraft's place.

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

constexpr double kFastestRate = 10.0;      // times real time; beyond it late ticks would be skipped
constexpr std::int64_t kStepsAtOnce = 10;  // [ticks] below the 20 that a role catches up before it skips
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Session open_session(const CommonOptions& common) {
  auto running = Session::open_read_only(common.session);
  if (!running) give_up(running.error());
  if (std::as_const(*running).layout().lockstep.enabled.load() != 0)
    give_up(
        {"yars sim", "a live session", "one in lockstep, whose time is its ticks", "use it on a live session", false});
  auto session = Session::open(common.session, "yars sim");
  if (!session) give_up(session.error());
  return std::move(*session);
}

// Holds sim time where it is and makes it the new base, so that rate and run may change without a jump.
ClockState rebased(const ClockState& clock) {
  ClockState next = clock;
  next.base_monotonic_ns = databuffer::monotonic_ns();
  next.base_sim_ns = databuffer::sim_time_at(clock, next.base_monotonic_ns);
  return next;
}

template <class Change>
void change_clock(Session& session, const Change& change) {
  if (auto outcome = session.change_clock(change); !outcome) give_up(outcome.error());
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
  if (!std::isfinite(rate) || rate < 0.0 || rate > kFastestRate)
    give_up(error::usage_error("rate", "0 to 10", std::to_string(rate)));
  auto session = open_session(common);
  change_clock(session, [rate](const ClockState& clock) {
    ClockState next = rebased(clock);
    next.rate = rate;
    return next;
  });
  report(session);
}

void pause_for_roles() {
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
}

// Frozen time is moved on in portions that no role has to skip; each from the clock as it then is.
void step(const CommonOptions& common, std::int64_t ticks) {
  if (ticks < 1) give_up(error::usage_error("step", "a number of ticks of 5 ms, 1 or more", std::to_string(ticks)));
  auto session = open_session(common);
  const std::uint32_t epoch = session.clock().epoch;
  while (ticks > 0 && !databuffer::stop_requested()) {
    const std::int64_t portion = std::min(ticks, kStepsAtOnce);
    change_clock(session, [&](const ClockState& clock) {
      ClockState next = rebased(clock);
      next.running = 0;
      if (clock.epoch != epoch) return next;
      // On a tick's edge, so that one step is one tick.
      next.base_sim_ns += portion * radar::kTickNanoseconds - next.base_sim_ns % radar::kTickNanoseconds;
      return next;
    });
    if (session.clock().epoch != epoch)
      give_up(
          {"step", "the epoch in which it began", "a reset or repositioning by somebody else", "step again", false});
    ticks -= portion;
    pause_for_roles();
  }
  report(session);
}

// A new epoch begins with one tick of each role in no order; another one, when frozen, lets all see all.
void settle_when_frozen(Session& session) {
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
    give_up(error::usage_error("reset",
                               "a sim time of 0 to " + text::text_of_number(databuffer::kLatestSimTime_s) + " s",
                               text::text_of_number(time_s)));
  auto session = open_session(common);
  change_clock(session, [time_s](const ClockState& clock) {
    ClockState next = clock;
    next.base_monotonic_ns = databuffer::monotonic_ns();
    // On a tick's edge: a replay shows the picture of that tick.
    next.base_sim_ns = std::llround(time_s / radar::kTickSeconds) * radar::kTickNanoseconds;
    ++next.epoch;
    next.reposition_latitude_deg = kNaN;
    next.followed = 0;
    return next;
  });
  settle_when_frozen(session);
  report(session);
}

struct Place {
  double latitude_deg = 0.0, longitude_deg = 0.0, altitude_ft = 0.0, heading_deg = 0.0;
};

void reposition(const CommonOptions& common, const Place& place) {
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  if (!within(place.latitude_deg, -90, 90) || !within(place.longitude_deg, -180, 180) ||
      !within(place.altitude_ft, -3000, 600000) || !within(place.heading_deg, 0, 360))
    give_up(error::usage_error("reposition", "LAT [-90, 90], LON [-180, 180], ALT_FT [-3000, 600000], HDG [0, 360]",
                               "a value outside"));
  auto session = open_session(common);
  change_clock(session, [&place](const ClockState& clock) {
    ClockState next = rebased(clock);
    ++next.epoch;
    next.followed = 0;
    next.reposition_latitude_deg = place.latitude_deg;
    next.reposition_longitude_deg = place.longitude_deg;
    next.reposition_altitude_m = place.altitude_ft * geo::kMetresPerFoot;
    next.reposition_heading_deg = std::fmod(place.heading_deg, 360.0);
    return next;
  });
  settle_when_frozen(session);
  report(session);
}

}  // namespace

void add_sim_command(CLI::App& app, const CommonOptions& common) {
  auto* sim = app.add_subcommand("sim", "the session's clock and the aircraft's place");
  sim->require_subcommand(1);
  sim->add_subcommand("freeze", "stop sim time")->callback([&common] { set_running(common, false); });
  sim->add_subcommand("run", "let sim time go on")->callback([&common] { set_running(common, true); });
  auto* rate_command = sim->add_subcommand("rate", "times real time, 0 to 10");
  auto rate = std::make_shared<double>(1.0);
  rate_command->add_option("X", *rate)->required();
  rate_command->callback([&common, rate] { set_rate(common, *rate); });
  auto* step_command = sim->add_subcommand("step", "freeze, then move on by N ticks of 5 ms");
  auto ticks = std::make_shared<std::int64_t>(1);
  step_command->add_option("N", *ticks);
  step_command->callback([&common, ticks] { step(common, *ticks); });
  auto* reset_command = sim->add_subcommand("reset", "sim time back to 0, or to S, a new epoch; a replay goes there");
  auto time_s = std::make_shared<double>(0.0);
  reset_command->add_option("S", *time_s, "seconds of sim time");
  reset_command->callback([&common, time_s] { reset(common, *time_s); });
  auto* place_command = sim->add_subcommand("reposition", "put the aircraft elsewhere, a new epoch");
  auto place = std::make_shared<Place>();
  place_command->add_option("LAT", place->latitude_deg, "degrees, north positive")->required();
  place_command->add_option("LON", place->longitude_deg, "degrees, east positive")->required();
  place_command->add_option("ALT_FT", place->altitude_ft, "feet above mean sea level")->required();
  place_command->add_option("HDG", place->heading_deg, "degrees true")->required();
  place_command->callback([&common, place] { reposition(common, *place); });
}

}  // namespace yars::tools
