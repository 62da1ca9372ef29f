// What the radar measures of the aircraft's velocity against what the navigator has.
// Source: docs/spec/pilots_interface.md#rule-16.
#pragma once

#include "display/draw_list.hpp"
#include "display/glass_input.hpp"

namespace yars::display {

// IPVU: the differences of the last update, for as long as the state says.
void draw_velocity_differences(const databuffer::RadarState& state, DrawList& list);

// PVU: the same large, all the time, and the beam under way.
void draw_velocity_format(const GlassInput& input, DrawList& list);

}  // namespace yars::display
