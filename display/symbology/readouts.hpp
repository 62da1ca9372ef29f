// Texts of the display: legends beside the buttons, readouts, messages, velocity differences.
// Inputs: radar state, DisplayInput.
// Outputs: texts in a draw list; the button under a click.
// Units: positions in display units (draw_list.hpp).
// Source: docs/spec/pilots_interface.md#legends, docs/spec/pilots_interface.md#messages
#pragma once

#include <optional>

#include "display/symbology/draw_list.hpp"
#include "display/symbology/plan_view.hpp"

namespace yars::display {

// Position of a legend beside its button, inside the display. Buttons of the MPD, counter-clockwise: 1-5 left side,
// downward. 6-10 bottom, left to right. 11-15 right side, upward. 16-20 top, right to left.
struct LegendPosition {
  Point at;  // reference point of the text, at the middle of its height
  Align align = Align::center;
};

// `button` is 1..20.
LegendPosition legend_position(int button);

// Number of the button whose legend area contains `at`. nullopt: no area does, as in the middle, in the corners,
// between two areas or outside the display.
std::optional<int> button_at(Point at);

// Draws a number, unless the cursor overlaps it: with the cursor's arms it could be read as another number. An omitted
// number still occupies its box. Draw the cursor before numbers.
void draw_number(std::string_view words, Point at, const TextStyle& style, DrawList& list);

// Legends of all buttons, framed if the state has them boxed.
void draw_legends(const databuffer::RadarState& state, DrawList& list);

void draw_brightness(const databuffer::RadarState& state, DrawList& list);      // between PB 4 and 5
void draw_range(const databuffer::RadarState& state, DrawList& list);           // between PB 13 and 14
void draw_window_size(const databuffer::RadarState& state, DrawList& list);     // above PB 8; nothing while blank
void draw_cursor_readout(const databuffer::RadarState& state, DrawList& list);  // magnetic bearing [deg], range [NM]
// UPDT: north and east errors in feet, or in NM beyond a distance of kUpdateErrorInFeet. INV replaces errors from a
// cursor position that is too old. The remaining seconds of an INS update are above PB 7.
void draw_update_errors(const databuffer::RadarState& state, DrawList& list);
void draw_map_timer(double seconds, DrawList& list);  // [s]; nothing while NaN
// "A/A" or "A/G RANGING", because no legend shows these modes.
void draw_mode_name(const databuffer::RadarState& state, DrawList& list);
void draw_freeze(DrawList& list);
void draw_message(const databuffer::RadarState& state, DrawList& list);
void draw_banner(std::string_view words, DrawList& list);     // centered, large: STBY
void draw_silent(const DisplayInput& input, DrawList& list);  // NO OWNSHIP, NO MODEL, NO STATE MACHINE

// Velocity measured by the radar minus velocity of the navigator. Source: docs/spec/pilots_interface.md#rule-16.

// IPVU: differences of the last update, while kVelocityShown is set.
void draw_velocity_differences(const databuffer::RadarState& state, DrawList& list);

// PVU: the differences in large text, dashes while there are none, the current beam, and the progress of a map.
void draw_velocity_format(const DisplayInput& input, DrawList& list);

}  // namespace yars::display
