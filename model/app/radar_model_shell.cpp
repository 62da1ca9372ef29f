#include "model/app/radar_model_shell.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <string>
#include <utility>

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/messages/validation.hpp"
#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/session_changes.hpp"
#include "lib/log/log.hpp"
#include "lib/radar/configuration.hpp"
#include "lib/radar/mission.hpp"
#include "lib/text/plain_text.hpp"
#include "model/kernel/map_schedule.hpp"
#include "model/kernel/tick_inputs.hpp"
#include "world/world_values.hpp"

namespace yars::model {

namespace {

// Weight of the newest tick in the smoothed load. The time constant is 1 s. With a shorter time constant,
// the load in `yars status` would fluctuate.
constexpr double kLoadSmoothing = radar::kTickSeconds / 1.0;

// Processor time of the calling thread.
double thread_time_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

void load_ahead(const databuffer::Session& session, kernel::RadarKernel& kernel, TerrainLoader& terrain,
                SceneLoader& scenes) {
  const auto status = databuffer::read_valid(session.layout().model_status);
  const auto state = databuffer::read_valid(session.layout().radar_state);
  if (!status || !state) return;
  databuffer::ModelTick tick{};
  tick.tick = status->tick;
  tick.sim_time_ns = status->sim_time_ns;
  tick.epoch = status->epoch;
  tick.ownship = status->ownship;
  tick.command = databuffer::command_from_state(*state);
  tick.flags = databuffer::kTickOwnshipValid;
  kernel.resume(*status);
  const auto need = kernel.need(tick);
  if (!need.ground) return;
  terrain.request(need.region, kStandbyMargin_m);
  scenes.request(need.region, kStandbyMargin_m);
}

RadarModelShell::RadarModelShell(databuffer::Session& session, const radar::RadarConfiguration& configuration,
                                 const Workers& workers)
    : session_(&session),
      configuration_(&configuration),
      terrain_(&workers.terrain),
      scenes_(&workers.scenes),
      patches_(&workers.patches),
      kernel_(configuration),
      governor_(configuration.fidelity.core_share),
      fidelity_(configuration.fidelity) {
  session.layout().world_configured.publish(world::world_state_from(configuration.world, configuration.route));
  resume();
}

void RadarModelShell::resume() {
  tick_.resumed_tick = -1;
  const auto stored = databuffer::read_to_resume(session_->layout().model_status, *session_, "model status");
  if (!stored) return;
  const databuffer::ModelStatus& previous = *stored;
  kernel_.resume(previous);
  status_.sweeps = previous.sweeps;
  previous_late_ticks_ = previous.late_ticks;
  tick_.ownship = previous.ownship;
  status_.nav = previous.nav;
  status_.ownship_received_ns = previous.ownship_received_ns;
  tick_.resumed_tick = previous.tick;
  resumed_epoch_ = previous.epoch;
  refused_ = previous.refused;
  session_->note(databuffer::NoteKind::restart, "radar-model resumes at scan " + std::to_string(previous.scan));
  log::info("resumes at scan " + std::to_string(previous.scan));
}

void RadarModelShell::step(const runtime::TickLoop::Due& due, std::uint64_t late_ticks) {
  const double begin_s = thread_time_s();
  latch(due);
  // While the clock is frozen nobody waits for this tick.
  run_kernel(first_tick_ && tick_.resumed_tick >= 0 && due.clock.running == 0);
  const double elapsed_s = thread_time_s() - begin_s;
  load_ += kLoadSmoothing * (elapsed_s / radar::kTickSeconds - load_);
  if (configuration_->fidelity.automatic) govern(elapsed_s, due.clock.rate);
  publish_status(late_ticks);
  first_tick_ = false;
}

void RadarModelShell::latch(const runtime::TickLoop::Due& due) {
  const databuffer::Ownship before = tick_.ownship;
  const databuffer::RadarCommand command_before = tick_.command;
  const auto& selected = ownship_.refresh(session_->layout(), due.sim_time_ns, due.clock.epoch);
  tick_.tick = due.tick;
  tick_.sim_time_ns = due.sim_time_ns;
  tick_.epoch = due.clock.epoch;
  // Without a fresh source the last valid ownship stays in use, even if a previous process received it.
  if (selected.valid) {
    tick_.ownship = selected.ownship;
    status_.nav = selected.nav;
    status_.ownship_received_ns = selected.received_ns;
  }
  tick_.ownship_lane = selected.lane;
  if (selected.jump) announce_jump(*selected.jump, selected.jump_lane);
  for (const std::string& refusal : ownship_.refusals()) session_->note(databuffer::NoteKind::refusal, refusal);
  latch_command();
  latch_traffic();
  latch_world();
  tick_.flags = selected.valid || inherits_ownship(due) ? databuffer::kTickOwnshipValid : 0U;
  if (first_tick_) tick_.flags |= databuffer::kTickRestart;
  if (first_tick_ || std::memcmp(&before, &tick_.ownship, sizeof before) != 0)
    tick_.flags |= databuffer::kTickOwnshipChanged;
  if (first_tick_ || std::memcmp(&command_before, &tick_.command, sizeof command_before) != 0)
    tick_.flags |= databuffer::kTickCommandChanged;
  latch_fidelity();
  if (publish_due_map()) tick_.flags |= databuffer::kTickMapComplete;
}

// True until a source is selected, while the ownship of the previous process is fresh. Without it the beam would stand
// still until the source delivers its next record.
bool RadarModelShell::inherits_ownship(const runtime::TickLoop::Due& due) const {
  const std::int64_t age_ns = due.sim_time_ns - status_.ownship_received_ns;
  return tick_.resumed_tick >= 0 && resumed_epoch_ == due.clock.epoch && age_ns >= 0 &&
         age_ns <= databuffer::kStaleAfter_ns;
}

// Starts a new epoch at the position to which the ownship source has jumped. In a new epoch JumpGuard
// (databuffer/session/receivers.hpp) accepts the jump.
void RadarModelShell::announce_jump(const databuffer::Ownship& ownship, std::uint32_t lane) {
  const auto changed = session_->change_clock(
      [&ownship](const databuffer::ClockState& clock) {
        databuffer::ClockState next = clock;
        next.base_monotonic_ns = databuffer::monotonic_ns();
        next.base_sim_ns = databuffer::sim_time_at(clock, next.base_monotonic_ns);
        ++next.epoch;
        databuffer::begin_at_aircraft(next, ownship, geo::Bearing::degrees(ownship.heading_deg));
        return next;
      },
      databuffer::WaitPolicy::none);
  if (!changed) return;  // another process is changing the clock; the next tick tries again
  const std::string text =
      "the aircraft of '" + databuffer::name_of_source(ownship, lane) + "' has jumped; a new epoch begins";
  session_->note(databuffer::NoteKind::restart, text);
  log::info(text);
}

void RadarModelShell::latch_fidelity() {
  tick_.samples = static_cast<std::uint32_t>(fidelity_.samples);
  std::fill(std::begin(tick_.fidelity), std::end(tick_.fidelity), '\0');
  fidelity_.name.copy(tick_.fidelity, sizeof tick_.fidelity - 1);
}

// Fidelity `automatic`: the processor load of a scan selects the preset of the next scan. `rate`: sim time / real time.
void RadarModelShell::govern(double elapsed_s, double rate) {
  scan_time_s_ += elapsed_s * rate;
  ++scan_ticks_;
  if (status_.scan == governed_scan_) return;
  governed_scan_ = status_.scan;
  governor_.record_load(scan_time_s_ / (scan_ticks_ * radar::kTickSeconds));
  scan_time_s_ = 0.0;
  scan_ticks_ = 0;
  if (selected_fidelity_ || governor_.preset() == fidelity_.name) return;
  fidelity_ = *radar::fidelity_preset(governor_.preset());
  log::info("fidelity " + fidelity_.name);
}

void RadarModelShell::latch_command() {
  const bool is_new = radar_state_.refresh(session_->layout().radar_state, *session_, "radar state");
  if (radar_state_.refusal()) ++refused_;
  if (!is_new) return;
  const databuffer::RadarState& state = radar_state_.value();
  tick_.command = databuffer::command_from_state(state);
  referenced_maps_ = {state.map_newest, state.map_old, state.map_stored, state.map_shown};
}

// If the ring was used by a previous process, the first tick publishes the latched traffic even if it is unchanged:
// the last record of the ring applies, and would be that of the previous process.
void RadarModelShell::latch_traffic() {
  auto& ring = session_->layout().traffic_latched;
  const bool changed = traffic_.refresh(session_->layout(), tick_.tick, tick_.sim_time_ns, tick_.epoch);
  if (traffic_.refusal()) session_->note(databuffer::NoteKind::refusal, *traffic_.refusal());
  if (changed || (first_tick_ && ring.next() > 0)) {
    ring.publish(traffic_.latched());
    targets_.traffic = kernel::points_of(traffic_.latched());
  }
  tick_.traffic = ring.next();
}

// The first tick always latches a world: the wanted one, which a previous process may have latched before, or else that
// of the configuration. So the last record of the ring is always in effect.
void RadarModelShell::latch_world() {
  auto& layout = session_->layout();
  const bool is_new = wanted_world_.refresh(layout.world, *session_, "world");
  if (wanted_world_.refusal()) ++refused_;
  if (is_new || first_tick_) {
    radar::WorldConfiguration world = configuration_->world;
    const databuffer::WorldState& wanted = wanted_world_.value();
    databuffer::WorldState latched = world::world_state_from(world, configuration_->route);
    if (wanted_world_.has_value() && (wanted.flags & databuffer::kWorldConfigured) == 0U) {
      latched = wanted;
      world::apply(wanted, world);
    }
    latched.edit = wanted.edit;
    latched.source_time_ns = wanted.source_time_ns;
    latched.tick = tick_.tick;
    layout.world_latched.publish(latched);
    kernel_.use_world(world);
    targets_.movers = physics::moving_points(world);
    select_fidelity(text::text_of(latched.fidelity));
  }
  tick_.world = layout.world_latched.next();
}

// The kernel changes to the preset that a tick names when a scan begins. An unknown name selects the configured one.
void RadarModelShell::select_fidelity(std::string_view preset) {
  const auto selected = radar::fidelity_preset(preset);
  if (!selected && !selected_fidelity_) return;
  const bool was_selected = std::exchange(selected_fidelity_, selected.has_value());
  const std::string before = std::exchange(fidelity_, selected.value_or(configuration_->fidelity)).name;
  if (was_selected != selected_fidelity_ || before != fidelity_.name) log::info("fidelity " + fidelity_.name);
}

// Waits until the ground is loaded, so that the first sweeps of a set that goes on from a recording have it.
void RadarModelShell::await_ground(const terrain::TerrainRegion& region) {
  constexpr std::int64_t kPatience_ns = 500'000'000;  // 0.5 s; then sweeps are flagged not ready as in flight
  constexpr timespec kPause{0, 2'000'000};
  const std::int64_t deadline_ns = databuffer::monotonic_ns() + kPatience_ns;
  while (!(terrain_->has_loaded(region) && loaded_scenes_.complete) && databuffer::monotonic_ns() < deadline_ns) {
    nanosleep(&kPause, nullptr);
    session_->heartbeat();
    loaded_scenes_ = scenes_->request(region);
  }
}

void RadarModelShell::run_kernel(bool may_wait) {
  const auto need = kernel_.need(tick_);
  if (need.ground) {
    terrain_->request(need.region);
    loaded_scenes_ = scenes_->request(need.region);
    if (may_wait) await_ground(need.region);
  }
  note_problems(terrain_->take_problems());
  for (const std::string& note : terrain_->take_notes()) log::warning(note);
  note_problems(scenes_->take_problems());
  const auto view = terrain_->view();
  tick_.terrain_generation = view->generation();
  // The tick is published before its sweep, so that a truncated recording never has a sweep without its tick.
  session_->layout().model_ticks.publish(tick_);
  if (kernel_.step(tick_, {*view, loaded_scenes_.view.get(), loaded_scenes_.complete, targets_.traffic}, sweep_)) {
    session_->layout().sweeps.publish(sweep_);
    ++status_.sweeps;
  }
  request_map();
  kernel_.describe(*view, status_);
  kernel::answer_elevation(radar_state_.value(), *view, status_);
  status_.terrain_bytes = view->resident_bytes();
  status_.terrain_generation = view->generation();
}

// Problems of files. They are no refusals: these are of records, and many of them mean a faulty writer.
void RadarModelShell::note_problems(const std::vector<std::string>& problems) {
  for (const std::string& problem : problems) {
    session_->note(databuffer::NoteKind::loss, problem);
    log::warning(problem);
  }
}

// Requests the picture of a map when its formation starts.
void RadarModelShell::request_map() {
  note_problems(patches_->take_problems());
  if (!kernel_.maps().forming()) return;
  const kernel::PendingMap& map = kernel_.maps().map();
  if (map.id == requested_map_ && map.start_tick == requested_map_tick_) return;
  requested_map_ = map.id;
  requested_map_tick_ = map.start_tick;
  patches_->request(map, targets_);
}

// Publishes a map at its end tick, or at the first later tick with a complete picture. The flag kTickMapComplete in the
// tick lets a replay complete the map at the same tick.
bool RadarModelShell::publish_due_map() {
  if (!kernel_.maps().due(tick_.tick)) return false;
  const PatchMaker::Picture* picture = patches_->finished(kernel_.maps().map());
  if (picture == nullptr) return false;
  publish_map(*picture);
  return true;
}

void RadarModelShell::publish_map(const PatchMaker::Picture& picture) {
  const kernel::PendingMap& pending = kernel_.maps().map();
  databuffer::PatchMap map{};
  map.id = pending.id;
  map.start_tick = pending.start_tick;
  map.end_tick = tick_.tick;
  map.latitude_deg = pending.order.centre.latitude_deg;
  map.longitude_deg = pending.order.centre.longitude_deg;
  map.elevation_msl_m = picture.elevation_msl_m;
  map.up_deg = picture.up_deg;
  map.window_nm = pending.order.window.nautical_miles();
  map.apex_latitude_deg = pending.order.apex.latitude_deg;
  map.apex_longitude_deg = pending.order.apex.longitude_deg;
  map.apex_altitude_msl_m = pending.order.altitude.metres();
  map.distance_m = picture.distance_m;
  map.squint_deg = picture.squint_deg;
  map.resolution_m = radar::map_resolution(pending.order.window).metres();
  map.formation_s = pending.formation.seconds();
  map.epoch = tick_.epoch;
  map.request = pending.request;
  map.size = picture.size;
  map.looks = static_cast<std::uint32_t>(pending.order.looks);
  map.flags = (picture.ready ? 0U : databuffer::kPatchNotReady) | (picture.blind ? databuffer::kPatchBlind : 0U) |
              (pending.blank_window ? databuffer::kPatchWindowBlank : 0U);
  configuration_->fidelity.name.copy(map.fidelity, sizeof map.fidelity - 1);
  map.hash = databuffer::map_hash(map, picture.pixels);
  std::array<std::uint64_t, 5> keep{};
  std::copy(referenced_maps_.begin(), referenced_maps_.end(), keep.begin());
  keep.back() = kernel_.maps().newest();
  if (!databuffer::publish_patch(session_->layout(), map, picture.pixels, keep))
    session_->note(databuffer::NoteKind::loss, "no free slot for patch map " + std::to_string(map.id));
}

void RadarModelShell::publish_status(std::uint64_t late_ticks) {
  status_.ownship = tick_.ownship;
  status_.ownship_lane = tick_.ownship_lane;
  status_.load = std::round(load_ * 1000.0) / 1000.0;
  status_.late_ticks = previous_late_ticks_ + late_ticks;
  status_.refused = refused_ + ownship_.refused() + traffic_.refused();
  status_.tick = tick_.tick;
  status_.sim_time_ns = tick_.sim_time_ns;
  status_.epoch = tick_.epoch;
  session_->layout().model_status.publish(status_);
}

}  // namespace yars::model
