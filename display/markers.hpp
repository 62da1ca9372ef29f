// What lies on the ground: the cursor, the sequence points and their names, the outline of a map that forms.
#pragma once

#include <cstdint>
#include <span>

#include "display/draw_list.hpp"
#include "display/glass_geometry.hpp"
#include "display/glass_input.hpp"
#include "display/label_layout.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::display {

// An open plus on the cursor's ground point, over everything else: the pilot steers it.
void draw_cursor(const GlassInput& input, const GlassView& view, const GlassFrame& frame, DrawList& list);

// The window of the map that was commanded, while it forms: a square about its centre, sides along its line of sight.
void draw_window_outline(const GlassInput& input, const GlassView& view, const GlassFrame& frame, DrawList& list);

// Steer point circle, initial point square, target triangle; offsets dashed. The route tells whether an offset belongs
// to an initial point. Points off the glass are not drawn.
void draw_points(const GlassInput& input, std::span<const radar::RoutePoint> route, const GlassView& view,
                 const GlassFrame& frame, DrawList& list);

// Where there is no room for all names, these come first: of the selected point, of the designated target.
enum class NameRank : std::uint8_t { selected, target, other };
// The names of that rank of points on the glass, in the order of the state.
void add_names(const GlassInput& input, const GlassView& view, const GlassFrame& frame, NameRank rank,
               LabelQueue& queue);

}  // namespace yars::display
