#include "statemachine/app/state_machine_shell.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/validation.hpp"
#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/session_changes.hpp"
#include "lib/log/log.hpp"
#include "lib/radar/mission.hpp"
#include "statemachine/advice.hpp"
#include "statemachine/designation.hpp"
#include "statemachine/machine.hpp"
#include "world/world_values.hpp"

namespace yars::statemachine {

namespace {

// Events older than 1 s at the first tick are dropped, because the pilot no longer expects them to take effect.
constexpr std::int64_t kMaxEventAge_ns = 1'000'000'000;

}  // namespace

StateMachineShell::StateMachineShell(databuffer::Session& session, const Parameters& parameters, bool lockstep)
    : session_(&session),
      parameters_(parameters),
      configured_route_(parameters.route),
      drop_old_events_(!lockstep),
      field_(parameters.navigation.magnetic_model, parameters.navigation.magnetic_folder),
      published_{} {
  use_route(databuffer::newest_world(std::as_const(session).layout()));
  state_ = initial_state(parameters_);
  // Missing data is reported only for a configured magnetic model. Without data the configured variation applies.
  if (!field_.has_data() && !parameters.navigation.magnetic_model.empty())
    log::warning("magnetic model: " + field_.problem() + "; the configured variation applies");
  const auto predecessor = databuffer::read_to_resume(session.layout().radar_state, session, "radar state");
  if (!predecessor) return;
  state_ = *predecessor;
  published_ = *predecessor;
  nothing_published_ = false;
  session.note(databuffer::NoteKind::restart, "state-machine resumes");
  log::info("resumes from the radar state in the segment");
}

void StateMachineShell::step(const runtime::TickLoop::Due& due) {
  session_->restore_clock();
  latch(due);
  take_events(due.tick);
  advance(state_, inputs_, parameters_);
  publish_if_changed(due.tick);
  publish_advice();
  session_->layout().outputs.publish(outputs_of(state_, inputs_));
  drop_old_events_ = false;
}

void StateMachineShell::latch(const runtime::TickLoop::Due& due) {
  const auto& selected = ownship_.refresh(session_->layout(), due.sim_time_ns, due.clock.epoch);
  inputs_.tick = due.tick;
  inputs_.sim_time_ns = due.sim_time_ns;
  inputs_.epoch = due.clock.epoch;
  inputs_.ownship_valid = selected.valid;
  inputs_.ownship = selected.ownship;
  inputs_.nav = selected.nav;
  latch_recorder();
  const bool stale = !latch_model() || (inputs_.model.flags & databuffer::kModelStale) != 0;
  inputs_.height_above_ground_m = stale ? std::nan("") : inputs_.model.height_above_ground_m;
  latch_variation();
  latch_maps();
  latch_route();
}

// Returns false while the segment has no model status, and until a valid one has been received. An invalid status is
// noted in the flight recorder, and the last valid status is kept.
bool StateMachineShell::latch_model() {
  const auto& slot = session_->layout().model_status;
  if (!slot.has_value()) return false;
  if (model_.refresh(slot, *session_, "model status")) inputs_.model = model_.value();
  return model_.has_value();
}

// The recorder's status is used only while a process holds the role of the recorder.
void StateMachineShell::latch_recorder() {
  recorder_.refresh(session_->layout().recorder_status, *session_, "recorder status");
  inputs_.recorder_present = session_->role_is_held(databuffer::Role::recorder);
  inputs_.recorder_writing = inputs_.recorder_present && recorder_.value().writing != 0;
  inputs_.recorder_failed = inputs_.recorder_present && recorder_.value().problem[0] != '\0';
}

// Evaluates the magnetic field once per second of sim time, and in every tick until a variation is known. An evaluation
// takes longer than all other work of step(), and the variation changes slowly.
void StateMachineShell::latch_variation() {
  constexpr std::int64_t kTicksBetween = 200;  // 1 s
  const bool due = inputs_.tick % kTicksBetween == 0 || std::isnan(inputs_.field_variation_deg);
  if (!field_.has_data() || !inputs_.ownship_valid || !due) return;
  const databuffer::Ownship& ownship = inputs_.ownship;
  inputs_.field_variation_deg = field_.variation_deg({ownship.latitude_deg, ownship.longitude_deg},
                                                     geo::HeightAboveEllipsoid::metres(ownship.altitude_msl_m),
                                                     parameters_.navigation.magnetic_year);
}

// Drops the records of patch maps whose ids are no longer in the radar state or the model status. Reads the record of
// each map whose id is new there.
void StateMachineShell::latch_maps() {
  const std::array<std::uint64_t, kMaxMaps> wanted{state_.map_newest, state_.map_old, state_.map_stored,
                                                   inputs_.model.map_newest};
  wanted_maps_.refresh(
      inputs_.maps, wanted,
      [this](std::uint64_t id, databuffer::PatchMap& map) {
        return databuffer::read_patch(session_->layout(), id, map);
      },
      [](const databuffer::PatchMap&) {});
}

void StateMachineShell::use_route(const std::optional<databuffer::WorldState>& world) {
  const bool is_changed = world && (world->flags & databuffer::kWorldPointsChanged) != 0U;
  changed_route_ = is_changed ? world::route_of(*world) : std::vector<radar::RoutePoint>();
  parameters_.route = is_changed ? changed_route_ : configured_route_;
}

// radar-model latches an instructor's change of the sequence points as part of the world.
void StateMachineShell::latch_route() {
  const auto& layout = std::as_const(*session_).layout();
  const std::uint64_t latched = layout.world_latched.next();
  if (std::exchange(worlds_latched_, latched) == latched) return;
  const auto world = databuffer::world_in_effect(layout);
  if (!world) return;
  const std::vector<radar::RoutePoint> before(parameters_.route.begin(), parameters_.route.end());
  use_route(world);
  change_route(state_, before, inputs_, parameters_);
  advice_due_ = true;
}

void StateMachineShell::take_events(std::int64_t tick) {
  auto& input = session_->layout().input;
  databuffer::InputEvent event{};
  std::uint64_t too_old = 0;
  const std::int64_t now_ns = drop_old_events_ ? databuffer::monotonic_ns() : 0;
  for (std::size_t lane = 0; lane < databuffer::kInputLanes; ++lane) {
    // The number of events per lane and tick is bounded, so that a source that floods its lane does not delay the tick.
    for (std::size_t taken = 0; taken < databuffer::kInputLaneDepth && input.peek(lane, event); ++taken) {
      // Events of a lane are applied in order. So if this event waits (for the terrain elevation of an earlier point),
      // the later events of the lane wait too.
      if (waits_for_elevation(state_, event, inputs_)) break;
      input.pop(lane, event);
      if (drop_old_events_ && event.monotonic_ns < now_ns - kMaxEventAge_ns)
        ++too_old;
      else
        take(event, lane, tick);
    }
  }
  if (too_old > 0) session_->note(databuffer::NoteKind::loss, std::to_string(too_old) + " events over 1 s old dropped");
}

void StateMachineShell::take(const databuffer::InputEvent& event, std::size_t lane, std::int64_t tick) {
  if (const auto reason = databuffer::validate(event)) {
    session_->note(databuffer::NoteKind::refusal, "event: " + std::string(*reason));
    return;
  }
  databuffer::AppliedEvent applied{};
  applied.effective = static_cast<std::uint32_t>(apply(state_, event, inputs_, parameters_));
  ++state_.events_applied;
  applied.tick = tick;
  applied.monotonic_ns = databuffer::monotonic_ns();
  applied.event = event;
  applied.lane = static_cast<std::uint32_t>(lane);
  session_->layout().applied_events.publish(applied);
  if (applied.effective != databuffer::kEventDone)
    note_idle(advice_, {event, applied.lane, applied.effective == databuffer::kEventRefused}, state_, inputs_,
              parameters_);
  advice_due_ = true;
  log::debug(databuffer::text_of(event) + (applied.effective != databuffer::kEventDead ? "" : " (without effect)"));
}

// A change of the tick alone does not count as a change of the state.
void StateMachineShell::publish_if_changed(std::int64_t tick) {
  state_.epoch = inputs_.epoch;
  state_.tick = published_.tick;
  if (!nothing_published_ && std::memcmp(&state_, &published_, sizeof state_) == 0) return;
  state_.tick = tick;
  session_->layout().radar_state.publish(state_);
  published_ = state_;
  nothing_published_ = false;
}

// Each advice tries all buttons, so it is made 10 times a second, and in ticks with an event. A change of the tick
// alone does not count as a change.
void StateMachineShell::publish_advice() {
  constexpr std::int64_t kTicksBetween = 20;  // 0.1 s
  if (!std::exchange(advice_due_, false) && inputs_.tick % kTicksBetween != 0) return;
  advise(advice_, state_, inputs_, parameters_);
  advice_.tick = published_advice_.tick;
  if (std::memcmp(&advice_, &published_advice_, sizeof advice_) == 0) return;
  advice_.tick = inputs_.tick;
  session_->layout().advice.publish(advice_);
  published_advice_ = advice_;
}

}  // namespace yars::statemachine
