#include "inputmonitor/input_monitor_shell.hpp"

#include <utility>

#include "databuffer/log.hpp"
#include "databuffer/program.hpp"
#include "databuffer/records/event_text.hpp"

namespace yars::inputmonitor {

namespace {

constexpr int kLongestWait_ms = 200;  // [ms] a request to stop and the heartbeat wait no longer

}  // namespace

InputMonitorShell::InputMonitorShell(databuffer::Session& session, std::unique_ptr<EventSource> source, int lane)
    : session_(&session), source_(std::move(source)), lane_(static_cast<std::size_t>(lane)) {}

void InputMonitorShell::run(databuffer::TickLoop& loop) {
  if (loop.lockstep() || source_->follows_sim_time())
    run_by_ticks(loop);
  else
    run_by_input();
  push(source_->release(), {databuffer::monotonic_ns(), session_->sim_time_ns()});
}

void InputMonitorShell::run_by_ticks(databuffer::TickLoop& loop) {
  while (const auto due = loop.wait()) {
    const Moment moment{databuffer::monotonic_ns(), due->sim_time_ns};
    if (!source_->ended()) push(source_->take(moment), moment);
    tell_news();
    loop.done(*due);
    if (source_->ended() && !loop.lockstep()) return;
  }
}

void InputMonitorShell::run_by_input() {
  const auto now = [this] { return Moment{databuffer::monotonic_ns(), session_->sim_time_ns()}; };
  while (!databuffer::stop_requested() && !source_->ended()) {
    session_->heartbeat();
    source_->wait(now(), kLongestWait_ms);
    const Moment moment = now();
    push(source_->take(moment), moment);
    tell_news();
  }
}

void InputMonitorShell::tell_news() {
  for (const News& news : source_->news()) {
    if (news.is_trouble)
      databuffer::log_warning(news.text);
    else
      databuffer::log_info(news.text);
    session_->note(news.is_trouble ? databuffer::NoteKind::loss : databuffer::NoteKind::restart, news.text);
  }
}

void InputMonitorShell::push(const std::vector<databuffer::InputEvent>& events, const Moment& moment) {
  for (databuffer::InputEvent event : events) {
    event.session_time_ns = moment.sim_time_ns;
    event.monotonic_ns = moment.monotonic_ns;
    event.number = ++number_;
    databuffer::log_debug(databuffer::text_of(event));
    if (session_->layout().input.push(lane_, event)) continue;
    session_->note(databuffer::NoteKind::loss, "input lane full, dropped: " + databuffer::text_of(event));
    databuffer::log_warning("the input lane is full, is state-machine running? dropped: " + databuffer::text_of(event));
  }
}

}  // namespace yars::inputmonitor
