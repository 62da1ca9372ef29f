// Ground symbols: cursor, sequence points with their names, window outline of a map, and pattern steering line (PSL), a
// line that shows from which direction the target is approached.
// Inputs: DisplayInput, view and frame (plan_view.hpp), labels of the last picture.
// Outputs: strokes and occupied boxes in a draw list; labels for text_layout.hpp.
// Frame: the cursor is drawn at its true ground position, as is the video. Points and target are displaced from their
// true positions by the position error of the selected navigator.
// Source: docs/pilots_manual.md#symbology
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "display/symbology/draw_list.hpp"
#include "display/symbology/plan_view.hpp"
#include "display/symbology/text_layout.hpp"
#include "lib/radar/modes.hpp"

namespace yars::display {

// Position of the cursor on the display [units]; nullopt if it is unknown or off the display.
std::optional<Point> cursor_at(const DisplayInput& input, const PlanView& view, const ViewFrame& frame);

// Records the boxes of the cursor's arms as occupied. Texts that can move are placed clear of these boxes.
void occupy_cursor(Point at, DrawList& list);

// Draws the cursor, a cross with an open centre, on the top layer. Its arms are left out where there is a text. Draw it
// after all texts.
void draw_cursor(Point at, DrawList& list);

// True if the cursor's position is known and is off the display.
bool cursor_is_off(const DisplayInput& input, const PlanView& view, const ViewFrame& frame);

// Draws the window of the commanded patch map while the map forms: a square with two sides along the line of sight.
void draw_window_outline(const DisplayInput& input, const PlanView& view, const ViewFrame& frame, DrawList& list);

// Display positions of the sequence points in RadarState::points, in the same order. nullopt: the entry has no point,
// or the point is not drawn, because it is outside the display or its symbol would be on or too near a text or a scale
// without gaps (BoxKind::solid). The selected point and the designated target are drawn wherever they are on the
// display.
using PlacedPoints = std::array<std::optional<Point>, radar::kMaxPointsDrawn>;
PlacedPoints place_points(const DisplayInput& input, const PlanView& view, const ViewFrame& frame,
                          const LabelMemory& labels, const DrawList& list);

// Draws a circle for a steer point, a square for an initial point, a triangle for a target. An offset of a point has
// the symbol of that point, dashed.
void draw_points(const databuffer::RadarState& state, const PlacedPoints& placed, DrawList& list);

// Rank of a name in label placement: the selected point, then the designated target, then all others.
enum class NameRank : std::uint8_t { selected, target, other };
// Adds the names of one rank, in the order of RadarState::points. Points that are not drawn get no name.
void add_names(const databuffer::RadarState& state, const PlacedPoints& placed, NameRank rank, LabelQueue& queue);

// Draws the PSL from the designated target back along the approach heading. Its far end has an arrowhead while the TDC
// turns the line, and a circle if the line is fixed. It ends before a fixed text, and is left out where too little of
// it would remain. Draw it after the fixed texts. Returns the label with the heading. It ends in MAG, or in TRUE while
// no magnetic variation is known. nullopt: there is no line, or the target is not on the display.
// Source: docs/pilots_manual.md#rule-15
std::optional<Label> draw_steering_line(const DisplayInput& input, const PlanView& view, const ViewFrame& frame,
                                        DrawList& list);

}  // namespace yars::display
