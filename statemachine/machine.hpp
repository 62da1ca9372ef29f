// State machine of the pilot's interface as pure functions: apply one event, advance one tick.
// Inputs: radar state, event, inputs of the tick, configuration.
// Outputs: the next radar state; outputs to sensors, weapons and the head-up display.
// Source: docs/pilots_manual.md#rules
#pragma once

#include <cstdint>
#include <span>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

// Outputs to sensors, weapons and the head-up display. Ranging (slant range, bearing, depression) and steering are NaN
// if no target is designated, or if ownship is not valid. While the model has
// not yet answered with the ground's height above sea level at the target, ranging is NaN.
databuffer::Outputs outputs_of(const databuffer::RadarState& state, const Inputs& inputs);

// Initial state of a session: power off.
databuffer::RadarState initial_state(const Parameters& parameters);

// Result of an event.
enum class Effect : std::uint32_t {
  none = databuffer::kEventDead,  // no row of the transition table applies, or the state is unchanged
  // The state has changed, or the event is a press, which takes effect at its release, or it is for the tour.
  done = databuffer::kEventDone,
  refused = databuffer::kEventRefused,  // the event cannot be carried out; the display shows the reason
};

// Applies one event to the state.
Effect apply(databuffer::RadarState& state, const databuffer::InputEvent& event, const Inputs& inputs,
             const Parameters& parameters);

// Adapts the state to a changed route, `parameters.route`; `before` is the route before. If the selected sequence point
// is gone, the one with the lowest number is selected, as at power-up. A target that was designated at a point of the
// route moves with that point. The cursor stays.
void change_route(databuffer::RadarState& state, std::span<const radar::RoutePoint> before, const Inputs& inputs,
                  const Parameters& parameters);

// Advances the state by one tick, after the tick's events. Updates cursor, steering line, navigators, points, legends.
void advance(databuffer::RadarState& state, const Inputs& inputs, const Parameters& parameters);

}  // namespace yars::statemachine
