// What the state machine tells sensors, weapons and the head-up display.
#pragma once

#include "databuffer/records/outputs.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

// Ranging and steering are NaN without a designated target or without a valid ownship.
databuffer::Outputs outputs_of(const databuffer::RadarState& state, const Surroundings& surroundings);

}  // namespace yars::statemachine
