// State machine as one pure step: state and inputs in, next state and outputs out.
#pragma once

#include <cstdint>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "lib/radar/configuration.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

// What the state machine tells sensors, weapons and the head-up display. Ranging and steering are NaN without a
// designated target or without a valid ownship.
databuffer::Outputs outputs_of(const databuffer::RadarState& state, const Inputs& inputs);

// A session's first state: power off.
databuffer::RadarState initial_state(const radar::RadarConfiguration& configuration);

// What an event came to.
enum class Effect : std::uint32_t {
  none = databuffer::kEventDead,        // dead here, or everything stands so already
  done = databuffer::kEventDone,        // it changed something
  refused = databuffer::kEventRefused,  // it cannot be done, and the display says why
};

// Applies one event.
Effect apply(databuffer::RadarState& state, const databuffer::InputEvent& event, const Inputs& inputs,
             const radar::RadarConfiguration& configuration);

// What passes with time, once a tick after the events: cursor slew, messages that end, the points drawn, legends.
void advance(databuffer::RadarState& state, const Inputs& inputs, const radar::RadarConfiguration& configuration);

}  // namespace yars::statemachine
