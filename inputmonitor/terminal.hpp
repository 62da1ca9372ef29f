// Terminal as a keyboard: decoder from bytes to key edges, and a terminal mode without line buffering and echo.
// Inputs: bytes with the time of their arrival [ns, CLOCK_MONOTONIC].
// Outputs: key edges (presses and releases).
// Errors: a descriptor that is not a terminal; a process that is not in the foreground of the terminal.
// Source: docs/commands.md#terminal
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "databuffer/messages/key_map.hpp"
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

}  // namespace yars::inputmonitor
