#include "tools/replay_session.hpp"

#include <ctime>
#include <limits>
#include <utility>

#include "databuffer/patch_pool.hpp"
#include "databuffer/program.hpp"
#include "lib/radar/limits.hpp"

namespace yars::tools {

namespace {

using databuffer::ClockState;
using databuffer::Session;

// A glass looks 60 times a second: so many at a time never overtake it.
constexpr std::size_t kSweepsAtOnce = 400;
constexpr long kReaderPause_ns = 30'000'000;

void pause_for_readers() {
  const timespec pause{0, kReaderPause_ns};
  nanosleep(&pause, nullptr);
}

}  // namespace

ReplaySession::ReplaySession(Session machine, Session model) : machine_(std::move(machine)), model_(std::move(model)) {}

failure::Expected<ReplaySession> ReplaySession::create(const std::string& name) {
  auto machine = Session::open(name, databuffer::name_of(databuffer::Role::state_machine));
  if (!machine) return tl::unexpected(machine.error());
  auto model = Session::open(name, databuffer::name_of(databuffer::Role::radar_model));
  if (!model) return tl::unexpected(model.error());
  if (std::as_const(*machine).layout().lockstep.enabled.load() != 0)
    return failure::fail("session " + name, "one that is live", "one in lockstep", "replay into another --session");
  ReplaySession session(std::move(*machine), std::move(*model));
  auto machine_role = session.machine_.claim(databuffer::Role::state_machine);
  if (!machine_role) return tl::unexpected(databuffer::usage_error(machine_role.error()));
  auto model_role = session.model_.claim(databuffer::Role::radar_model);
  if (!model_role) return tl::unexpected(databuffer::usage_error(model_role.error()));
  auto lane = session.model_.claim_ownship_lane(0);
  if (!lane) return tl::unexpected(lane.error());
  session.machine_role_ = std::move(*machine_role);
  session.model_role_ = std::move(*model_role);
  session.lane_ = std::move(*lane);
  return session;
}

failure::Expected<void> ReplaySession::set_clock(std::int64_t tick, const double* rate) {
  constexpr std::int64_t kLatestTick = databuffer::kLatestClockBase_ns / radar::kTickNanoseconds;
  if (tick < 0 || tick > kLatestTick)
    return failure::fail("the recording", "ticks of 0 to " + std::to_string(kLatestTick), std::to_string(tick),
                         "it is damaged there: --seek to another time");
  return machine_.change_clock([&](const ClockState& clock) {
    ClockState next = clock;
    next.base_monotonic_ns = databuffer::monotonic_ns();
    next.base_sim_ns = tick * radar::kTickNanoseconds;
    if (rate != nullptr) {
      next.rate = *rate;
      next.running = 1;
    }
    next.epoch = epoch_ = clock.epoch + 1;
    next.reposition_latitude_deg = std::numeric_limits<double>::quiet_NaN();
    return next;
  });
}

failure::Expected<void> ReplaySession::jump_to(std::int64_t tick) {
  return set_clock(tick, nullptr);
}

failure::Expected<void> ReplaySession::start(std::int64_t tick, double rate) {
  return set_clock(tick, &rate);
}

std::int64_t ReplaySession::tick() const {
  return machine_.sim_time_ns() / radar::kTickNanoseconds;
}

bool ReplaySession::was_reset() {
  const std::uint32_t epoch = machine_.clock().epoch;
  return std::exchange(epoch_, epoch) != epoch;
}

void ReplaySession::publish_key_frame(const recording::Played& played) {
  if (!played.state) machine_.layout().radar_state.clear();
  if (!played.outputs) machine_.layout().outputs.clear();
  if (!played.status) model_.layout().model_status.clear();
  publish(played);
}

// Maps before the state that names them, sweeps before the status that counts them.
void ReplaySession::publish(const recording::Played& played) {
  if (played.state)
    maps_named_ = {played.state->map_newest, played.state->map_old, played.state->map_stored, played.state->map_shown};
  publish_maps(played);
  publish_sweeps(played);
  if (played.status) publish_status(*played.status);
  if (played.outputs) {
    databuffer::Outputs outputs = *played.outputs;
    outputs.epoch = epoch_;
    machine_.layout().outputs.publish(outputs);
  }
  if (played.state) {
    databuffer::RadarState state = *played.state;
    state.epoch = epoch_;
    machine_.layout().radar_state.publish(state);
  }
}

void ReplaySession::publish_maps(const recording::Played& played) {
  databuffer::PatchMap there{};
  for (const recording::Patch& patch : played.maps) {
    if (databuffer::read_patch(std::as_const(model_).layout(), patch.map.id, there)) continue;
    if (!databuffer::publish_patch(model_.layout(), patch.map, patch.pixels, maps_named_))
      model_.note(databuffer::NoteKind::loss, "no free slot for patch map " + std::to_string(patch.map.id));
  }
}

void ReplaySession::publish_sweeps(const recording::Played& played) {
  std::size_t published = 0;
  for (databuffer::Sweep sweep : played.sweeps) {
    sweep.epoch = epoch_;
    model_.layout().sweeps.publish(sweep);
    if (++published % kSweepsAtOnce == 0) pause_for_readers();
  }
}

void ReplaySession::publish_status(databuffer::ModelStatus status) {
  status.epoch = status.ownship.epoch = status.nav.epoch = epoch_;
  const auto lane = static_cast<std::size_t>(lane_.lane());
  model_.layout().ownship[lane].publish(status.ownship);
  model_.layout().nav[lane].publish(status.nav);
  model_.layout().model_status.publish(status);
}

void ReplaySession::heartbeat() {
  machine_.heartbeat();
  machine_.keep_clock();
  model_.heartbeat();
}

// Else lanes fill up, and whoever presses is told of a machine that has died.
void ReplaySession::drop_events() {
  databuffer::InputEvent event{};
  for (std::size_t lane = 0; lane < databuffer::kInputLanes; ++lane)
    while (machine_.layout().input.pop(lane, event)) {
    }
}

}  // namespace yars::tools
