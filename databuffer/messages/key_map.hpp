// Keys of a keyboard, whatever read them (a window, a terminal, the glass), and what they do.
// Source: docs/spec/pilots_interface.md#buttons, #controls.
//   2..9 a..k: pb 2..20 | arrows: tdc while held | Enter: tdc press, release | Tab: coolie up |
//   Page Up, Page Down: acq fwd, aft | Space: freeze | [ ]: elevation down, up | F1 F2 F3: mode ag, aa, agr |
//   F4: nav toggle | Escape: nothing here; it ends the input monitor.
#pragma once

#include <bitset>
#include <cstdint>
#include <vector>

#include "databuffer/messages/input_event.hpp"

namespace yars::databuffer {

// Printable keys have their ASCII number, letters the lower one; named keys lie above ASCII.
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

// The key of a printable ASCII character, either case; none for any other.
Key key_of_character(char character);

// Turns edges of keys into events without times and number. Pure: what is held is all it remembers.
class KeyboardState {
 public:
  // Nothing for a key without a meaning, or when the edge repeats what is known (auto-repeat).
  std::vector<InputEvent> change(Key key, bool pressed);

  // What must be sent when the keyboard goes away (focus lost, program ends) with keys held.
  std::vector<InputEvent> release_all();

 private:
  InputEvent deflection() const;

  std::bitset<256> held_;
};

}  // namespace yars::databuffer
