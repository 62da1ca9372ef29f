#include "inputmonitor/app/learning_shell.hpp"

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

#include "config/schema/slot_text.hpp"
#include "databuffer/session/session_state.hpp"
#include "inputmonitor/device_decoder.hpp"
#include "inputmonitor/device_source.hpp"
#include "inputmonitor/learning.hpp"
#include "inputmonitor/terminal.hpp"
#include "lib/file/output_file.hpp"
#include "lib/text/plain_text.hpp"
#include "runtime/process.hpp"

namespace yars::inputmonitor {

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
