// Texts of the display: legends next to the buttons, readouts, messages, velocity differences.
// Inputs: radar state; DisplayInput (plan_view.hpp); the position of a click.
// Outputs: texts in a draw list; the number of the clicked button.
// Units: positions in display units (draw_list.hpp).
// Source: docs/pilots_manual.md#legends, docs/pilots_manual.md#messages
#pragma once

#include <optional>

#include "display/symbology/draw_list.hpp"
#include "display/symbology/plan_view.hpp"

namespace yars::display {

// Position of a legend next to its button, inside the display. The buttons of the MPD count counter-clockwise: 1-5 left
// side, downward; 6-10 bottom, left to right; 11-15 right side, upward; 16-20 top, right to left.
struct LegendPosition {
  Point at;  // reference point of the text, at the middle of its height
  Align align = Align::center;
};

// `button` is 1..20.
LegendPosition legend_position(int button);

// Number of the button whose click zone contains `at`. The zones lie along the four sides, around the legends. nullopt:
// `at` is in no zone, for example in the middle, in a corner, between two zones or outside the display.
std::optional<int> button_at(Point at);

// Draws a readout. If the cursor is there, the readout moves beyond the cursor, unless another text is
// there. The cursor must be in the list before (occupy_cursor()).
void draw_readout(std::string_view words, Point at, const TextStyle& style, DrawList& list);

// The north from which bearings and headings count: "MAG", or "TRUE" while no magnetic variation is known.
const char* north_of_bearings(const databuffer::RadarState& state);

// Draws the legends of all buttons. A legend is framed if the bit of its button is set in `state.boxed`.
void draw_legends(const databuffer::RadarState& state, DrawList& list);

void draw_brightness(const databuffer::RadarState& state, DrawList& list);      // between PB 4 and 5
void draw_range(const databuffer::RadarState& state, DrawList& list);           // between PB 13 and 14
void draw_window_size(const databuffer::RadarState& state, DrawList& list);     // above PB 8; blank: no text
void draw_cursor_readout(const databuffer::RadarState& state, DrawList& list);  // bearing with its north, ground range
// Writes below the cursor's readout that the cursor is off the display.
void draw_cursor_off(DrawList& list);
void draw_map_width(const databuffer::PatchMap& map, DrawList& list);  // lower left: side of the map that is shown
// Position error of UPDT, from the selected sequence point to the cursor: north and east components in feet, or in NM
// if the total error exceeds kUpdateErrorInFeet. The seconds left for an INS update are above PB 7. When they have
// passed, INV replaces the error.
void draw_update_errors(const databuffer::RadarState& state, DrawList& list);
void draw_map_timer(double seconds, DrawList& list);  // nothing if not finite
// Draws "A/A" or "A/G RANGING" in these modes, because no legend names them. In A/G ranging with a map also the slant
// range to the target. Draws nothing in other modes.
void draw_mode_name(const DisplayInput& input, DrawList& list);
void draw_freeze(DrawList& list);
// Draws the message, and below it the remedy in smaller text, on at most three lines. They are above the azimuth
// scale; if the cursor is there, higher. Without a state machine the message is out of date; nothing is drawn. Nor is
// NO OWNSHIP while draw_silent() draws it.
void draw_message(const DisplayInput& input, DrawList& list);
// Draws what the state is if it shows no picture: STBY, A/A, A/G RANGING (with the slant range to the target) without
// a map, the main menu, PVU. With
// `input.hints` also how to get back, and for OFF how to switch on; else OFF draws nothing.
void draw_state(const DisplayInput& input, DrawList& list);
// NO OWNSHIP, NO MODEL, NO STATE MACHINE, each with its remedy in smaller text; clear of cursor and message.
void draw_silent(const DisplayInput& input, DrawList& list);

// Velocity differences: velocity measured by the radar minus velocity of the navigator, in ft/s. Components: along the
// ground track, to the right, up. Source: docs/pilots_manual.md#rule-16.

// IPVU: draws the differences of the last velocity measurement while the flag kVelocityShown is set.
void draw_velocity_differences(const databuffer::RadarState& state, DrawList& list);

// PVU: draws the differences in large text, the number of the current beam, and the progress of a map that forms.
// Dashes replace the differences while kVelocityShown is not set.
void draw_velocity_format(const DisplayInput& input, DrawList& list);

}  // namespace yars::display
