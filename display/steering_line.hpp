// The pattern steering line: from the designated target back along the heading on which it is to be approached.
// Source: docs/spec/pilots_interface.md#rule-15.
#pragma once

#include <optional>

#include "display/draw_list.hpp"
#include "display/glass_geometry.hpp"
#include "display/glass_input.hpp"
#include "display/label_layout.hpp"

namespace yars::display {

// The line, and at its end an arrowhead while it slews, a circle once it is fixed. Returns its magnetic heading, a
// label of the target. Nothing without a target on the glass.
std::optional<Label> draw_steering_line(const GlassInput& input, const GlassView& view, const GlassFrame& frame,
                                        DrawList& list);

}  // namespace yars::display
