// Cursor on the radar picture, and the sequence points (numbered points of the route) that are drawn on the picture.
// Inputs: TDC deflection, frame (apex and up direction) of the picture, ownship, navigator errors, route.
// Outputs: the cursor's ground position, its magnetic bearing and ground range from the aircraft; the points drawn.
// Units: degrees, nautical miles.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "statemachine/step.hpp"

namespace yars::statemachine {

// The cursor stays at its ground position (docs/pilots_manual.md#rule-12) until the TDC slews it. The ground
// track is upward on the display. On a patch map, the map's line of sight is upward
// (docs/pilots_manual.md#rule-5). The state has the ground position under the cursor, and the coordinates that
// the selected navigator gives this position.
// After a change of range or a jump to a distant point the cursor may lie outside the display. The TDC then moves the
// cursor to the edge of the display first.
void deflect(Step& step);  // TDC deflection [-1, 1], x right, y up; stays until the next TDC event
// Moves the cursor to a position on the display: x right, y down, [0, 1] from the upper left corner. Does nothing while
// the display shows no cursor, while the TDC turns the steering line, and without a valid ownship.
void point_cursor(Step& step);
void next_cursor_function(Step& step);  // cycles MAP, UPDT, CUE, TGT, MARK; MAP is skipped while SET is on

// Moves the cursor to the displayed position of a point with navigator coordinates `known`. Without a valid ownship the
// cursor moves to `known` itself.
void jump_cursor(databuffer::RadarState& state, geo::GeoPoint known, const Inputs& inputs);

// True if the cursor is shown. In PVU it is never shown. In A/A and A/G ranging it is shown only while SET is on.
bool shows_cursor(const databuffer::RadarState& state);

// One tick: updates the frame, slews the cursor by the TDC, and updates bearing and range. The frame follows the
// aircraft, unless the picture is frozen or is a patch map. A cursor without a position starts at the selected point if
// the display shows that point. Else it starts at half the range ahead, or in the centre of the map. Requires a valid
// ownship.
void advance_cursor(databuffer::RadarState& state, const Inputs& inputs, const Parameters& parameters);

// Sequence points. Source: docs/pilots_manual.md#rule-11.

// Selects the drawn point with the next higher number; after the highest, the lowest. The cursor jumps to that point.
void next_sequence_point(Step& step);
// Reason why an unknown name is refused: NO POINT and the name.
std::string no_such_point(std::string_view name);
// Selects the point of the route, or the designated target, by the name in the event. The cursor jumps to that point.
// An unknown name is refused.
void select_sequence_point(Step& step);

// Selects the point of the route with the lowest number. Clears the selection when there is no route.
void select_first_sequence_point(databuffer::RadarState& state, const Parameters& parameters);

// The selected point of the route, or the designated target if that is selected; nullopt if neither is selected.
std::optional<radar::RoutePoint> selected_point(const databuffer::RadarState& state, const Parameters& parameters);

// Fills `points` with at most five points: the selected point, the designated target, and the nearest others within the
// display range of the aircraft.
// Declutter keeps targets, target offsets and the selected point. Each call computes a geodesic for every point of the
// route. Therefore draw_points is called on changes, and otherwise every 20 ticks.
void draw_points(databuffer::RadarState& state, const Inputs& inputs, const Parameters& parameters);

}  // namespace yars::statemachine
