#include "inputmonitor/app/input_monitor_shell.hpp"

#include <array>
#include <cstring>
#include <utility>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/validation.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"
#include "runtime/process.hpp"

namespace yars::inputmonitor {

namespace {

constexpr int kMaxWait_ms = 200;  // maximum delay of a stop request and maximum interval of heartbeats

}  // namespace

InputMonitorShell::InputMonitorShell(databuffer::Session& session, std::unique_ptr<EventSource> source, int lane)
    : session_(&session),
      source_(std::move(source)),
      lane_(static_cast<std::size_t>(lane)),
      applied_cursor_(session.layout().applied_events.next()) {
  advice_.refresh(session.layout().advice);
  idle_count_ = advice_.value().idle_count;
}

void InputMonitorShell::run(runtime::TickLoop& loop) {
  if (loop.lockstep() || source_->follows_sim_time())
    run_by_ticks(loop);
  else
    run_by_input();
  push(source_->release(), {databuffer::monotonic_ns(), session_->sim_time_ns()});
  if (caption_shown_) session_->layout().caption.clear();
}

void InputMonitorShell::run_by_ticks(runtime::TickLoop& loop) {
  while (const auto due = loop.wait()) {
    const Moment moment{databuffer::monotonic_ns(), due->sim_time_ns};
    if (source_->has_captions()) observe();
    if (!source_->ended()) push(source_->take(moment), moment);
    if (source_->has_captions()) publish_caption();
    report_notices();
    loop.done(*due);
    if (source_->ended() && !loop.lockstep()) return;
  }
}

void InputMonitorShell::run_by_input() {
  const auto now = [this] { return Moment{databuffer::monotonic_ns(), session_->sim_time_ns()}; };
  while (!runtime::stop_requested() && !source_->ended()) {
    session_->heartbeat();
    source_->wait(now(), kMaxWait_ms);
    const Moment moment = now();
    push(source_->take(moment), moment);
    report_notices();
    report_idle_event();
  }
}

void InputMonitorShell::observe() {
  const auto& ring = std::as_const(*session_).layout().applied_events;
  std::vector<SeenEvent> seen;
  databuffer::AppliedEvent applied{};
  while (ring.read(applied_cursor_, applied).delivered) {
    if (databuffer::validate(applied)) continue;
    seen.push_back({applied.event, applied.effective == databuffer::kEventDone, applied.lane == lane_});
  }
  source_->observe(seen);
}

void InputMonitorShell::publish_caption() {
  const databuffer::Caption* caption = source_->caption();
  auto& slot = session_->layout().caption;
  if (caption == nullptr) {
    if (caption_shown_) slot.clear();
    caption_shown_.reset();
    return;
  }
  if (caption_shown_ && std::memcmp(&*caption_shown_, caption, sizeof *caption) == 0) return;
  slot.publish(*caption);
  caption_shown_ = *caption;
}

// Says why the newest event of this source was without effect. Of several at once, only the last is known.
void InputMonitorShell::report_idle_event() {
  if (!advice_.refresh(session_->layout().advice)) return;
  const databuffer::PilotAdvice& advice = advice_.value();
  if (std::exchange(idle_count_, advice.idle_count) == advice.idle_count || advice.idle_lane != lane_) return;
  const databuffer::InputEvent& event = recent_[advice.idle_number % recent_.size()];
  const std::string what = event.number == advice.idle_number ? databuffer::text_of(event) : "an event";
  log::info(what + ": " + std::string(text::text_of(advice.idle_reason)));
}

void InputMonitorShell::report_notices() {
  for (const Notice& notice : source_->notices()) {
    if (notice.is_warning)
      log::warning(notice.text);
    else
      log::info(notice.text);
    if (!notice.for_pilot)
      session_->note(notice.is_warning ? databuffer::NoteKind::loss : databuffer::NoteKind::restart, notice.text);
  }
}

void InputMonitorShell::push(const std::vector<databuffer::InputEvent>& events, const Moment& moment) {
  for (databuffer::InputEvent event : events) {
    event.session_time_ns = moment.sim_time_ns;
    event.monotonic_ns = moment.monotonic_ns;
    event.number = ++number_;
    recent_[event.number % recent_.size()] = event;
    log::debug(databuffer::text_of(event));
    if (session_->layout().input.push(lane_, event)) continue;
    session_->note(databuffer::NoteKind::loss, "input lane full, dropped: " + databuffer::text_of(event));
    log::warning("the input lane is full, is state-machine running? dropped: " + databuffer::text_of(event));
  }
}

}  // namespace yars::inputmonitor
