// Designation by CUE, TGT and MARK: positions, elevations, and the pattern steering line (PSL) to the target.
// Inputs: cursor position, ownship, navigator errors, elevations from the radar model.
// Outputs: cue, target and marks in the radar state; steering in Outputs.
// Units: degrees; elevations in metres above mean sea level.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "databuffer/messages/radar_state.hpp"
#include "lib/geo/geodesy.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

// Elevation requests. A designated point is stored at once, without its elevation. The radar model returns the
// elevation one or more ticks later, when the cursor may be elsewhere. The state contains the requested ground
// position, and the model's answer repeats that position. An answer for another position is ignored.

// Elevation of a ground position [m MSL]; NaN if the model does not know it; nullopt until the model has answered.
std::optional<double> answered_elevation_m(const Inputs& inputs, geo::GeoPoint ground);

// Requests the elevation at the cursor. `recipients`: mask of the points that get the elevation (bit n for mark n,
// kAskedForTarget, kAskedForCue). Their elevation is NaN until take_elevation() has the answer. If the model has
// already answered with the elevation of this position, they get it at once.
void request_elevation(Step& step, std::uint32_t recipients);
// Removes recipients from the open request, because their elevation is known from another source.
void cancel_request(databuffer::RadarState& state, std::uint32_t recipients);

// True if the event designates a point while an elevation at another position is awaited. The event must then wait for
// a later tick. The wait ends 20 ticks after the request, because the model may have stopped.
bool waits_for_elevation(const databuffer::RadarState& state, const databuffer::InputEvent& event,
                         const Inputs& inputs);

// One tick: stores the elevation of the recipients once the model has answered with a known elevation. A request
// without such an answer ends after 2 s, and the elevation stays NaN.
void take_elevation(databuffer::RadarState& state, const Inputs& inputs);
// Requests the elevation at the cursor when no other request is open.
void request_cursor_elevation(databuffer::RadarState& state);

// PSL: line through the designated target along the approach heading, and the steering onto that line.
// Source: docs/pilots_manual.md#rule-15.

// Acquisition switch with cursor function TGT and a designated target. Aft: the TDC turns the line. Forward:
// steer_line_of_sight().
void steer_by_acquisition_switch(Step& step);
// TDC release while slewing: fixes the heading of the line as the approach heading.
void fix_steering_line(Step& step);
bool slews_steering_line(const databuffer::RadarState& state);  // true while the TDC turns the line
// Makes the line follow the line of sight from the aircraft to the target.
void steer_line_of_sight(databuffer::RadarState& state, const Inputs& inputs);

// One tick: updates the line of sight, or turns a slewing line by the TDC. Removes the line when there is no target.
void advance_steering_line(databuffer::RadarState& state, const Inputs& inputs);

// Sets approach heading [deg, true] and steering of `outputs`. Steering: azimuth [deg] of the target from the ground
// track, right positive. For a fixed line: bank angle [deg], right wing down positive, that turns the aircraft onto the
// line. Requires a designated target and a valid ownship.
void put_steering(databuffer::Outputs& outputs, const databuffer::RadarState& state, const Inputs& inputs);

// CUE, TGT and MARK at the cursor, in coordinates of the selected navigator. They are refused without a valid ownship
// or a cursor position. Source: docs/pilots_manual.md#rule-14.
void cue_sensor(Step& step);
// Designates a target and cues the sensor to it. If the symbol of a point of the route is under the cursor, that point
// becomes the target. Refused if no name is free.
void designate_target(Step& step);
// Stores a mark. If there are ten already, drops the oldest.
void store_mark(Step& step);

// Moves a target that lies at a point of the route `before` to the place and elevation of that point in the new route,
// `parameters.route`. A target whose point is gone stays.
void move_target_with_route(databuffer::RadarState& state, std::span<const radar::RoutePoint> before,
                            const Parameters& parameters);

// The designated target as a sequence point; nullopt if there is no target.
std::optional<radar::RoutePoint> designated_point(const databuffer::RadarState& state);

}  // namespace yars::statemachine
