// Patch maps: commanded, taken up, cancelled; the frozen picture and the maps recalled on it.
#pragma once

#include <cstdint>

#include "statemachine/step.hpp"

namespace yars::statemachine {

// The frozen picture: freeze, the maps recalled on it, and SET, which works on it while the radar does something
// else. Source: docs/spec/pilots_interface.md#rule-8, #rule-9, #rule-10, #rule-19, #rule-20, #rule-21.
void toggle_freeze(Step& step);
void flip_recall(Step& step);   // PB 10: NEW and OLD, or STORE and NEW
void toggle_store(Step& step);  // PB 15: protects the map shown; the second press gives it up
void toggle_set(Step& step);    // PB 18 over a map that stands frozen

void freeze(databuffer::RadarState& state);
void thaw(databuffer::RadarState& state);  // forgets what was recalled and stored

// Rule 19: HRM that may not transmit keeps the picture it has.
void freeze_silent_hrm(databuffer::RadarState& state);

// Rule 21: when A/G leaves HRM, the map on the display, or over a PPI the newest, stands frozen; back in A/G that
// freeze ends, but for SET. Source: report, appendix A, "Set Function": "the last HRM map is automatically frozen".
void freeze_on_leaving(databuffer::RadarState& state);
void thaw_on_return(databuffer::RadarState& state);

// The map that belongs on the glass; 0 = none.
std::uint64_t map_to_show(const databuffer::RadarState& state);

// Patch maps: commanded by the pilot, taken up when the model has made them, cancelled when the radar leaves for
// something else. Source: docs/spec/pilots_interface.md#rule-3, #rule-4, #rule-5, #rule-6, #rule-7, #rule-8.

// TDC release with cursor MAP. What cannot be mapped is rejected with a word why, and nothing else happens.
void command_map(Step& step);

// The map commanded is not wanted any more: what still comes of it answers nobody. What is mapped again and again
// on a patch is once more the newest map.
void cancel_map(databuffer::RadarState& state, const Inputs& inputs);

// A map that the model has completed: the one commanded becomes NEW, moves NEW to OLD and is to bring up the patch
// (true); a re-map takes the place of NEW; any other is ignored.
bool take_map(databuffer::RadarState& state, const Inputs& inputs);

// Says why the patch shown is not mapped again, for as long as it is not.
void tell_why_map_stopped(databuffer::RadarState& state, const Inputs& inputs);

// What is known of a map; nullptr when there is none of this id.
const databuffer::PatchMap* map_of(const Inputs& inputs, std::uint64_t id);

}  // namespace yars::statemachine
