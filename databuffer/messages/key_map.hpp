// Map from keyboard keys to input events, for windows and terminals.
// Inputs: key presses and releases.
// Outputs: input events. Their times and sequence number are zero.
// Threads: one thread per KeyboardState object.
// Source: docs/pilots_manual.md#buttons, #controls.
// Keys and their events, in the text form of input_event.hpp:
//   2..9 a..k: pb 2..20 | arrows: tdc (full deflection while held) | Enter: tdc press, release | Tab: coolie up |
//   Page Up, Page Down: acq fwd, aft | Space: freeze | [ ]: elevation down, up | F4: nav toggle |
//   F5 F6 F7: mode ag, aa, agr | n: next | o: power opr | s: power stby.
// Keys without an event: ? and F1 (help), F8 (bezel), F11 (full screen), Escape (ends help, full screen,
// input-monitor). pb: push button; tdc: throttle designator control, which moves the cursor; coolie: castle switch;
// acq: acquisition
//   switch, which selects the window; ag, aa, agr: air-to-ground, air-to-air, air-to-ground ranging.
#pragma once

#include <bitset>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "databuffer/messages/input_event.hpp"

namespace yars::databuffer {

// Code of a key. A letter key has the ASCII code of the lower-case letter; another printable key has its ASCII code.
// All other keys have codes above ASCII.
enum class Key : std::uint8_t {
  none = 0,
  space = ' ',
  up = 128,
  down,
  left,
  right,
  enter,
  tab,
  page_up,
  page_down,
  escape,
  f1,
  f2,
  f3,
  f4,
  f5,
  f6,
  f7,
  f8,
  f11,
};

// Key of a printable ASCII character. `A` and `a` give the same key. Key::none for any other character.
Key key_of_character(char character);
// Key of a key code of GLFW (window library), which stands for a position on a US keyboard. Key::none for a key that is
// neither printable nor named in Key.
Key key_of_glfw(int code);

// True for the keys that show the help: `?` and F1.
inline bool is_help(Key key) {
  return key == Key{'?'} || key == Key::f1;
}

// True for a letter or digit without an event. The program then answers with kDeadKeyHelp.
bool is_dead_letter(Key key);
inline constexpr const char* kDeadKeyHelp = "this key does nothing; ? shows the keys";

// One row of the help: keys and what they do, in words. A new row here appears in the help over the display, in the
// terminal and in the window of input-monitor.
struct KeyHelp {
  const char* keys;
  const char* does;
};
// Keys other than those of the push buttons.
std::span<const KeyHelp> key_help();
// Name of the key of a push button: "2" to "9", "A" to "K"; empty for a button without a key.
std::string_view key_of_button(int button);

// Converts presses and releases of keys to events. Stores the set of held keys.
class KeyboardState {
 public:
  // Events of one press or release. Empty if it has no event, and for a repeated press (auto-repeat of the keyboard).
  std::vector<InputEvent> change(Key key, bool pressed);

  // Events that release all held keys, for loss of focus or the end of the program.
  std::vector<InputEvent> release_all();

 private:
  InputEvent deflection() const;

  std::bitset<256> held_;
};

}  // namespace yars::databuffer
