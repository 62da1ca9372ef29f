// What the radar looks at: range, scan width, window, antenna elevation. Source: docs/spec/pilots_interface.md#rule-1,
// #rule-2, #rule-4.
#pragma once

#include <cstddef>

#include "lib/geo/quantity.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

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
void set_range_by_height(databuffer::RadarState& state, const Surroundings& surroundings,
                         const radar::RadarConfiguration& configuration);

}  // namespace yars::statemachine
