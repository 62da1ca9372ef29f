#include "tools/recorder.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "databuffer/patch_pool.hpp"
#include "databuffer/records/validation.hpp"
#include "databuffer/session_layout.hpp"

namespace yars::tools {

namespace {

template <class Ring, class Record>
bool take(const Ring& ring, std::uint64_t& cursor, Record& record, std::uint64_t& lost) {
  const auto outcome = ring.read(cursor, record);
  lost += outcome.lost;
  return outcome.delivered;
}

}  // namespace

Recorder::Recorder(databuffer::Session& session, recording::RecordingWriter& writer, RecordedExtras extras,
                   bool from_the_begin)
    : session_(&session),
      writer_(&writer),
      extras_(extras),
      state_(session.layout().radar_state),
      status_(session.layout().model_status),
      outputs_(session.layout().outputs) {
  if (!from_the_begin) begin_here();
}

void Recorder::begin_here() {
  const auto& layout = session_->layout();
  tick_cursor_ = layout.model_ticks.next();
  event_cursor_ = layout.applied_events.next();
  sweep_cursor_ = layout.sweeps.next();
  // The status may be of a later tick than the cursor: ticks up to it are not written.
  recording::StartingPoint start{};
  if (!layout.model_status.read(start.status)) return;
  append(start);
  from_tick_ = start.status.tick + 1;
  from_epoch_ = start.status.epoch;
}

template <class T>
void Recorder::append(const T& record) {
  if (outcome_) outcome_ = writer_->append(record);
}

failure::Expected<void> Recorder::drain(std::int64_t tick) {
  recording::Gap gap{};
  take_ticks(gap.ticks);
  databuffer::AppliedEvent event{};
  while (take(session_->layout().applied_events, event_cursor_, event, gap.events)) append(event);
  take_latest(tick);
  take_sweeps(gap.sweeps);
  if (extras_.patches) take_patches();
  if (gap.ticks + gap.events + gap.sweeps > 0) {
    append(gap);
    session_->note(databuffer::NoteKind::loss, "recorder fell behind by " + std::to_string(gap.ticks) + " ticks");
  }
  return outcome_;
}

void Recorder::take_ticks(std::uint64_t& lost) {
  databuffer::ModelTick tick{};
  while (take(session_->layout().model_ticks, tick_cursor_, tick, lost)) {
    if (from_tick_ && tick.tick < *from_tick_ && tick.epoch == from_epoch_ &&
        (tick.flags & databuffer::kTickRestart) == 0U)
      continue;
    from_tick_.reset();
    append(tick);
    ++ticks_;
  }
}

// Latest values, not rings: live, a state that lasted less than a look is passed over.
void Recorder::take_latest(std::int64_t tick) {
  state_.refresh();
  if (state_.has_value() && state_pace_.takes(state_.value(), tick)) append(recording::StateChange{state_.value()});
  if (status_pace_.is_due(tick) && status_.refresh()) {
    status_pace_.taken(tick);
    append(recording::StatusReport{status_.value()});
  }
  if (outputs_pace_.is_due(tick) && outputs_.refresh()) {
    outputs_pace_.taken(tick);
    append(outputs_.value());
  }
}

void Recorder::take_sweeps(std::uint64_t& lost) {
  while (take(session_->layout().sweeps, sweep_cursor_, sweep_, lost)) {
    if (extras_.sweeps)
      append(sweep_);
    else
      append(recording::mark_of(sweep_));
    ++sweeps_;
  }
}

void Recorder::take_patches() {
  const auto& layout = session_->layout();
  std::vector<std::uint64_t> ids;
  for (const databuffer::PatchSlot& slot : layout.patches) ids.push_back(slot.id.load(std::memory_order_acquire));
  std::sort(ids.begin(), ids.end());
  for (const std::uint64_t id : ids) {
    if (id <= newest_patch_ || !databuffer::read_patch(layout, id, patch_.map, patch_.pixels)) continue;
    newest_patch_ = id;
    if (!databuffer::why_refused(patch_.map)) append(patch_);
  }
}

}  // namespace yars::tools
