// The pattern steering line: the heading on which the designated target is to be approached, and the steering to it.
// Source: docs/spec/pilots_interface.md#rule-15.
#pragma once

#include "databuffer/records/outputs.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

// `acq aft` in TGT: the TDC turns the line from now on. `acq fwd`: back to the line of sight.
void steer_slewing(Step& step);
// TDC release while slewing: the line's heading is the approach.
void fix_steering_line(Step& step);

bool slews_steering_line(const databuffer::RadarState& state);
void lead_along_line_of_sight(databuffer::RadarState& state, const Surroundings& surroundings);

// A tick: the line of sight follows the aircraft, the TDC turns a line that slews. Without a target there is none.
void advance_steering_line(databuffer::RadarState& state, const Surroundings& surroundings);

// Azimuth steering to the target, or, once the line is fixed, the bank that leads onto it.
void put_steering(databuffer::Outputs& outputs, const databuffer::RadarState& state, const Surroundings& surroundings);

}  // namespace yars::statemachine
