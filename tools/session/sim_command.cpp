// `yars sim`: controls the session's clock and the aircraft's position.

#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "databuffer/session/receivers.hpp"
#include "databuffer/session/session.hpp"
#include "databuffer/session/session_changes.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/modes.hpp"
#include "lib/values/fields.hpp"
#include "runtime/process.hpp"
#include "runtime/program.hpp"
#include "tools/command/command.hpp"

namespace yars::tools {

namespace {

using databuffer::ClockState;
using databuffer::Role;
using databuffer::Session;

// Options that all subcommands of `yars sim` share.
struct SimOptions {
  const CommonOptions& common;
  bool json = false;
};

constexpr int kMaxSteps = 1'000'000'000;  // of one `step`: 58 days of sim time

Session open_live_session(const CommonOptions& common) {
  auto running = Session::open_read_only(common.session);
  if (!running) throw_failure(running.error());
  if (std::as_const(*running).layout().lockstep.enabled.load() != 0)
    throw_failure({"yars sim", "a live session", "a session in lockstep, whose sim time only its programs advance",
                   "use yars sim on a live session"});
  auto session = Session::open(common.session, "yars sim");
  if (!session) throw_failure(session.error());
  if (session->has_foreign_clock())
    throw_failure({"yars sim", "the CLOCK_MONOTONIC of the session's programs", "another one, as in a time namespace",
                   "run yars sim in the namespace of the session's programs"});
  return std::move(*session);
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

// Changes the clock and prints it.
template <class Change>
void change_and_report(const SimOptions& options, const Change& change) {
  auto session = open_live_session(options.common);
  change_clock(session, change);
  report(session, options.json);
}

// True if state-machine and radar-model have run all ticks up to the time of the frozen clock, or do not run.
bool have_run_due_ticks(const Session& session) {
  const ClockState clock = session.clock();
  const std::int64_t due = clock.base_sim_ns / radar::kTickNanoseconds;
  const auto has_run = [&](Role role, const auto& record) {
    return !session.role_is_held(role) || (record && record->epoch == clock.epoch && record->tick >= due);
  };
  return has_run(Role::state_machine, databuffer::read_valid(session.layout().outputs)) &&
         has_run(Role::radar_model, databuffer::read_valid(session.layout().model_status));
}

// Gives the programs of the session time to run the ticks that have become due: kPortionTime_ms, and on a busy machine
// until they have run. A program that hangs is waited for once.
class PauseForRoles {
 public:
  void operator()(const Session& session) {
    int waited_ms = databuffer::kPortionTime_ms;
    std::this_thread::sleep_for(std::chrono::milliseconds(waited_ms));
    while (!have_run_due_ticks(session) && waited_ms < most_ms_ && !runtime::stop_requested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ++waited_ms;
    }
    if (waited_ms >= most_ms_) most_ms_ = databuffer::kPortionTime_ms;
  }

 private:
  int most_ms_ = 1000;
};

// Freezes the clock and advances it by a portion at a time, so that no program skips a tick.
void step(const SimOptions& options, std::int64_t ticks) {
  auto session = open_live_session(options.common);
  const std::uint32_t epoch = session.clock().epoch;
  PauseForRoles pause;
  while (ticks > 0 && !runtime::stop_requested()) {
    change_clock(session,
                 [&](const ClockState& clock) { return databuffer::stepped(clock, clock.epoch == epoch ? ticks : 0); });
    if (session.clock().epoch != epoch)
      throw_failure(
          {"step", "no new epoch while stepping", "a reset or repositioning by another program", "step again"});
    ticks -= databuffer::kStepPortion_ticks;
    pause(session);
  }
  report(session, options.json);
}

// Begins an epoch by a change of the clock, advances a frozen clock into it, and prints the clock.
template <class Change>
void begin_epoch(const SimOptions& options, const Change& change) {
  auto session = open_live_session(options.common);
  change_clock(session, change);
  if (session.clock().running == 0) {
    PauseForRoles()(session);
    change_clock(session, databuffer::after_first_tick);
  }
  report(session, options.json);
}

struct Position {
  double latitude_deg = 0.0, longitude_deg = 0.0, altitude_ft = 0.0, heading_deg = 0.0;
  std::optional<double> speed_kt{};
};

databuffer::Repositioning repositioning_of(const Position& position) {
  databuffer::Repositioning to{{position.latitude_deg, position.longitude_deg},
                               geo::AltitudeMsl::feet(position.altitude_ft),
                               geo::Bearing::degrees(position.heading_deg)};
  if (position.speed_kt) to.ground_speed = geo::Speed::knots(*position.speed_kt);
  return to;
}

}  // namespace

void add_sim_command(runtime::Command app, const CommonOptions& common) {
  runtime::Command sim = app.subcommand("sim", "the session's clock and the aircraft's position");
  sim.require_subcommand();
  const auto options = std::make_shared<SimOptions>(SimOptions{common});
  const auto add = [&sim, &options](const char* name, const char* help, const std::function<void()>& call) {
    runtime::Command command = sim.subcommand(name, help);
    add_json_flag(command, options->json);
    command.callback(call);
    return command;
  };
  add("state", "print sim time, rate and epoch", [options] { print_state(*options); });
  add("freeze", "stop sim time", [options] {
    change_and_report(*options, [](const ClockState& clock) { return databuffer::with_running(clock, false); });
  });
  add("run", "let sim time run", [options] {
    change_and_report(*options, [](const ClockState& clock) { return databuffer::with_running(clock, true); });
  });
  const auto rate = std::make_shared<double>(1.0);
  add("rate", "set the rate of sim time",
      [options, rate] {
        change_and_report(*options, [&](const ClockState& clock) { return databuffer::with_rate(clock, *rate); });
      })
      .option("RATE", *rate, "sim time over real time")
      .range(0.0, databuffer::kMaxClockRate)
      .required();
  const auto ticks = std::make_shared<std::int64_t>(1);
  add("step", "freeze, then advance by TICKS of 5 ms", [options, ticks] { step(*options, *ticks); })
      .option("TICKS", *ticks, "number of ticks")
      .range(1, kMaxSteps);
  const auto time_s = std::make_shared<double>(0.0);
  add("reset", "set sim time and begin a new epoch; a replay seeks to this time",
      [options, time_s] {
        begin_epoch(*options, [&](const ClockState& clock) { return databuffer::reset_to(clock, *time_s); });
      })
      .option("TIME_S", *time_s, "[s] sim time")
      .range(0.0, databuffer::kLatestSimTime_s);
  const auto position = std::make_shared<Position>();
  runtime::Command move =
      add("reposition", "move the aircraft to a position and begin a new epoch", [options, position] {
        const databuffer::Repositioning to = repositioning_of(*position);
        begin_epoch(*options, [&](const ClockState& clock) { return databuffer::repositioned(clock, to); });
      });
  using To = values::Reposition;
  add_value(move, "LAT", To::latitude, position->latitude_deg).required();
  add_value(move, "LON", To::longitude, position->longitude_deg).required();
  add_value(move, "ALT_FT", To::altitude, position->altitude_ft).required();
  add_value(move, "HDG", To::heading, position->heading_deg).required();
  add_value(move, "--speed", To::speed, position->speed_kt);
}

}  // namespace yars::tools
