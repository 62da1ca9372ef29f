#include "model/app/radar_model_shell.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <string>

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/messages/validation.hpp"
#include "databuffer/session/picture_pool.hpp"
#include "lib/log/log.hpp"
#include "lib/radar/configuration.hpp"
#include "lib/radar/mapping.hpp"
#include "model/kernel/map_schedule.hpp"
#include "model/kernel/tick_inputs.hpp"

namespace yars::model {

namespace {

// Share of the newest tick in the smoothed load: time constant 1 s, so that `yars status` reads steadily.
constexpr double kLoadSmoothing = radar::kTickSeconds / 1.0;

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

RadarModelShell::RadarModelShell(databuffer::Session& session, const radar::RadarConfiguration& configuration,
                                 const Makers& makers)
    : session_(&session),
      configuration_(&configuration),
      terrain_(&makers.terrain),
      scenes_(&makers.scenes),
      patches_(&makers.patches),
      kernel_(configuration),
      governor_(configuration.fidelity.core_share),
      picked_(configuration.fidelity) {
  resume();
}

void RadarModelShell::resume() {
  tick_.resumed_tick = -1;
  databuffer::ModelStatus left{};
  if (!session_->layout().model_status.read(left)) return;
  if (const auto reason = databuffer::validate(left)) {
    session_->note(databuffer::NoteKind::refusal, "model status left behind: " + *reason);
    log::warning("model status left behind is refused, starting anew: " + *reason);
    return;
  }
  kernel_.resume(left);
  status_.sweeps = left.sweeps;
  late_before_ = left.late_ticks;
  tick_.ownship = left.ownship;
  status_.nav = left.nav;
  status_.ownship_received_ns = left.ownship_received_ns;
  tick_.resumed_tick = left.tick;
  refused_ = left.refused;
  session_->note(databuffer::NoteKind::restart, "radar-model resumes at scan " + std::to_string(left.scan));
  log::info("resumes at scan " + std::to_string(left.scan));
}

void RadarModelShell::step(const databuffer::TickLoop::Due& due, std::uint64_t late_ticks) {
  const double begin_s = thread_seconds();
  latch(due);
  run_kernel();
  const double seconds = thread_seconds() - begin_s;
  load_ += kLoadSmoothing * (seconds / radar::kTickSeconds - load_);
  if (configuration_->fidelity.automatic) govern(seconds, due.clock.rate);
  publish_status(late_ticks);
  first_tick_ = false;
}

void RadarModelShell::latch(const databuffer::TickLoop::Due& due) {
  const databuffer::Ownship before = tick_.ownship;
  const databuffer::RadarCommand command_before = tick_.command;
  const auto& selected = ownship_.refresh(session_->layout(), due.sim_time_ns, due.clock.epoch);
  tick_.tick = due.tick;
  tick_.sim_time_ns = due.sim_time_ns;
  tick_.epoch = due.clock.epoch;
  // Without a fresh source the last one known stands, also a predecessor's.
  if (selected.valid) {
    tick_.ownship = selected.ownship;
    status_.nav = selected.nav;
    status_.ownship_received_ns = selected.received_ns;
  }
  tick_.ownship_lane = selected.lane;
  if (selected.jump) tell_of_jump(*selected.jump, selected.jump_lane);
  for (const std::string& refusal : ownship_.refusals()) session_->note(databuffer::NoteKind::refusal, refusal);
  latch_command();
  latch_traffic();
  tick_.flags = selected.valid ? databuffer::kTickOwnshipValid : 0U;
  if (first_tick_) tick_.flags |= databuffer::kTickRestart;
  if (first_tick_ || std::memcmp(&before, &tick_.ownship, sizeof before) != 0)
    tick_.flags |= databuffer::kTickOwnshipChanged;
  if (first_tick_ || std::memcmp(&command_before, &tick_.command, sizeof command_before) != 0)
    tick_.flags |= databuffer::kTickCommandChanged;
  latch_fidelity();
  if (publish_due_map()) tick_.flags |= databuffer::kTickMapComplete;
}

// A new epoch, at the place to which the aircraft's source has jumped: with it the radar believes it.
void RadarModelShell::tell_of_jump(const databuffer::Ownship& there, std::uint32_t lane) {
  const auto told = session_->change_clock(
      [&there](const databuffer::ClockState& clock) {
        databuffer::ClockState next = clock;
        next.base_monotonic_ns = databuffer::monotonic_ns();
        next.base_sim_ns = databuffer::sim_time_at(clock, next.base_monotonic_ns);
        ++next.epoch;
        next.reposition_latitude_deg = there.latitude_deg;
        next.reposition_longitude_deg = there.longitude_deg;
        next.reposition_altitude_m = there.altitude_msl_m;
        next.reposition_heading_deg = there.heading_deg;
        next.followed = 1;
        return next;
      },
      databuffer::WaitPolicy::none);
  if (!told) return;  // somebody else sets the clock just now: the next tick tries again
  const std::string text = "the aircraft of '" + databuffer::name_of_source(there, lane) + "' has jumped: a new epoch";
  session_->note(databuffer::NoteKind::restart, text);
  log::info(text);
}

void RadarModelShell::latch_fidelity() {
  tick_.samples = static_cast<std::uint32_t>(picked_.samples);
  std::fill(std::begin(tick_.fidelity), std::end(tick_.fidelity), '\0');
  picked_.name.copy(tick_.fidelity, sizeof tick_.fidelity - 1);
}

// Fidelity `automatic`: what a scan took decides on the next.
void RadarModelShell::govern(double seconds, double rate) {
  scan_seconds_ += seconds * rate;
  ++scan_ticks_;
  if (status_.scan == governed_scan_) return;
  governed_scan_ = status_.scan;
  governor_.record_load(scan_seconds_ / (scan_ticks_ * radar::kTickSeconds));
  scan_seconds_ = 0.0;
  scan_ticks_ = 0;
  if (governor_.preset() == picked_.name) return;
  picked_ = *radar::fidelity_preset(governor_.preset());
  log::info("fidelity " + picked_.name);
}

void RadarModelShell::latch_command() {
  auto& slot = session_->layout().radar_state;
  if (slot.version() == state_version_) return;
  databuffer::RadarState state{};
  const auto version = slot.read(state);
  if (!version) return;
  state_version_ = *version;
  if (const auto reason = databuffer::validate(state)) {
    ++refused_;
    session_->note(databuffer::NoteKind::refusal, "radar state: " + std::string(*reason));
    return;
  }
  asked_ = state;
  tick_.command = databuffer::command_from_state(state);
  maps_named_ = {state.map_newest, state.map_old, state.map_stored, state.map_shown};
}

// A predecessor's traffic is not this process's: the first tick says what holds from now on.
void RadarModelShell::latch_traffic() {
  auto& ring = session_->layout().traffic_latched;
  const bool changed = traffic_.refresh(session_->layout(), tick_.tick, tick_.sim_time_ns, tick_.epoch);
  if (traffic_.refusal()) session_->note(databuffer::NoteKind::refusal, *traffic_.refusal());
  if (changed || (first_tick_ && ring.next() > 0)) {
    ring.publish(traffic_.latched());
    traffic_points_ = kernel::points_of(traffic_.latched());
  }
  tick_.traffic = ring.next();
}

void RadarModelShell::run_kernel() {
  const auto need = kernel_.need(tick_);
  if (need.ground) {
    terrain_->request(need.region);
    seen_scenes_ = scenes_->request(need.region);
  }
  note_problems(terrain_->take_problems());
  note_problems(scenes_->take_problems());
  const auto view = terrain_->view();
  tick_.terrain_generation = view->generation();
  // The tick goes out before its sweep, so that a log cut short never holds a sweep without its cause.
  session_->layout().model_ticks.publish(tick_);
  if (kernel_.step(tick_, {*view, seen_scenes_.view.get(), seen_scenes_.whole, traffic_points_}, sweep_)) {
    session_->layout().sweeps.publish(sweep_);
    ++status_.sweeps;
  }
  ask_for_map();
  kernel_.describe(*view, status_);
  kernel::answer_elevation(asked_, *view, status_);
  status_.terrain_bytes = view->resident_bytes();
  status_.terrain_generation = view->generation();
}

void RadarModelShell::note_problems(const std::vector<std::string>& problems) {
  for (const std::string& problem : problems) {
    session_->note(databuffer::NoteKind::refusal, problem);
    log::warning(problem);
  }
}

// A map that has begun is asked for at once.
void RadarModelShell::ask_for_map() {
  note_problems(patches_->take_problems());
  if (!kernel_.maps().forming()) return;
  const kernel::PendingMap& map = kernel_.maps().map();
  if (map.id == map_asked_ && map.start_tick == map_asked_tick_) return;
  map_asked_ = map.id;
  map_asked_tick_ = map.start_tick;
  patches_->request(map, traffic_points_);
}

// It goes out at the tick at which the radar would have it, or when it is ready if that is later; the tick says so,
// and whoever replays the ticks completes it there.
bool RadarModelShell::publish_due_map() {
  if (!kernel_.maps().due(tick_.tick)) return false;
  const PatchMaker::Picture* picture = patches_->finished(kernel_.maps().map());
  if (picture == nullptr) return false;
  publish_map(*picture);
  return true;
}

void RadarModelShell::publish_map(const PatchMaker::Picture& picture) {
  const kernel::PendingMap& under_way = kernel_.maps().map();
  databuffer::PatchMap map{};
  map.id = under_way.id;
  map.start_tick = under_way.start_tick;
  map.end_tick = tick_.tick;
  map.latitude_deg = under_way.order.centre.latitude_deg;
  map.longitude_deg = under_way.order.centre.longitude_deg;
  map.elevation_msl_m = picture.elevation_msl_m;
  map.up_deg = picture.up_deg;
  map.window_nm = under_way.order.window.nautical_miles();
  map.apex_latitude_deg = under_way.order.apex.latitude_deg;
  map.apex_longitude_deg = under_way.order.apex.longitude_deg;
  map.apex_altitude_msl_m = under_way.order.altitude.metres();
  map.distance_m = picture.distance_m;
  map.squint_deg = picture.squint_deg;
  map.resolution_m = radar::map_resolution(under_way.order.window).metres();
  map.formation_s = under_way.formation.seconds();
  map.epoch = tick_.epoch;
  map.request = under_way.request;
  map.size = picture.size;
  map.looks = static_cast<std::uint32_t>(under_way.order.looks);
  map.flags = (picture.ready ? 0U : databuffer::kPatchNotReady) | (picture.blind ? databuffer::kPatchBlind : 0U) |
              (under_way.blank_window ? databuffer::kPatchWindowBlank : 0U);
  configuration_->fidelity.name.copy(map.fidelity, sizeof map.fidelity - 1);
  map.hash = kernel::map_hash(map, picture.pixels);
  std::array<std::uint64_t, 5> keep{};
  std::copy(maps_named_.begin(), maps_named_.end(), keep.begin());
  keep.back() = kernel_.maps().newest();
  if (!databuffer::publish_patch(session_->layout(), map, picture.pixels, keep))
    session_->note(databuffer::NoteKind::loss, "no free slot for patch map " + std::to_string(map.id));
}

void RadarModelShell::publish_status(std::uint64_t late_ticks) {
  status_.ownship = tick_.ownship;
  status_.ownship_lane = tick_.ownship_lane;
  status_.load = std::round(load_ * 1000.0) / 1000.0;
  status_.late_ticks = late_before_ + late_ticks;
  status_.refused = refused_ + ownship_.refused() + traffic_.refused();
  status_.tick = tick_.tick;
  status_.sim_time_ns = tick_.sim_time_ns;
  status_.epoch = tick_.epoch;
  session_->layout().model_status.publish(status_);
}

}  // namespace yars::model
