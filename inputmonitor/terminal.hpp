// Terminal as a keyboard: its bytes as edges of keys, its mode without echo.
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

// Source: docs/spec/commands.md#terminal.
inline constexpr std::int64_t kEscapeAlone_ns = 50'000'000;  // [ns] a serial line at 9600 Bd needs 1 ms
inline constexpr std::int64_t kArrowPulse_ns = 100'000'000;  // [ns] longer than a key's repeat

struct KeyChange {
  databuffer::Key key = databuffer::Key::none;
  bool pressed = false;
};

// From the bytes of a terminal to edges of keys. Pure: it is told the time of each byte.
// Knows the sequences of xterm and its kin (ESC [ A, ESC O A, ESC [ 5 ~, ESC O P, ESC [ 1 1 ~, with modifiers) and of
// the Linux console (ESC [ [ A). Terminals report no release: an arrow is a pulse that each further byte sequence
// lengthens; every other key goes down and up at once. ESC alone is the key when nothing follows it in time; a
// sequence that stays unfinished that long, or is unknown, is dropped.
class TerminalDecoder {
 public:
  // Bytes read at `now_ns`; what had to happen before comes first.
  std::vector<KeyChange> feed(std::string_view bytes, std::int64_t now_ns);
  // What the time alone brings: pulses that end, ESC that stayed alone.
  std::vector<KeyChange> advance(std::int64_t now_ns);
  // When advance() has something to do; none: not without further bytes.
  std::optional<std::int64_t> deadline_ns() const;

 private:
  using Changes = std::vector<KeyChange>;
  struct Pulse {
    databuffer::Key key;
    std::optional<std::int64_t> end_ns;
  };

  void take_byte(char byte, std::int64_t now_ns, Changes& changes);
  void continue_sequence(char byte, std::int64_t now_ns, Changes& changes);
  void stroke(databuffer::Key key, std::int64_t now_ns, Changes& changes);

  std::string sequence_;  // begun with ESC and not yet complete
  std::int64_t last_byte_ns_ = 0;
  std::array<Pulse, 4> pulses_{{{databuffer::Key::up, {}},
                                {databuffer::Key::down, {}},
                                {databuffer::Key::left, {}},
                                {databuffer::Key::right, {}}}};
};

// A terminal that gives each byte at once, without echo, as long as this object lives; afterwards, and when the
// process is felled by a signal that can be caught, it is as it was. Ctrl-C goes on to end the program; Ctrl-Z is
// off, or a stopped program would leave the shell a terminal without echo.
class TerminalMode {
 public:
  // An error when the descriptor is no terminal, or this process is not in its foreground. One at a time.
  static error::Expected<std::unique_ptr<TerminalMode>> enter(int descriptor);
  TerminalMode(const TerminalMode&) = delete;
  TerminalMode& operator=(const TerminalMode&) = delete;
  ~TerminalMode();

 private:
  TerminalMode() = default;
};

// Whether `enter` would find a terminal that is ours to read.
bool is_foreground_terminal(int descriptor);

}  // namespace yars::inputmonitor
