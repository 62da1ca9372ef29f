#include "tools/session/recorder.hpp"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/validation.hpp"
#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/receivers.hpp"
#include "databuffer/session/session_layout.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::tools {

namespace {

constexpr std::int64_t kTicksBetweenStatus = 200;          // 1 s of sim time between RecorderStatus records
constexpr std::int64_t kRetryInterval_ns = 5'000'000'000;  // 5 s between attempts to write after a write error
constexpr std::int64_t kCheckInterval_ns = 2'000'000'000;  // 2 s between checks that the file is still at its path

// Reads the next record of a ring and advances `cursor`. Adds the number of overwritten, unread records to `lost`.
// False: the ring has no new record.
template <class Ring, class Record>
bool take(const Ring& ring, std::uint64_t& cursor, Record& record, std::uint64_t& lost) {
  const auto outcome = ring.read(cursor, record);
  lost += outcome.lost;
  return outcome.delivered;
}

void log_problem(const error::Error& problem) {
  log::warning(problem.message() + "; the recorder tries again every 5 s");
}

}  // namespace

Recorder::Recorder(databuffer::Session& session, recording::RecordingWriter& writer, RecordedExtras extras,
                   bool from_oldest)
    : session_(&session),
      writer_(&writer),
      extras_(extras),
      state_(session.layout().radar_state),
      status_(session.layout().model_status),
      outputs_(session.layout().outputs) {
  if (const auto state = databuffer::read_valid(session.layout().radar_state)) vtr_request_ = state->vtr_request;
  if (from_oldest)
    append_flight_source();
  else
    begin_here();
}

bool Recorder::holds_branch(const databuffer::Session& session) {
  const auto& layout = session.layout();
  return layout.model_ticks.oldest() == 0 && layout.applied_events.oldest() == 0;
}

bool Recorder::is_branch(const databuffer::Session& session, const recording::BranchPoint& point) {
  const auto& ring = session.layout().model_ticks;
  std::uint64_t cursor = 0;
  databuffer::ModelTick first{};
  first.tick = session.sim_time_ns() / radar::kTickNanoseconds;
  first.epoch = session.clock().epoch;
  ring.read(cursor, first);  // while there is none, the hand-over holds the clock at the first tick
  return first.tick == point.tick + 1 && first.epoch == point.epoch;
}

void Recorder::continue_branch(const recording::BranchPoint& point) {
  tick_cursor_ = event_cursor_ = sweep_cursor_ = traffic_cursor_ = 0;
  branch_tick_ = point.tick;
  branch_epoch_ = point.epoch;
  from_tick_.reset();
  vtr_request_ = point.state.vtr_request;
}

void Recorder::append_flight_source() {
  file_number_ = writer_->files();
  if (!extras_.flight_source.empty()) append(recording::flight_source(extras_.flight_source));
}

// True if the record is one of those that the set has gone on from.
template <class T>
bool Recorder::is_in_branch(const T& record) const {
  return branch_tick_ && record.epoch == branch_epoch_ && record.tick <= *branch_tick_;
}

void Recorder::begin_here() {
  const auto& layout = session_->layout();
  // Resets the rate limits, so that each start writes the radar state even if it has not changed.
  state_pace_ = {};
  status_pace_ = outputs_pace_ = {};
  branch_tick_.reset();
  if (file_number_ != writer_->files()) {
    patches_seen_.clear();
    append_flight_source();
  }
  tick_cursor_ = layout.model_ticks.next();
  event_cursor_ = layout.applied_events.next();
  sweep_cursor_ = layout.sweeps.next();
  const std::uint64_t traffic = layout.traffic_latched.next();
  traffic_cursor_ = traffic > 0 ? traffic - 1 : 0;  // the newest traffic is still in effect
  world_cursor_.reset();
  // Ticks up to the tick of the status are not written: the replay starts from this status.
  const auto status = databuffer::read_valid(layout.model_status);
  if (!status) return;
  append(recording::StartingPoint{*status});
  from_tick_ = status->tick + 1;
  from_epoch_ = status->epoch;
  // The model publishes a tick before it computes, and the status after it. So ticks after that of the status may be
  // published already.
  constexpr std::uint64_t kTicksWithoutStatus = 64;
  begin_cursor_ = tick_cursor_;
  tick_cursor_ -= std::min(tick_cursor_, kTicksWithoutStatus);
}

template <class T>
void Recorder::append(const T& record) {
  if (outcome_) handle_result(writer_->append(record));
}

// After an error nothing is written until retry_after_error() succeeds. The process continues, and its RecorderStatus
// tells the display the problem.
void Recorder::handle_result(error::Expected<void> written) {
  if (written || !outcome_) return;
  outcome_ = std::move(written);
  resumes_writing_ = std::exchange(writing_, false);
  next_retry_ns_ = databuffer::monotonic_ns() + kRetryInterval_ns;
  log_problem(outcome_.error());
  session_->note(databuffer::NoteKind::loss, "recorder stopped: " + outcome_.error().found);
}

void Recorder::retry_after_error() {
  const std::int64_t now_ns = databuffer::monotonic_ns();
  if (outcome_ || now_ns < next_retry_ns_) return;
  next_retry_ns_ = now_ns + kRetryInterval_ns;
  if (auto resumed = writer_->resume(); !resumed) {
    if (resumed.error().found != outcome_.error().found) log_problem(resumed.error());
    outcome_ = std::move(resumed);
    return;
  }
  outcome_ = {};
  writing_ = resumes_writing_;
  log::info("the recording can be written again");
  session_->note(databuffer::NoteKind::loss, "recorder writes again");
  if (writing_) begin_here();
}

// Begins the next file when the current file has reached half of keep_bytes.
void Recorder::begin_next_file() {
  if (extras_.keep_bytes == 0 || !outcome_ || writer_->bytes() < extras_.keep_bytes / 2) return;
  handle_result(writer_->begin_next());
  if (outcome_) begin_here();
}

// Stops writing to a file that was removed or renamed. The next drain() begins a new one.
void Recorder::check_place() {
  const std::int64_t now_ns = databuffer::monotonic_ns();
  if (!outcome_ || now_ns < next_check_ns_) return;
  next_check_ns_ = now_ns + kCheckInterval_ns;
  handle_result(writer_->check_place());
  if (!outcome_) next_retry_ns_ = now_ns;
}

template <class T>
bool Recorder::is_valid(const T& record) {
  const auto refusal = databuffer::validate(record);
  if (!refusal) return true;
  ++refused_;
  session_->note(databuffer::NoteKind::refusal, "not recorded: " + *refusal);
  return false;
}

void Recorder::flush() {
  if (outcome_) handle_result(writer_->flush());
}

void Recorder::drain(std::int64_t tick) {
  state_.refresh();
  retry_after_error();
  check_place();
  if (writing_) take_all(tick);
  if (writing_) begin_next_file();
  if (state_.has_value()) apply_vtr_request(state_.value().vtr_request);
  publish(tick);
}

// Stops or starts writing if PB 12 was pressed an odd number of times since the last call. The press that stops writing
// is recorded; the press that starts writing is not. During a write error, a press toggles whether writing starts again
// after the error.
void Recorder::apply_vtr_request(std::uint32_t vtr_request) {
  const bool changes = (vtr_request - vtr_request_) % 2 != 0;
  vtr_request_ = vtr_request;
  if (!changes) return;
  if (!outcome_) {
    resumes_writing_ = !resumes_writing_;
    return;
  }
  writing_ = !writing_;
  if (writing_)
    begin_here();
  else
    flush();
  log::info(writing_ ? "resumed writing" : "stopped writing");
}

void Recorder::publish(std::int64_t tick) {
  databuffer::RecorderStatus status = published_;
  status.bytes = writer_->bytes();
  status.writing = writing_ ? 1 : 0;
  status.vtr_request = vtr_request_;
  std::ranges::fill(status.problem, '\0');
  if (!outcome_) outcome_.error().found.copy(status.problem, sizeof status.problem - 1);
  const bool changed = std::memcmp(&status, &published_, sizeof status) != 0;
  const bool due = tick < status.tick || tick - status.tick >= kTicksBetweenStatus;
  if (!changed && !due && has_published_) return;
  status.tick = tick;
  status.sim_time_ns = tick * radar::kTickNanoseconds;
  session_->layout().recorder_status.publish(status);
  published_ = status;
  has_published_ = true;
}

void Recorder::take_all(std::int64_t tick) {
  recording::Gap gap{};
  take_ticks(gap.ticks);
  databuffer::AppliedEvent event{};
  while (take(session_->layout().applied_events, event_cursor_, event, gap.events))
    if (is_valid(event)) append(event);
  take_latest(tick);
  take_sweeps(gap.sweeps);
  if (extras_.patches) take_patches();
  if (gap.ticks + gap.events + gap.sweeps > 0) {
    append(gap);
    session_->note(databuffer::NoteKind::loss, "recorder fell behind by " + text::counted(gap.ticks, "tick") + ", " +
                                                   text::counted(gap.events, "event") + ", " +
                                                   text::counted(gap.sweeps, "sweep"));
  }
}

// True if the status from which the replay starts includes this tick, the one before tick_cursor_.
bool Recorder::is_before_start(const databuffer::ModelTick& tick) const {
  const bool earlier = tick.epoch < from_epoch_ || (tick.epoch == from_epoch_ && tick.tick < *from_tick_);
  // A model that has been restarted since then begins with an earlier tick.
  const bool restart = tick_cursor_ > begin_cursor_ && (tick.flags & databuffer::kTickRestart) != 0U;
  return earlier && !restart;
}

void Recorder::take_ticks(std::uint64_t& lost) {
  databuffer::ModelTick tick{};
  while (take(session_->layout().model_ticks, tick_cursor_, tick, lost)) {
    if (from_tick_ && is_before_start(tick)) continue;
    from_tick_.reset();
    take_traffic_before(tick);
    take_world_before(tick);
    if (!is_valid(tick)) continue;
    append(tick);
    ++ticks_;
  }
}

// Appends the traffic records up to the one that the model used at this tick. The caller appends the tick afterwards.
// Lost traffic records are not counted, because a later record has replaced them.
void Recorder::take_traffic_before(const databuffer::ModelTick& tick) {
  databuffer::Traffic traffic{};
  while (traffic_cursor_ < tick.traffic && session_->layout().traffic_latched.read(traffic_cursor_, traffic).delivered)
    if (is_valid(traffic)) append(traffic);
}

// Appends the worlds up to the one in effect at this tick. The first tick since writing began has only that one.
void Recorder::take_world_before(const databuffer::ModelTick& tick) {
  if (!world_cursor_) world_cursor_ = std::max<std::uint64_t>(tick.world, 1) - 1;
  databuffer::WorldState world{};
  while (*world_cursor_ < tick.world && session_->layout().world_latched.read(*world_cursor_, world).delivered)
    if (is_valid(world)) append(world);
}

// Appends radar state, model status and outputs at a limited rate. The segment keeps only the latest value of each: in
// a live session, a state that lasted less than one poll is missed.
void Recorder::take_latest(std::int64_t tick) {
  if (state_.has_value() && !is_in_branch(state_.value()) && state_pace_.takes(state_.value(), tick) &&
      is_valid(state_.value()))
    append(recording::StateChange{state_.value()});
  if (status_pace_.is_due(tick) && status_.refresh()) {
    status_pace_.taken(tick);
    if (!is_in_branch(status_.value()) && is_valid(status_.value())) append(recording::StatusReport{status_.value()});
  }
  if (outputs_pace_.is_due(tick) && outputs_.refresh()) {
    outputs_pace_.taken(tick);
    if (!is_in_branch(outputs_.value()) && is_valid(outputs_.value())) append(outputs_.value());
  }
}

void Recorder::take_sweeps(std::uint64_t& lost) {
  while (take(session_->layout().sweeps, sweep_cursor_, sweep_, lost)) {
    if (is_in_branch(sweep_) || !is_valid(sweep_)) continue;
    if (extras_.sweeps)
      append(sweep_);
    else
      append(recording::digest_of(sweep_));
    ++sweeps_;
  }
}

void Recorder::take_patches() {
  const auto& layout = session_->layout();
  std::vector<std::uint64_t> ids;
  for (const databuffer::PatchSlot& slot : layout.patches) ids.push_back(slot.id.load(std::memory_order_acquire));
  std::sort(ids.begin(), ids.end());
  // Remembers all ids in the pool. If only the largest were remembered, a damaged, very large id would hide later maps.
  std::erase_if(patches_seen_, [&ids](std::uint64_t id) { return std::ranges::find(ids, id) == ids.end(); });
  for (const std::uint64_t id : ids) {
    if (id == 0 || std::ranges::find(patches_seen_, id) != patches_seen_.end() ||
        !databuffer::read_patch(layout, id, patch_.map, patch_.pixels))
      continue;
    patches_seen_.push_back(id);
    if (branch_tick_ && patch_.map.epoch == branch_epoch_ && patch_.map.end_tick <= *branch_tick_) continue;
    if (is_valid(patch_.map)) append(patch_);
  }
}

}  // namespace yars::tools
