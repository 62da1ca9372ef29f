// Cursor, and the sequence points on the display that it jumps to.
#pragma once

#include <optional>

#include "statemachine/step.hpp"

namespace yars::statemachine {

// The cursor: held on its ground point (docs/spec/pilots_interface.md#rule-12), slewed by the TDC in the frame of the
// glass: ground track up, or, on a patch map, line of sight up, fixed at its start
// (docs/spec/pilots_interface.md#rule-5). Its place is that on the video; what the navigator makes of it stands beside
// it, for whoever is told. It may lie off the glass (the aircraft has passed it, the range is shorter, the point jumped
// to is far); slewing brings it to the edge first.
void deflect(Step& step);               // TDC, held until changed
void next_cursor_function(Step& step);  // MAP, UPDT, CUE, TGT, MARK, MAP; in SET without MAP

// Puts the cursor where the glass draws a place that the navigator knows by its coordinates.
void jump_cursor(databuffer::RadarState& state, geo::GeoPoint known, const Inputs& inputs);

// PVU shows no cursor; in A/A and ranging there is a picture to slew it over in SET alone.
bool shows_cursor(const databuffer::RadarState& state);

// A tick of the cursor: the frame follows the aircraft unless the picture is frozen or a map, the deflection moves the
// cursor, bearing and range follow. A cursor that was nowhere goes to the selected point when that is on the glass,
// else half the range ahead, or to the middle of the map. Needs a valid ownship.
void advance_cursor(databuffer::RadarState& state, const Inputs& inputs,
                    const radar::RadarConfiguration& configuration);

// The sequence points on the glass and stepping over them. Source: docs/spec/pilots_interface.md#rule-11.

// The next of the points drawn, in their order, round and round; the cursor jumps to it.
void next_sequence_point(Step& step);
// The point with the event's name, of the route or designated; an unknown name is refused.
void select_sequence_point(Step& step);

// The first of the route in the order of stepping; none when there is no route.
void select_first_sequence_point(databuffer::RadarState& state, const radar::RadarConfiguration& configuration);

// The selected point of the route, or the target designated when that is selected.
std::optional<radar::RoutePoint> selected_point(const databuffer::RadarState& state,
                                                const radar::RadarConfiguration& configuration);

// Fills `points`: at most five, the nearest within the range, the selected one and the target designated always among
// them; declutter leaves targets, their offsets and the selected one. Costs a geodesic a route point: call it when
// something has changed and a few times a second.
void draw_points(databuffer::RadarState& state, const Inputs& inputs, const radar::RadarConfiguration& configuration);

}  // namespace yars::statemachine
