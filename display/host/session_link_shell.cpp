#include "display/host/session_link_shell.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/validation.hpp"
#include "databuffer/session/picture_pool.hpp"
#include "display/symbology/readouts.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"
#include "runtime/tick_loop.hpp"

namespace yars::display {

namespace {

// Interval between readings of the process table: 0.2 s, because a reading takes many system calls.
constexpr std::int64_t kHealthInterval_ns = 200'000'000;

bool takes_part(const databuffer::SessionLayout& layout, databuffer::LockstepRole role) {
  return (layout.lockstep.roles.load(std::memory_order_relaxed) >> static_cast<unsigned>(role) & 1U) != 0;
}

}  // namespace

SessionFeed::SessionFeed(databuffer::Session& session, bool lockstep, SweepSink sweeps, MapSink maps)
    : session_(&session),
      lockstep_(lockstep),
      sweep_sink_(std::move(sweeps)),
      map_sink_(std::move(maps)),
      sweep_cursor_(std::as_const(session).layout().sweeps.oldest()) {}

void SessionFeed::refresh(std::int64_t sim_time_ns) {
  take_health();
  take_state();
  take_advice();
  take_ranging();
  take_maps();
  take_model(sim_time_ns);
  take_caption();
  take_sweeps();
}

void SessionFeed::take_health() {
  if (lockstep_) {
    input_.state_machine_alive = takes_part(session_->layout(), databuffer::LockstepRole::state_machine);
    input_.model_alive = takes_part(session_->layout(), databuffer::LockstepRole::radar_model);
    tour_runs_ = true;
    return;
  }
  const std::int64_t now_ns = databuffer::monotonic_ns();
  if (now_ns < next_health_ns_) return;
  next_health_ns_ = now_ns + kHealthInterval_ns;
  const auto processes = session_->processes();
  input_.state_machine_alive = runtime::is_alive(processes, databuffer::Role::state_machine, now_ns);
  input_.model_alive = runtime::is_alive(processes, databuffer::Role::radar_model, now_ns);
  tour_runs_ = session_->role_is_held(databuffer::Role::tour);
}

// A tour that was killed leaves its caption in the segment.
void SessionFeed::take_caption() {
  const auto& slot = session_->layout().caption;
  caption_.refresh(slot, *session_, "display: caption");
  input_.caption = tour_runs_ && slot.has_value() ? caption_.value() : databuffer::Caption{};
}

void SessionFeed::take_state() {
  if (state_.refresh(session_->layout().radar_state, *session_, "display: radar state")) input_.state = state_.value();
}

void SessionFeed::take_advice() {
  if (advice_.refresh(session_->layout().advice, *session_, "display: advice")) input_.advice = advice_.value();
}

void SessionFeed::take_ranging() {
  if (outputs_.refresh(session_->layout().outputs, *session_, "display: outputs"))
    input_.slant_range_m = outputs_.value().slant_range_m;
}

// Reads, once each, the maps that the radar state names. Drops maps that the state no longer names.
void SessionFeed::take_maps() {
  const std::array named{input_.state.map_newest, input_.state.map_old, input_.state.map_stored};
  wanted_maps_.refresh(
      maps_, named,
      [this](std::uint64_t id, databuffer::PatchMap& map) {
        return databuffer::read_patch(session_->layout(), id, map, pixels_);
      },
      [this](const databuffer::PatchMap& map) { map_sink_(map, pixels_); });
  const auto shown = std::ranges::find(maps_, input_.state.map_shown, &databuffer::PatchMap::id);
  input_.map = shown == maps_.end() ? databuffer::PatchMap{} : *shown;
}

void SessionFeed::take_model(std::int64_t sim_time_ns) {
  // The receiver also runs while radar-model is alive, so that it has data immediately when radar-model dies.
  const auto& selected = receiver_.refresh(session_->layout(), sim_time_ns, session_->clock().epoch);
  take_status();
  if (input_.model_alive && status_.has_value()) {
    input_.ownship = input_.model.ownship;
    input_.nav = input_.model.nav;
    input_.ownship_fresh = (input_.model.flags & databuffer::kModelStale) == 0;
  } else {
    input_.ownship = selected.ownship;
    input_.nav = selected.nav;
    input_.ownship_fresh = selected.valid;
  }
}

void SessionFeed::take_status() {
  if (status_.refresh(session_->layout().model_status, *session_, "display: model status"))
    input_.model = status_.value();
}

void SessionFeed::take_sweeps() {
  const auto& ring = session_->layout().sweeps;
  std::uint64_t lost = 0;
  while (true) {
    const auto read = ring.read(sweep_cursor_, sweep_);
    lost += read.lost;
    if (!read.delivered) break;
    if (const auto reason = databuffer::validate(sweep_))
      session_->note(databuffer::NoteKind::refusal, "display: sweep: " + *reason);
    else
      sweep_sink_(sweep_);
  }
  if (lost == 0) return;
  const std::string text = "display lost " + text::counted(lost, "sweep");
  session_->note(databuffer::NoteKind::loss, text);
  log::warning(text);
}

error::Expected<PilotInput> PilotInput::create(databuffer::Session& session, std::string_view source) {
  auto lane = runtime::InputLane::claim(session, source);
  if (!lane) return tl::unexpected(lane.error());
  return PilotInput(std::move(*lane));
}

void PilotInput::press(int button) {
  databuffer::InputEvent event{};
  event.kind = static_cast<std::uint16_t>(databuffer::EventKind::push_button);
  event.argument = static_cast<std::int16_t>(button);
  send(event);
}

bool PilotInput::click(Point at) {
  const auto button = button_at(at);
  if (button) press(*button);
  return button.has_value();
}

void PilotInput::send_key(const gl::KeyEdge& edge) {
  for (const databuffer::InputEvent& event : keyboard_.change(edge.key, edge.pressed)) send(event);
}

void PilotInput::release_all() {
  for (const databuffer::InputEvent& event : keyboard_.release_all()) send(event);
}

}  // namespace yars::display
