// Map from keyboard keys to input events, for windows and terminals.
// Inputs: key presses and releases.
// Outputs: input events without times and number.
// Threads: none; KeyboardState keeps only the set of held keys.
// Source: docs/spec/pilots_interface.md#buttons, #controls.
//   2..9 a..k: pb 2..20 | arrows: tdc while held | Enter: tdc press, release | Tab: coolie up |
//   Page Up, Page Down: acq fwd, aft | Space: freeze | [ ]: elevation down, up | F1 F2 F3: mode ag, aa, agr |
//   F4: nav toggle | Escape: no event; input-monitor ends on it.
#pragma once

#include <bitset>
#include <cstdint>
#include <vector>

#include "databuffer/messages/input_event.hpp"

namespace yars::databuffer {

// Printable keys have their ASCII code, letters the lower-case one. Named keys have codes above ASCII.
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
};

// Key of a printable ASCII character, either case; Key::none for any other character.
Key key_of_character(char character);
// Key of a key code of GLFW, which is a position on a US keyboard; Key::none for a key without function.
Key key_of_glfw(int code);

// Converts key edges to events.
class KeyboardState {
 public:
  // No events for a key without function, or for a repeated edge (auto-repeat).
  std::vector<InputEvent> change(Key key, bool pressed);

  // Events that release all held keys, for loss of focus or the end of the program.
  std::vector<InputEvent> release_all();

 private:
  InputEvent deflection() const;

  std::bitset<256> held_;
};

}  // namespace yars::databuffer
