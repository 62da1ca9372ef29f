// Advice for the pilot in words: what each push button and the TDC's switch do now, or why they are dead.
// Inputs: radar state, inputs of the tick, configuration.
// Outputs: the record PilotAdvice, for tooltips, help and programs. The words are those of the transition table.
// Source: docs/pilots_manual.md#remedies
#pragma once

#include <cstdint>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

// Fills remedy, live and buttons; the other fields of `advice` stay. Each action is tried on a copy of the state.
void advise(databuffer::PilotAdvice& advice, const databuffer::RadarState& state, const Inputs& inputs,
            const Parameters& parameters);

// An event that was refused or without effect.
struct IdleEvent {
  const databuffer::InputEvent& event;
  std::uint32_t lane = 0;  // input lane of the event
  bool refused = false;
};

// Notes the event with its reason. `state`: after the event.
void note_idle(databuffer::PilotAdvice& advice, const IdleEvent& idle, const databuffer::RadarState& state,
               const Inputs& inputs, const Parameters& parameters);

}  // namespace yars::statemachine
