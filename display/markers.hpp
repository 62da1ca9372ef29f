// What lies on the ground: the cursor, the sequence points with their names, the outline of a map that forms.
#pragma once

#include <span>

#include "display/draw_list.hpp"
#include "display/glass_geometry.hpp"
#include "display/glass_input.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::display {

// An open plus on the cursor's ground point.
void draw_cursor(const GlassInput& input, const GlassView& view, const GlassFrame& frame, DrawList& list);

// The window of the map that was commanded, while it forms: a square about its centre, sides along its line of sight.
void draw_window_outline(const GlassInput& input, const GlassView& view, const GlassFrame& frame, DrawList& list);

// Steer point circle, initial point square, target triangle; offsets dashed. A name takes the first free one of
// four places beside its symbol, clear of the cursor and of whatever the list holds; so legends and readouts come
// first.
// The route tells whether an offset belongs to an initial point. Points off the glass are not drawn.
void draw_points(const GlassInput& input, std::span<const radar::RoutePoint> route, const GlassView& view,
                 const GlassFrame& frame, DrawList& list);

}  // namespace yars::display
