// Keyboard sources: keys typed in a window or a terminal, as input events. Terminal as a keyboard: decoder from bytes
// to key edges, and a terminal mode without line buffering and echo.
// Inputs: key edges (presses and releases) of a GLFW window; bytes of the terminal at standard input with the time of
// their arrival [ns, CLOCK_MONOTONIC]. Outputs: key edges; input events by databuffer/messages/key_map.hpp. The source
// ends at Escape, and when its window or terminal is closed.
// Errors: no display for a window; a descriptor that is not a terminal with this process in its foreground.
// Source: docs/commands.md#terminal
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "databuffer/messages/key_map.hpp"
#include "inputmonitor/event_source.hpp"
#include "lib/error/error.hpp"

namespace yars::inputmonitor {

// An ESC byte is the Escape key if no byte follows within 50 ms. In a sequence the next byte follows about 1 ms later,
// even at 9600 Bd.
inline constexpr std::int64_t kEscapeTimeout_ns = 50'000'000;
// An arrow key counts as held for 100 ms after each of its sequences. The usual interval of key repeats is shorter.
inline constexpr std::int64_t kArrowPulse_ns = 100'000'000;

struct KeyChange {
  databuffer::Key key = databuffer::Key::none;
  bool pressed = false;
};

// Decoder from terminal bytes to key edges. Pure: the time of each byte is an argument.
// Sequences: xterm (ESC [ A, ESC O A, ESC [ 5 ~, ESC O P, ESC [ 1 1 ~, with modifiers) and Linux console (ESC [ [ A).
// Terminals report no release. An arrow key therefore counts as held for kArrowPulse_ns after each sequence. Every
// other key gives a press and a release at once. Unknown sequences, and sequences that are incomplete after
// kEscapeTimeout_ns, are dropped.
class TerminalDecoder {
 public:
  // Decodes bytes read at `now_ns`. The result begins with the changes of advance(now_ns).
  std::vector<KeyChange> feed(std::string_view bytes, std::int64_t now_ns);
  // Changes that are due without further bytes: the release of arrow keys, the Escape key.
  std::vector<KeyChange> advance(std::int64_t now_ns);
  // Time [ns, CLOCK_MONOTONIC] of the next change by advance(); nullopt if there is none without further bytes.
  std::optional<std::int64_t> deadline_ns() const;

 private:
  using Changes = std::vector<KeyChange>;
  struct Pulse {
    databuffer::Key key;
    std::optional<std::int64_t> end_ns;  // nullopt: the key is not held
  };

  void take_byte(char byte, std::int64_t now_ns, Changes& changes);
  void continue_sequence(char byte, std::int64_t now_ns, Changes& changes);
  void press_key(databuffer::Key key, std::int64_t now_ns, Changes& changes);

  std::string sequence_;  // incomplete sequence, from its ESC byte on
  std::int64_t last_byte_ns_ = 0;
  std::array<Pulse, 4> pulses_{{{databuffer::Key::up, {}},
                                {databuffer::Key::down, {}},
                                {databuffer::Key::left, {}},
                                {databuffer::Key::right, {}}}};
};

// Scope guard: terminal without line buffering and echo. The destructor restores the settings. Fatal signals that
// can be caught, such as SIGSEGV and SIGHUP, also restore the settings. Ctrl-C still ends the program. Ctrl-Z is
// disabled, because a stopped program would leave the shell without echo. A process may have at most one instance.
class TerminalMode {
 public:
  // Errors: the descriptor is not a terminal, or this process is not in its foreground.
  static error::Expected<std::unique_ptr<TerminalMode>> enter(int descriptor);
  TerminalMode(const TerminalMode&) = delete;
  TerminalMode& operator=(const TerminalMode&) = delete;
  ~TerminalMode();

 private:
  TerminalMode() = default;
};

// True when the descriptor is a terminal with this process in its foreground.
bool is_foreground_terminal(int descriptor);

// Common part of keyboard sources: turns key edges into events, and ends when Escape is pressed. Answers the keys of
// the help and Escape by a notice.
class Keyboard {
 public:
  // `name`: what Escape ends, for its notice: "the keys of this terminal".
  explicit Keyboard(std::string name) : name_(std::move(name)) {}
  void change(databuffer::Key key, bool pressed);
  void release_all() { append(state_.release_all()); }
  void end() { ended_ = true; }
  bool ended() const { return ended_; }
  std::vector<databuffer::InputEvent> take() { return std::exchange(events_, {}); }
  std::vector<Notice> notices() { return std::exchange(notices_, {}); }

 private:
  void append(const std::vector<databuffer::InputEvent>& events) {
    events_.insert(events_.end(), events.begin(), events.end());
  }

  std::string name_;
  databuffer::KeyboardState state_;
  std::vector<databuffer::InputEvent> events_;
  std::vector<Notice> notices_;
  bool ended_ = false;
};

// The functions of all keys, one row a line.
std::string key_help_text();

// Keys typed in a small window. Keys are identified by their position on a US keyboard. Key repeats are ignored. Loss
// of the keyboard focus releases all keys. `session` is shown in the title. Error: no display.
error::Expected<std::unique_ptr<EventSource>> open_window_source(const std::string& session);

// Keys typed in the terminal at standard input. Error: standard input is no terminal, or this process is not in the
// foreground of the terminal.
error::Expected<std::unique_ptr<EventSource>> open_terminal_source();

}  // namespace yars::inputmonitor
