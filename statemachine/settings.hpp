// Settings of one press: range, scan width, window, elevation, gain, brightness, switches.
#pragma once

#include <cstddef>

#include "lib/geo/quantity.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

// What the radar looks at: range, scan width, window, antenna elevation. Source: docs/spec/pilots_interface.md#rule-1,
// #rule-2, #rule-4.
void range_up(Step& step);
void range_down(Step& step);
void next_scan_width(Step& step);  // FULL, HALF, QTR, FULL
void step_window(Step& step);      // up stops at the range; below the smallest is blank
void set_elevation(Step& step);    // absolute, stops at the gimbal
void step_elevation(Step& step);   // by 0.5 degrees

// Selects a range; a window that no longer fits shrinks with it.
void set_range_index(databuffer::RadarState& state, std::size_t index, const radar::RadarConfiguration& configuration);
void set_scan_width(databuffer::RadarState& state, radar::ScanWidth scan,
                    const radar::RadarConfiguration& configuration);
// The largest window that is neither larger than this nor than the range.
void select_window(databuffer::RadarState& state, geo::Length window, const radar::RadarConfiguration& configuration);

// Rule 1. Without a valid ownship there is no height: the range stays.
void set_range_by_height(databuffer::RadarState& state, const Inputs& inputs,
                         const radar::RadarConfiguration& configuration);

// Actions that turn one switch: cyclic ones go round, levels stop at their ends.
// Source: docs/spec/pilots_interface.md#buttons, #controls, #rule-9, #rule-19, #rule-22.
void toggle_declutter(Step& step);
void cycle_gain(Step& step);    // 3 to 0, then 3
void toggle_looks(Step& step);  // ML1, ML2
void brightness_up(Step& step);
void brightness_down(Step& step);
void step_contrast(Step& step);
void toggle_stabilizing(Step& step);  // STAB, PROG
void toggle_recorder(Step& step);     // rule 22: asks the recorder; NO RECORDER when there is none
void advance_recorder(databuffer::RadarState& state, const Inputs& inputs);  // once a tick
void toggle_ipvu(Step& step);
void toggle_sniff(Step& step);  // rules 9, 19: in HRM it freezes; a map under way ends
void next_channel(Step& step);  // 1 to 8, then 1
void next_band(Step& step);     // A to E, then A
void select_navigator(Step& step);
void switch_altimeter(Step& step);

}  // namespace yars::statemachine
