#include "inputmonitor/app/input_monitor_shell.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <utility>

#include "config/schema/slot_text.hpp"
#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/validation.hpp"
#include "databuffer/runtime/process.hpp"
#include "inputmonitor/device_decoder.hpp"
#include "inputmonitor/device_source.hpp"
#include "inputmonitor/learning.hpp"
#include "lib/file/output_file.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"

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

void InputMonitorShell::run(databuffer::TickLoop& loop) {
  if (loop.lockstep() || source_->follows_sim_time())
    run_by_ticks(loop);
  else
    run_by_input();
  push(source_->release(), {databuffer::monotonic_ns(), session_->sim_time_ns()});
  if (caption_shown_) session_->layout().caption.clear();
}

void InputMonitorShell::run_by_ticks(databuffer::TickLoop& loop) {
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
  while (!databuffer::stop_requested() && !source_->ended()) {
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
    if (databuffer::validate(applied.event)) continue;
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

namespace {

using error::Expected;
using error::fail;

// Learning dialogue: prompts the user at the terminal and reads the device.
class LearningDialogue {
 public:
  LearningDialogue(DeviceReader& reader, Learning& learning) : reader_(&reader), learning_(&learning) {}

  // Runs until no prompt is left, the device disconnects, the user quits, or a signal stops the program. Returns true
  // if the device has disconnected.
  bool run() {
    show_prompt();
    while (!learning_->finished() && !ended_ && !databuffer::stop_requested()) {
      std::array<pollfd, 2> wanted{{{reader_->descriptor(), POLLIN, 0}, {stdin_open_ ? STDIN_FILENO : -1, POLLIN, 0}}};
      poll(wanted.data(), wanted.size(), kMaxWait_ms);
      if (wanted[1].revents != 0) read_commands();
      if (!read_device()) return true;
    }
    return false;
  }

 private:
  void show_prompt() const {
    if (!learning_->finished()) std::cerr << "? " << learning_->prompt() << std::endl;
  }

  bool read_device() {
    std::array<std::byte, 64 * kRecordBytes> bytes;
    std::size_t count = 0;
    const auto outcome = reader_->read(bytes, count);
    for (const RawEvent& raw : stream_.feed({bytes.data(), count})) {
      const std::string answer = learning_->feed(raw);
      if (answer.empty()) continue;
      std::cerr << "  " << answer << '\n';
      show_prompt();
    }
    return outcome != DeviceReader::Outcome::gone;
  }

  void read_commands() {
    std::array<char, 256> bytes;
    const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    stdin_open_ = count > 0;
    for (ssize_t i = 0; i < count; ++i) {
      const char command = bytes[static_cast<std::size_t>(i)];
      if (command == 's') learning_->skip();
      if (command == 'b') learning_->back();
      if (command == 'q') ended_ = true;
      if (command == 's' || command == 'b') show_prompt();
    }
  }

  DeviceReader* reader_;
  Learning* learning_;
  RecordStream stream_;
  bool stdin_open_ = true;  // standard input is not at its end
  bool ended_ = false;
};

Expected<void> write_map(const Learning& learning, const std::string& file) {
  const std::string name = file.empty() ? "learned" : std::filesystem::path(file).stem().string();
  const std::string text = "; Made by input-monitor --learn.\n" + config::print_devices({learning.device(name)});
  if (file.empty()) {
    std::cout << text;
    return {};
  }
  if (auto written = file::write_file(file, text); !written) return written;
  std::cerr << "wrote " << file << ": " << learning.learned() << " controls, map " << name
            << "; input-monitor --config " << file << " uses it\n";
  return {};
}

}  // namespace

Expected<void> learn_device(const std::string& path, const std::string& file) {
  const auto reader = DeviceReader::open(path);
  if (!reader) return tl::unexpected(reader.error());
  const auto state = (*reader)->state();
  Learning learning((*reader)->info(), state ? state->axes : decltype(DeviceState::axes){});
  std::cerr
      << "Move the control that each prompt names. Commands, each with Enter: s skips the control, b goes back to the\n"
         "previous one, q ends and writes the map.\n";
  const bool disconnected = LearningDialogue(**reader, learning).run();
  if (learning.learned() == 0)
    return fail(path, "at least one learned control", disconnected ? "a disconnected device" : "none",
                "nothing was written");
  if (auto written = write_map(learning, file); !written) return written;
  if (disconnected && !learning.finished())
    return fail(path, "a device connected until the last prompt", "a disconnection at " + learning.prompt(),
                "the map has the controls learned so far");
  return {};
}

}  // namespace yars::inputmonitor
