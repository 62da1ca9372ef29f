// Advice for the pilot in words: what each push button and the TDC's switch do now, or why they are dead. Reasons why
// events are without effect (dead) or refused, and what the pilot can do about it.
// Inputs: radar state, inputs of the tick, configuration; for events that were sent together, their effects and the
// states before the first and after the last. The states between are not known.
// Outputs: the record PilotAdvice, for tooltips, help and programs, in the words of the transition table. Texts in
// printable ASCII. A remedy names the event, and its key in parentheses: "freeze (Space)".
// Source: docs/pilots_manual.md#remedies
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

struct Reason {
  std::string words;   // "dead while frozen", "GIMBAL"
  std::string remedy;  // "end the freeze: freeze (Space)"; empty: nothing can or must be done
};

// The reason with its remedy as one text: "dead while frozen; end the freeze: freeze (Space)".
std::string text_of(const Reason& reason);

// Reason why the event has no effect in this state, for an event that is dead or changes nothing.
Reason reason_without_effect(const databuffer::RadarState& state, const databuffer::InputEvent& event);

struct AppliedSequence {
  std::span<const databuffer::InputEvent> events;
  std::span<const std::uint32_t> effects;  // kEventDone, kEventDead or kEventRefused, one for each event
  const databuffer::RadarState& before;
  const databuffer::RadarState& after;
  bool recorder_present = false;
  std::string remedy{};  // PilotAdvice::remedy after the events: what to do about the message of `after`
};

// Reason of the event with this index, which is refused or without effect. nullopt: not certain, because other events
// changed the state or replaced the message.
std::optional<Reason> certain_reason(const AppliedSequence& applied, std::size_t index);

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
