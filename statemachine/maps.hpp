// Patch maps: commanded by the pilot, taken up when the model has made them, cancelled when the radar leaves for
// something else. Source: docs/spec/pilots_interface.md#rule-3, #rule-4, #rule-5, #rule-6, #rule-7, #rule-8.
#pragma once

#include <cstdint>

#include "statemachine/step.hpp"

namespace yars::statemachine {

// TDC release with cursor MAP. What cannot be mapped is rejected with a word why, and nothing else happens.
void command_map(Step& step);

// The map commanded is not wanted any more: what still comes of it answers nobody. What is mapped again and again
// on a patch is once more the newest map.
void cancel_map(databuffer::RadarState& state, const Surroundings& surroundings);

// A map that the model has completed: the one commanded becomes NEW, moves NEW to OLD and brings up the patch; a
// re-map takes the place of NEW; any other is ignored.
void take_map(databuffer::RadarState& state, const Surroundings& surroundings);

// Says why the patch shown is not mapped again, for as long as it is not.
void tell_why_map_stopped(databuffer::RadarState& state, const Surroundings& surroundings);

// What is known of a map; nullptr when there is none of this id.
const databuffer::PatchMap* map_of(const Surroundings& surroundings, std::uint64_t id);

}  // namespace yars::statemachine
