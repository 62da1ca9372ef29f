// Mouse on the panel as the pilot's hands: a click on a button presses it, a click on the map designates.
// Inputs: presses, releases and positions of the mouse on the panel; whether the display shows a cursor.
// Outputs: input events. Their times and sequence number are zero.
// Units: panel units (bezel.hpp).
// Source: docs/pilots_manual.md#mouse
#pragma once

#include <optional>
#include <vector>

#include "databuffer/messages/input_event.hpp"
#include "display/symbology/bezel.hpp"

namespace yars::display {

enum class MouseButton { left, right };

// A press of the left button on the map moves the cursor there, and the cursor then follows the mouse. The release
// releases the TDC's switch; off the map it designates nothing. The right button only moves the cursor. Without a
// button the mouse moves nothing, so that a touch of the mouse does not disturb a pilot who uses keys or a stick.
class Mouse {
 public:
  std::vector<databuffer::InputEvent> press(const PanelLayout& layout, MouseButton button, Point at, bool takes_cursor);
  std::vector<databuffer::InputEvent> release(const PanelLayout& layout, MouseButton button, Point at);
  // The mouse is at this position. One event at most: call it once for each redraw.
  std::vector<databuffer::InputEvent> move(const PanelLayout& layout, Point at);
  void cancel() { held_.reset(); }  // the window lost the focus: the release designates nothing

 private:
  std::optional<MouseButton> held_;  // button that was pressed on the map
  Point last_;                       // position of the last cursor event
};

}  // namespace yars::display
