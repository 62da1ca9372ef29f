// The pattern steering line: from the designated target back along the heading on which it is to be approached. Source:
// spec pvi.md rule 15.
#pragma once

#include "display/draw_list.hpp"
#include "display/glass_geometry.hpp"
#include "display/glass_input.hpp"

namespace yars::display {

// The line, its magnetic heading beneath the target, and at its end an arrowhead while it slews, a circle once it is
// fixed. Nothing without a target on the glass. Comes before the points, whose names keep clear of the heading.
void draw_steering_line(const GlassInput& input, const GlassView& view, const GlassFrame& frame, DrawList& list);

}  // namespace yars::display
