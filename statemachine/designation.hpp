// Designation by CUE, TGT and MARK: elevations awaited, the steering line, the points stored.
#pragma once

#include <cstdint>
#include <optional>

#include "databuffer/messages/radar_state.hpp"
#include "lib/geo/geodesy.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

// Elevations of what the pilot designates. A point is stored at once; how high its ground lies is the model's to tell,
// a tick or more later, and by then the cursor may be elsewhere. So the state names the ground that it asks for, the
// model answers with the same coordinates, and only that answer is taken.

// [m] MSL of this ground, NaN where the model does not know it; nothing while it has not answered.
std::optional<double> answered_elevation_m(const Inputs& inputs, geo::GeoPoint ground);

// The ground under the cursor is asked for on behalf of those (databuffer::kAskedFor..., a bit for a mark). Their
// elevation is unknown until take_elevation() has it.
void ask_elevation(Step& step, std::uint32_t for_whom);
// Those have an elevation of their own.
void ask_no_more(databuffer::RadarState& state, std::uint32_t for_whom);

// True if the event designates a point while another one's elevation is awaited: whoever takes events leaves it for a
// later tick. Not for longer than 20 ticks, for the model may be gone.
bool waits_for_elevation(const databuffer::RadarState& state, const databuffer::InputEvent& event,
                         const Inputs& inputs);

// A tick: an answer that has come goes to those who wait for it.
void take_elevation(databuffer::RadarState& state, const Inputs& inputs);
// Nobody waits: the cursor's ground is asked for.
void ask_for_cursor(databuffer::RadarState& state);

// The pattern steering line: the heading on which the designated target is to be approached, and the steering to it.
// Source: docs/spec/pilots_interface.md#rule-15.

// `acq aft` in TGT: the TDC turns the line from now on. `acq fwd`: back to the line of sight.
void steer_slewing(Step& step);
// TDC release while slewing: the line's heading is the approach.
void fix_steering_line(Step& step);

bool slews_steering_line(const databuffer::RadarState& state);
void lead_along_line_of_sight(databuffer::RadarState& state, const Inputs& inputs);

// A tick: the line of sight follows the aircraft, the TDC turns a line that slews. Without a target there is none.
void advance_steering_line(databuffer::RadarState& state, const Inputs& inputs);

// Azimuth steering to the target, or, once the line is fixed, the bank that leads onto it.
void put_steering(databuffer::Outputs& outputs, const databuffer::RadarState& state, const Inputs& inputs);

// CUE, TGT and MARK: what the point under the cursor is given to. Points are told as the navigator in use has them.
// Source: docs/spec/pilots_interface.md#rule-14.
void cue_sensor(Step& step);
void designate_target(Step& step);  // also cues; on a point of the route it takes that one
void store_mark(Step& step);        // ten are kept: the oldest makes way

// The designated target as a point among the sequence points; nothing when none is.
std::optional<radar::RoutePoint> designated_point(const databuffer::RadarState& state);

}  // namespace yars::statemachine
