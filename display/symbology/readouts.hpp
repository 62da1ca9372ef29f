// Words on the display: the buttons with their legends, readouts, messages, velocity differences.
#pragma once

#include <optional>

#include "display/symbology/draw_list.hpp"
#include "display/symbology/plan_view.hpp"

namespace yars::display {

// The twenty buttons around the glass: 1-5 down the left, 6-10 along the bottom left to right, 11-15 up the right,
// 16-20 along the top right to left. A legend stands beside its button, inside the glass.
struct LegendPlace {
  Point at;  // reference point of the text, middle of its height
  Align align = Align::center;
};

// `button` is 1..20.
LegendPlace legend_place(int button);

// The button whose legend area lies under a click at `at`; nothing in the middle and in the corners.
std::optional<int> button_at(Point at);

// The words on the glass: legends beside the buttons, readouts between them, messages, and what has gone silent.

// A number that the cursor stands on is left out, its place kept: cut by the cursor's arms it may read as another one.
// The cursor comes first.
void draw_number(std::string_view words, Point at, const TextStyle& style, DrawList& list);

// As the radar state names them, boxed where it says so.
void draw_legends(const databuffer::RadarState& state, DrawList& list);

void draw_brightness(const databuffer::RadarState& state, DrawList& list);      // between PB 4 and 5
void draw_range(const databuffer::RadarState& state, DrawList& list);           // between PB 13 and 14
void draw_window_size(const databuffer::RadarState& state, DrawList& list);     // above PB 8; nothing while blank
void draw_cursor_readout(const databuffer::RadarState& state, DrawList& list);  // magnetic bearing, 0.1 NM
// UPDT: north and east errors in feet, beyond 3000 ft in NM, or INV; for the INS the seconds left above PB 7.
void draw_update_errors(const databuffer::RadarState& state, DrawList& list);
void draw_map_timer(double seconds, DrawList& list);  // nothing while NaN
// Air to air and A/G ranging, which have no legend that names them.
void draw_mode_name(const databuffer::RadarState& state, DrawList& list);
void draw_freeze(DrawList& list);
void draw_message(const databuffer::RadarState& state, DrawList& list);
void draw_banner(std::string_view words, DrawList& list);     // STBY, NO VIDEO
void draw_silent(const DisplayInput& input, DrawList& list);  // NO OWNSHIP, NO MODEL, NO STATE MACHINE

// What the radar measures of the aircraft's velocity against what the navigator has.
// Source: docs/spec/pilots_interface.md#rule-16.

// IPVU: the differences of the last update, for as long as the state says.
void draw_velocity_differences(const databuffer::RadarState& state, DrawList& list);

// PVU: the same large, all the time, and the beam under way.
void draw_velocity_format(const DisplayInput& input, DrawList& list);

}  // namespace yars::display
