// Actions that turn one switch: cyclic ones go round, levels stop at their ends.
// Source: docs/spec/pilots_interface.md#buttons, #controls, #rule-9, #rule-19, #rule-22.
#pragma once

#include "statemachine/step.hpp"

namespace yars::statemachine {

void toggle_declutter(Step& step);
void cycle_gain(Step& step);    // 3 to 0, then 3
void toggle_looks(Step& step);  // ML1, ML2
void brightness_up(Step& step);
void brightness_down(Step& step);
void step_contrast(Step& step);
void toggle_stabilizing(Step& step);  // STAB, PROG
void toggle_recorder(Step& step);     // rule 22: asks the recorder; NO RECORDER when there is none
void advance_recorder(databuffer::RadarState& state, const Surroundings& surroundings);  // once a tick
void toggle_ipvu(Step& step);
void toggle_sniff(Step& step);  // rules 9, 19: in HRM it freezes; a map under way ends
void next_channel(Step& step);  // 1 to 8, then 1
void next_band(Step& step);     // A to E, then A
void select_navigator(Step& step);
void switch_altimeter(Step& step);

// A word for the pilot that goes by itself.
void show_message(databuffer::RadarState& state, const Surroundings& surroundings, std::string_view text);
// The event cannot be done, for this reason.
void refuse(Step& step, std::string_view reason);

}  // namespace yars::statemachine
