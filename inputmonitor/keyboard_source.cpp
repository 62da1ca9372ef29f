#include "inputmonitor/keyboard_source.hpp"

#include <GLFW/glfw3.h>
#include <poll.h>
#include <signal.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <utility>

namespace yars::inputmonitor {

namespace {

using databuffer::Key;

constexpr char kEscape = '\x1b';
constexpr std::size_t kMaxSequence = 16;  // [bytes] no key has a longer sequence

template <class Code, std::size_t Size>
Key find_key(const std::array<std::pair<Code, Key>, Size>& table, Code code) {
  const auto* row = std::ranges::find(table, code, &std::pair<Code, Key>::first);
  return row == table.end() ? Key::none : row->second;
}

// Keys by the last byte of sequences such as ESC [ A and ESC O A.
constexpr std::array<std::pair<char, Key>, 9> kFinals{{{'A', Key::up},
                                                       {'B', Key::down},
                                                       {'C', Key::right},
                                                       {'D', Key::left},
                                                       {'P', Key::f1},
                                                       {'Q', Key::f2},
                                                       {'R', Key::f3},
                                                       {'S', Key::f4},
                                                       {'M', Key::enter}}};
// Keys by the number in sequences such as ESC [ 5 ~.
constexpr std::array<std::pair<std::string_view, Key>, 11> kNumbers{{{"5", Key::page_up},
                                                                     {"6", Key::page_down},
                                                                     {"11", Key::f1},
                                                                     {"12", Key::f2},
                                                                     {"13", Key::f3},
                                                                     {"14", Key::f4},
                                                                     {"15", Key::f5},
                                                                     {"17", Key::f6},
                                                                     {"18", Key::f7},
                                                                     {"19", Key::f8},
                                                                     {"23", Key::f11}}};
// Keys by the last byte of sequences such as ESC [ [ A (Linux console).
constexpr std::array<std::pair<char, Key>, 5> kLinuxFunctions{
    {{'A', Key::f1}, {'B', Key::f2}, {'C', Key::f3}, {'D', Key::f4}, {'E', Key::f5}}};

Key key_of_byte(char byte) {
  if (byte == '\r' || byte == '\n') return Key::enter;
  if (byte == '\t') return Key::tab;
  return databuffer::key_of_character(byte);
}

bool is_final(char byte) {
  return byte >= '@' && byte <= '~';
}
bool is_parameter(char byte) {
  return byte >= ' ' && byte <= '?';
}

enum class Shape { unfinished, complete, invalid };

// `sequence`: ESC and at least one more byte.
Shape shape_of(std::string_view sequence) {
  const char introducer = sequence[1];
  const bool linux_function = sequence.starts_with("\x1b[[");
  if (introducer != '[' && introducer != 'O') return Shape::invalid;
  if (sequence.size() == 2 || (linux_function && sequence.size() == 3)) return Shape::unfinished;
  if (is_final(sequence.back())) return Shape::complete;
  return is_parameter(sequence.back()) && sequence.size() < kMaxSequence ? Shape::unfinished : Shape::invalid;
}

Key key_of_sequence(std::string_view sequence) {
  if (sequence.starts_with("\x1b[[")) return find_key(kLinuxFunctions, sequence.back());
  // Ignored: a semicolon and the code of the modifier keys after it.
  std::string_view parameter = sequence.substr(2, sequence.size() - 3);
  parameter = parameter.substr(0, parameter.find(';'));
  if (sequence.back() == '~') return find_key(kNumbers, parameter);
  return parameter.empty() || parameter == "1" ? find_key(kFinals, sequence.back()) : Key::none;
}

}  // namespace

std::vector<KeyChange> TerminalDecoder::feed(std::string_view bytes, std::int64_t now_ns) {
  Changes changes = advance(now_ns);
  for (const char byte : bytes) take_byte(byte, now_ns, changes);
  return changes;
}

void TerminalDecoder::take_byte(char byte, std::int64_t now_ns, Changes& changes) {
  if (byte == kEscape) {
    sequence_ = kEscape;
    last_byte_ns_ = now_ns;
  } else if (sequence_.empty()) {
    press_key(key_of_byte(byte), now_ns, changes);
  } else {
    continue_sequence(byte, now_ns, changes);
  }
}

void TerminalDecoder::continue_sequence(char byte, std::int64_t now_ns, Changes& changes) {
  sequence_ += byte;
  last_byte_ns_ = now_ns;
  const Shape shape = shape_of(sequence_);
  if (shape == Shape::unfinished) return;
  const std::string sequence = std::exchange(sequence_, {});
  if (shape == Shape::complete) press_key(key_of_sequence(sequence), now_ns, changes);
}

void TerminalDecoder::press_key(Key key, std::int64_t now_ns, Changes& changes) {
  if (key == Key::none) return;
  const auto pulse = std::ranges::find(pulses_, key, &Pulse::key);
  if (pulse == pulses_.end()) {
    changes.push_back({key, true});
    changes.push_back({key, false});
    return;
  }
  if (!pulse->end_ns) changes.push_back({key, true});
  pulse->end_ns = now_ns + kArrowPulse_ns;
}

std::vector<KeyChange> TerminalDecoder::advance(std::int64_t now_ns) {
  Changes changes;
  for (Pulse& pulse : pulses_) {
    if (!pulse.end_ns || now_ns < *pulse.end_ns) continue;
    pulse.end_ns.reset();
    changes.push_back({pulse.key, false});
  }
  if (!sequence_.empty() && now_ns - last_byte_ns_ >= kEscapeTimeout_ns) {
    const bool alone = sequence_.size() == 1;
    sequence_.clear();
    if (alone) press_key(Key::escape, now_ns, changes);
  }
  return changes;
}

std::optional<std::int64_t> TerminalDecoder::deadline_ns() const {
  std::optional<std::int64_t> deadline;
  if (!sequence_.empty()) deadline = last_byte_ns_ + kEscapeTimeout_ns;
  for (const Pulse& pulse : pulses_)
    if (pulse.end_ns) deadline = std::min(deadline.value_or(*pulse.end_ns), *pulse.end_ns);
  return deadline;
}

namespace {

// Signals that end the process without running destructors. SIGINT and SIGTERM only request a stop.
constexpr std::array kFatalSignals{SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGQUIT, SIGHUP};

// Terminal settings and signal actions to restore. The object is global, because a signal handler receives no pointer.
struct Saved {
  std::atomic<int> descriptor{-1};
  termios settings{};
  std::array<struct sigaction, kFatalSignals.size()> actions{};
};
Saved saved;

void restore() {
  const int descriptor = saved.descriptor.exchange(-1);
  if (descriptor >= 0) tcsetattr(descriptor, TCSANOW, &saved.settings);
}

// SA_RESETHAND removes the handler on entry, so the signal raised again has its default effect.
void restore_and_raise(int signal_number) {
  restore();
  raise(signal_number);
}

void install_handlers() {
  struct sigaction action{};
  action.sa_handler = restore_and_raise;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  for (std::size_t index = 0; index < kFatalSignals.size(); ++index)
    sigaction(kFatalSignals[index], &action, &saved.actions[index]);
}

void remove_handlers() {
  for (std::size_t index = 0; index < kFatalSignals.size(); ++index)
    sigaction(kFatalSignals[index], &saved.actions[index], nullptr);
}

termios byte_by_byte(termios settings) {
  settings.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  settings.c_iflag &= ~static_cast<tcflag_t>(IXON);  // off, so that Ctrl-S does not block output
  settings.c_cc[VSUSP] = _POSIX_VDISABLE;
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  return settings;
}

}  // namespace

bool is_foreground_terminal(int descriptor) {
  return isatty(descriptor) == 1 && tcgetpgrp(descriptor) == getpgrp();
}

error::Expected<std::unique_ptr<TerminalMode>> TerminalMode::enter(int descriptor) {
  if (!is_foreground_terminal(descriptor))
    return error::fail("standard input", "a terminal with this program in its foreground",
                       isatty(descriptor) == 1 ? "a terminal with another program in its foreground" : "no terminal",
                       "start input-monitor in a terminal of its own, or use --source window or script:FILE");
  if (tcgetattr(descriptor, &saved.settings) != 0)
    return error::fail("standard input", "a terminal whose settings can be read", std::strerror(errno));
  const termios raw = byte_by_byte(saved.settings);
  saved.descriptor = descriptor;
  install_handlers();
  std::unique_ptr<TerminalMode> mode(new TerminalMode);
  if (tcsetattr(descriptor, TCSANOW, &raw) != 0)
    return error::fail("standard input", "a terminal whose settings can be changed", std::strerror(errno));
  return mode;
}

TerminalMode::~TerminalMode() {
  // SIGTTOU is blocked, because tcsetattr sends it to a process in the background and would stop the process.
  sigset_t blocked;
  sigset_t before;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTTOU);
  pthread_sigmask(SIG_BLOCK, &blocked, &before);
  restore();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  remove_handlers();
}

std::string key_help_text() {
  std::string text = "keys:\n  2-9 A-K        push buttons 2 to 20\n";
  for (const databuffer::KeyHelp& one : databuffer::key_help()) {
    std::string keys = one.keys;
    keys.resize(15, ' ');
    text += "  " + keys + one.does + '\n';
  }
  return text + "  ? or F1        this help\n  Esc            ends these keys; the set runs on";
}

void Keyboard::change(databuffer::Key key, bool pressed) {
  if (pressed && databuffer::is_help(key)) notices_.push_back({false, key_help_text(), true});
  if (pressed && databuffer::is_dead_letter(key)) notices_.push_back({false, databuffer::kDeadKeyHelp, true});
  if (pressed && key == databuffer::Key::escape && !ended_) {
    notices_.push_back({false, "Esc ended " + name_ + "; the set runs on. input-monitor starts them again", true});
    ended_ = true;
  }
  append(state_.change(key, pressed));
}

namespace {

constexpr const char* kShortHelp = "? shows the keys, Esc ends them";
constexpr int kWidth = 640;  // [pixels] width of the window, which shows a title only
constexpr int kHeight = 80;  // [pixels]

Keyboard& keyboard_of(GLFWwindow* window) {
  return *static_cast<Keyboard*>(glfwGetWindowUserPointer(window));
}

void on_key(GLFWwindow* window, int code, int, int action, int) {
  if (action != GLFW_REPEAT) keyboard_of(window).change(databuffer::key_of_glfw(code), action == GLFW_PRESS);
}

void on_focus(GLFWwindow* window, int focused) {
  if (focused == GLFW_FALSE) keyboard_of(window).release_all();
}

// GLFW has no key for "?", whose place depends on the keyboard's layout.
void on_character(GLFWwindow* window, unsigned code) {
  if (code == '?') keyboard_of(window).change(databuffer::Key{'?'}, true);
  if (code == '?') keyboard_of(window).change(databuffer::Key{'?'}, false);
}

class KeyboardSource : public EventSource {
 public:
  explicit KeyboardSource(std::string name) : keyboard_(std::move(name)) {}
  std::vector<databuffer::InputEvent> release() override {
    keyboard_.release_all();
    return keyboard_.take();
  }
  bool ended() const override { return keyboard_.ended(); }
  bool follows_sim_time() const override { return false; }
  std::vector<Notice> notices() override { return keyboard_.notices(); }

 protected:
  Keyboard keyboard_;
};

class WindowSource final : public KeyboardSource {
 public:
  explicit WindowSource(GLFWwindow* window) : KeyboardSource("the keys of this window"), window_(window) {
    glfwSetWindowUserPointer(window_, &keyboard_);
    glfwSetKeyCallback(window_, on_key);
    glfwSetCharCallback(window_, on_character);
    glfwSetWindowFocusCallback(window_, on_focus);
  }
  WindowSource(const WindowSource&) = delete;
  WindowSource& operator=(const WindowSource&) = delete;
  ~WindowSource() override {
    glfwDestroyWindow(window_);
    glfwTerminate();
  }

  // GLFW does not expose the descriptor of the display connection.
  bool add_descriptors(std::vector<pollfd>&) const override { return false; }
  void wait(const Moment&, int max_wait_ms) override { glfwWaitEventsTimeout(static_cast<double>(max_wait_ms) * 1e-3); }

  std::vector<databuffer::InputEvent> take(const Moment&) override {
    glfwPollEvents();
    if (glfwWindowShouldClose(window_) == GLFW_TRUE) keyboard_.end();
    return keyboard_.take();
  }

  std::string description() const override { return std::string("a window; ") + kShortHelp; }

 private:
  GLFWwindow* window_;
};

error::Expected<std::unique_ptr<EventSource>> no_window() {
  const char* reason = nullptr;
  glfwGetError(&reason);
  return error::fail("--source window", "a display on which a window can be opened",
                     reason != nullptr ? reason : "none", "use --source terminal or script:FILE");
}

}  // namespace

error::Expected<std::unique_ptr<EventSource>> open_window_source(const std::string& session) {
  if (glfwInit() == GLFW_FALSE) return no_window();
  // No OpenGL context: the window draws nothing.
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  const std::string title = "YARS input (" + session + ")  " + kShortHelp;
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "yars-input-monitor");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "yars-input-monitor");
  GLFWwindow* window = glfwCreateWindow(kWidth, kHeight, title.c_str(), nullptr, nullptr);
  if (window != nullptr) return std::make_unique<WindowSource>(window);
  auto error = no_window();
  glfwTerminate();
  return error;
}

namespace {

// True when the descriptor has bytes or is at its end, within `milliseconds`.
bool readable_within(int descriptor, int milliseconds) {
  pollfd wanted{descriptor, POLLIN, 0};
  return poll(&wanted, 1, milliseconds) > 0;
}

class TerminalSource final : public KeyboardSource {
 public:
  explicit TerminalSource(std::unique_ptr<TerminalMode> mode)
      : KeyboardSource("the keys of this terminal"), mode_(std::move(mode)) {}

  bool add_descriptors(std::vector<pollfd>& wanted) const override {
    wanted.push_back({STDIN_FILENO, POLLIN, 0});
    return true;
  }
  std::optional<std::int64_t> deadline_ns() const override { return decoder_.deadline_ns(); }

  std::vector<databuffer::InputEvent> take(const Moment& moment) override {
    apply(decoder_.advance(moment.monotonic_ns));
    while (!keyboard_.ended() && readable_within(STDIN_FILENO, 0)) {
      std::array<char, 256> bytes;
      const ssize_t count = read(STDIN_FILENO, bytes.data(), bytes.size());
      // End of file or error: the terminal is closed.
      if (count <= 0) keyboard_.end();
      if (count > 0) apply(decoder_.feed({bytes.data(), static_cast<std::size_t>(count)}, moment.monotonic_ns));
    }
    return keyboard_.take();
  }

  std::string description() const override { return std::string("this terminal; ") + kShortHelp; }

 private:
  void apply(const std::vector<KeyChange>& changes) {
    for (const KeyChange& change : changes) keyboard_.change(change.key, change.pressed);
  }

  std::unique_ptr<TerminalMode> mode_;
  TerminalDecoder decoder_;
};

}  // namespace

error::Expected<std::unique_ptr<EventSource>> open_terminal_source() {
  auto mode = TerminalMode::enter(STDIN_FILENO);
  if (!mode) return tl::unexpected(mode.error());
  return std::make_unique<TerminalSource>(std::move(*mode));
}

}  // namespace yars::inputmonitor
