// The MPD's bezel with its twenty buttons around the picture, tooltips and notices of the window; the mouse on this
// panel as the pilot's hands: a click on a button presses it, a click on the map designates.
// Inputs: DisplayInput for the words of a tooltip; presses, releases and positions of the mouse on the panel; whether
//   the display shows a cursor.
// Outputs: a draw list in panel units; the button or the position on the picture under the mouse; input events. Their
//   times and sequence number are zero.
// Units: panel units. One panel unit is one display unit; origin upper left of the panel, x right, y down. The
//   picture's upper left corner lies at (border, border).
// Source: docs/pilots_manual.md#bezel, docs/pilots_manual.md#mouse
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "databuffer/messages/input_event.hpp"
#include "display/symbology/draw_list.hpp"
#include "display/symbology/plan_view.hpp"

namespace yars::display {

inline constexpr float kBezelBorder = 56.0F;  // [units] width of the bezel on each side

// Square panel: the picture with its border.
struct PanelLayout {
  float border = kBezelBorder;  // [units] 0: no bezel

  float edge() const { return kDisplayUnits + 2.0F * border; }
  // The position in display units; outside the picture a coordinate is outside 0..480.
  Point on_picture(Point on_panel) const { return {on_panel.x - border, on_panel.y - border}; }
};

// Number of the button at a position: a drawn button or the click zone of its legend (readouts.hpp). Without a bezel
// the legend alone. nullopt: none.
std::optional<int> button_at(const PanelLayout& layout, Point on_panel);

// Draws the bezel, if the layout has one. `lit`: button under the mouse, drawn brighter; 0: none.
void draw_bezel(const PanelLayout& layout, int lit, DrawList& list);

// Draws the tooltip of a button next to it: number, key, legend, what it does now, or why it is dead and the remedy.
void draw_tooltip(const PanelLayout& layout, const DisplayInput& input, int button, DrawList& list);

// Draws a line of text in the upper part of the picture.
void draw_notice(const PanelLayout& layout, std::string_view words, DrawList& list);

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
