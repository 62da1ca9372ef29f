// Designation by CUE, TGT and MARK: positions, elevations, and the pattern steering line (PSL) to the target.
// Inputs: cursor position, ownship, navigator errors, elevations from the radar model.
// Outputs: cue, target and marks in the radar state; steering in Outputs.
// Units: degrees; elevations in metres above mean sea level.
#pragma once

#include <cstdint>
#include <optional>

#include "databuffer/messages/radar_state.hpp"
#include "lib/geo/geodesy.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

// Elevation requests. A point is stored at once; its elevation comes from the model one or more ticks later, when the
// cursor may be elsewhere. The state names the requested ground position, the model answers with the same coordinates,
// and an answer with other coordinates is ignored.

// Elevation of a ground position [m MSL]; NaN when the model does not know it. Nothing before the model has answered.
std::optional<double> answered_elevation_m(const Inputs& inputs, geo::GeoPoint ground);

// Requests the elevation at the cursor. `recipients`: bits kAskedFor..., and a bit for each mark. Their elevation is
// unknown until take_elevation() has the answer.
void request_elevation(Step& step, std::uint32_t recipients);
// Removes recipients with a known elevation from the request.
void cancel_request(databuffer::RadarState& state, std::uint32_t recipients);

// True when the event designates a point while the elevation of another one is awaited: the event must wait for a later
// tick. At most 20 ticks, because the model may have stopped.
bool waits_for_elevation(const databuffer::RadarState& state, const databuffer::InputEvent& event,
                         const Inputs& inputs);

// One tick: stores an answer for its recipients.
void take_elevation(databuffer::RadarState& state, const Inputs& inputs);
// Requests the elevation at the cursor when no other request is open.
void request_cursor_elevation(databuffer::RadarState& state);

// PSL: approach heading of the designated target, and the steering to it.
// Source: docs/spec/pilots_interface.md#rule-15.

// `acq aft` in TGT: the TDC turns the line. `acq fwd`: the line follows the line of sight again.
void steer_slewing(Step& step);
// TDC release while slewing: fixes the heading of the line as the approach heading.
void fix_steering_line(Step& step);

bool slews_steering_line(const databuffer::RadarState& state);
void steer_line_of_sight(databuffer::RadarState& state, const Inputs& inputs);

// One tick: updates the line of sight, or turns a slewing line by the TDC. Removes the line when there is no target.
void advance_steering_line(databuffer::RadarState& state, const Inputs& inputs);

// Steering outputs: azimuth to the target, or the bank angle onto a fixed line.
void put_steering(databuffer::Outputs& outputs, const databuffer::RadarState& state, const Inputs& inputs);

// CUE, TGT and MARK at the cursor, in coordinates of the selected navigator.
// Source: docs/spec/pilots_interface.md#rule-14.
void cue_sensor(Step& step);
void designate_target(Step& step);  // cues too; within 1 m of a point of the route it designates that point
void store_mark(Step& step);        // the last ten are kept

// The designated target as a sequence point. Nothing when there is no target.
std::optional<radar::RoutePoint> designated_point(const databuffer::RadarState& state);

}  // namespace yars::statemachine
