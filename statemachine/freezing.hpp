// The frozen picture: freeze, the maps recalled on it, and SET, which works on it while the radar does something
// else. Source: docs/spec/pilots_interface.md#rule-8, #rule-9, #rule-10, #rule-19, #rule-20, #rule-21.
#pragma once

#include <cstdint>

#include "statemachine/step.hpp"

namespace yars::statemachine {

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

}  // namespace yars::statemachine
