#include "inputmonitor/app/input_monitor_shell.hpp"

#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <system_error>
#include <utility>

#include "config/schema/slot_text.hpp"
#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/validation.hpp"
#include "databuffer/session/session_state.hpp"
#include "inputmonitor/device_decoder.hpp"
#include "inputmonitor/device_source.hpp"
#include "inputmonitor/keyboard_source.hpp"
#include "inputmonitor/learning.hpp"
#include "lib/file/output_file.hpp"
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

namespace {

using databuffer::monotonic_ns;
using error::Expected;
using error::fail;

constexpr int kPoll_ms = 200;  // maximum delay of a stop request and of a hint

// What the user types on standard input. On a terminal keys arrive one at a time and are not echoed.
class Typist {
 public:
  Typist() {
    struct stat status{};
    const bool is_terminal = isatty(STDIN_FILENO) == 1;
    if (is_foreground_terminal(STDIN_FILENO)) {
      if (auto mode = TerminalMode::enter(STDIN_FILENO)) mode_ = std::move(*mode);
    }
    if (mode_)
      typing_ = Typing::keys;
    else if (!is_terminal && fstat(STDIN_FILENO, &status) == 0 && !S_ISCHR(status.st_mode))
      typing_ = Typing::lines;  // a terminal of another program, /dev/null and a closed input have none
    is_open_ = typing_ != Typing::none;
  }

  Typing typing() const { return typing_; }
  bool is_open() const { return is_open_; }
  int descriptor() const { return is_open_ ? STDIN_FILENO : -1; }
  std::string read() {
    std::array<char, 256> bytes;
    const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    is_open_ = count > 0;
    return {bytes.data(), is_open_ ? static_cast<std::size_t>(count) : 0};
  }

 private:
  std::unique_ptr<TerminalMode> mode_;
  Typing typing_ = Typing::none;
  bool is_open_ = false;
};

// The dialogue with its device. A device that is unplugged is waited for while the user can type.
class LearningDialogue {
 public:
  LearningDialogue(std::string path, std::unique_ptr<DeviceReader> reader)
      : path_(std::move(path)),
        reader_(std::move(reader)),
        info_(reader_->info()),
        learning_(info_, rest_values(*reader_), typist_.typing()) {}

  // Runs until no request is left, the device is gone for good, the user ends, or a signal stops the program.
  void run() {
    say(learning_.begin(monotonic_ns()));
    // A FIFO is silent until a program writes into it; a device is silent until somebody moves it.
    if (!info_.known && !reader_->plays_once())
      say("      " + path_ + " is a FIFO: it waits for what another program writes into it\n");
    while (!learning_.finished() && !is_gone_ && !runtime::stop_requested()) {
      std::array<pollfd, 2> wanted{
          {{reader_ ? reader_->descriptor() : -1, POLLIN, 0}, {typist_.descriptor(), POLLIN, 0}}};
      poll(wanted.data(), wanted.size(), kPoll_ms);
      if (wanted[1].revents != 0) say(learning_.type(typist_.read(), monotonic_ns()));
      if (reader_)
        read_device();
      else
        is_gone_ = !find_device() && !typist_.is_open();
      say(learning_.wait(monotonic_ns()));
    }
  }
  const Learning& learning() const { return learning_; }
  const DeviceInfo& info() const { return info_; }
  // The device went away before the last request, and nobody could type.
  bool is_gone() const { return is_gone_; }

 private:
  static Learning::RestValues rest_values(const DeviceReader& reader) {
    const auto state = reader.state();
    return state ? state->axes : Learning::RestValues{};
  }
  static void say(const std::string& text) {
    if (!text.empty()) std::cerr << text << std::flush;
  }

  void read_device() {
    std::array<std::byte, 64 * kRecordBytes> bytes;
    std::size_t count = 0;
    const auto outcome = reader_->read(bytes, count);
    for (const RawEvent& raw : stream_.feed({bytes.data(), count})) say(learning_.feed(raw, monotonic_ns()));
    if (outcome != DeviceReader::Outcome::gone || learning_.finished()) return;
    is_gone_ = reader_->plays_once() || !typist_.is_open();
    stream_.restart();
    if (is_gone_) return;
    // A FIFO is opened again before it is closed, so that nothing is lost of what the next program writes.
    if (info_.known || !find_device()) reader_.reset();
    if (!reader_) say(path_ + " was unplugged: plug it in again to go on, or q ends and keeps what was learned\n");
  }

  // Opens the same device again. False: it is not there.
  bool find_device() {
    auto reader = DeviceReader::open(path_);
    if (!reader) return false;
    const DeviceInfo& found = (*reader)->info();
    if (found.known != info_.known || found.vendor != info_.vendor || found.product != info_.product) return false;
    reader_ = std::move(*reader);
    if (info_.known) say(learning_.reconnect(rest_values(*reader_), monotonic_ns()));
    return true;
  }

  std::string path_;
  Typist typist_;
  std::unique_ptr<DeviceReader> reader_;  // null: unplugged
  DeviceInfo info_;
  Learning learning_;
  RecordStream stream_;
  bool is_gone_ = false;
};

// A map's name is written behind a comma, as evdev:PATH,NAME, so it has none.
std::string map_name(const std::string& file) {
  if (file.empty()) return "learned";
  std::string name = std::filesystem::path(file).stem().string();
  std::ranges::replace(name, ',', '-');
  return name;
}

// The text as one word of a shell's command line.
std::string shell_word(const std::string& text) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || strchr("/._-:,+@%=", c);
  };
  if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + '\'';
}

Expected<void> write_map(const LearningDialogue& dialogue, const std::string& path, const std::string& file,
                         const std::string& session) {
  const std::string name = map_name(file);
  const std::string text =
      "; Made by input-monitor --learn.\n" + config::print_devices({dialogue.learning().device(name)});
  const std::size_t learned = dialogue.learning().learned();
  const std::string count = text::counted(learned, "control");
  if (file.empty()) {
    std::cerr << "\nThe map, with " << count << ":\n";
    std::cout << text;
    return {};
  }
  if (auto written = file::write_file(file, text); !written) {
    std::cerr << "\nThe map, with " << count << ", could not be written; here it is:\n";
    std::cout << text;
    return written;
  }
  // As a shell reads them, from any folder.
  const std::string map = shell_word(std::filesystem::absolute(file).lexically_normal().string());
  const std::string device = std::filesystem::absolute(path).lexically_normal().string();
  const std::string source = dialogue.info().known ? "" : " --source " + shell_word("evdev:" + device + ',' + name);
  std::cerr << "\nWrote " << file << ": " << count << ", map " << name << ".\n"
            << "To use it: scripts/start --session " << session << " --no-input, and beside it\n"
            << "  input-monitor --session " << session << " --config " << map << source << '\n';
  return {};
}

}  // namespace

Expected<void> learn_device(const std::string& path, const std::string& file, const std::string& session) {
  auto reader = DeviceReader::open(path);
  if (!reader) return tl::unexpected(reader.error());
  std::error_code problem;
  if (std::filesystem::is_regular_file(file, problem)) std::cerr << file << " is there already and will be replaced.\n";
  LearningDialogue dialogue(path, std::move(*reader));
  dialogue.run();
  const bool is_gone = dialogue.is_gone();
  if (dialogue.learning().learned() == 0)
    return fail(path, "at least one learned control", is_gone ? "a disconnected device" : "none",
                "nothing was written");
  if (auto written = write_map(dialogue, path, file, session); !written) return written;
  if (is_gone && !dialogue.learning().finished())
    return fail(path, "a device connected until the last control", "a disconnection",
                "the map has the controls learned so far");
  return {};
}

}  // namespace yars::inputmonitor
