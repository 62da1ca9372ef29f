// Reasons why events are without effect (dead) or refused, and what the pilot can do about it.
// Inputs: the radar state and the event; for events that were sent together, their effects and the states before the
// first and after the last. The states between are not known.
// Outputs: texts in printable ASCII. A remedy names the event, and its key in parentheses: "freeze (Space)".
// Source: docs/pilots_manual.md#remedies
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/radar_state.hpp"

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

}  // namespace yars::statemachine
