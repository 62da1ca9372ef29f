// Symbols that lie on the ground: cursor, sequence points, outline of a map, pattern steering line.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "display/symbology/draw_list.hpp"
#include "display/symbology/label_layout.hpp"
#include "display/symbology/plan_view.hpp"
#include "lib/radar/configuration.hpp"
#include "lib/radar/modes.hpp"

namespace yars::display {

// What lies on the ground: the cursor, the sequence points and their names, the outline of a map that forms.

// An open plus on the cursor's ground point, over everything else: the pilot steers it.
void draw_cursor(const DisplayInput& input, const PlanView& view, const ViewFrame& frame, DrawList& list);

// The window of the map that was commanded, while it forms: a square about its centre, sides along its line of sight.
void draw_window_outline(const DisplayInput& input, const PlanView& view, const ViewFrame& frame, DrawList& list);

// Where the points of the state are drawn, by their order there. A point off the glass has no place, nor one where a
// word or a solid scale stands: neither could be read. The selected point is drawn there, too; the word covers it.
// `labels` are those of the last picture.
using PlacedPoints = std::array<std::optional<Point>, radar::kMaxPointsDrawn>;
PlacedPoints place_points(const DisplayInput& input, const PlanView& view, const ViewFrame& frame,
                          const LabelMemory& labels, const DrawList& list);

// Steer point circle, initial point square, target triangle; offsets dashed. The route tells whether an offset belongs
// to an initial point.
void draw_points(const databuffer::RadarState& state, std::span<const radar::RoutePoint> route,
                 const PlacedPoints& placed, DrawList& list);

// Where there is no room for all names, these come first: of the selected point, of the designated target.
enum class NameRank : std::uint8_t { selected, target, other };
// The names of that rank of points that are drawn, in the order of the state.
void add_names(const databuffer::RadarState& state, const PlacedPoints& placed, NameRank rank, LabelQueue& queue);

// The pattern steering line: from the designated target back along the heading on which it is to be approached.
// Source: docs/spec/pilots_interface.md#rule-15.

// The line, and at its end an arrowhead while it slews, a circle once it is fixed. Returns its magnetic heading, a
// label of the target. Nothing without a target on the glass.
std::optional<Label> draw_steering_line(const DisplayInput& input, const PlanView& view, const ViewFrame& frame,
                                        DrawList& list);

}  // namespace yars::display
