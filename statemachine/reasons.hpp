// Reasons why events that were sent together were refused or had no effect (were dead).
// Inputs: the events with their effects; the states before the first and after the last event. The states between are
// not known.
// Output: the reason of one event, only where it is certain.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/radar_state.hpp"

namespace yars::statemachine {

struct AppliedSequence {
  std::span<const databuffer::InputEvent> events;
  std::span<const std::uint32_t> effects;  // kEventDone, kEventDead or kEventRefused, one for each event
  const databuffer::RadarState& before;
  const databuffer::RadarState& after;
  bool recorder_present = false;
};

// Reason of the event with this index, which is refused or without effect. nullopt: not certain, because other events
// changed the state or replaced the message.
std::optional<std::string> certain_reason(const AppliedSequence& applied, std::size_t index);

}  // namespace yars::statemachine
