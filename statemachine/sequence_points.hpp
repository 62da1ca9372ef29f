// The sequence points on the glass and stepping over them. Source: docs/spec/pilots_interface.md#rule-11.
#pragma once

#include <optional>

#include "statemachine/step.hpp"

namespace yars::statemachine {

// The next of the points drawn, in their order, round and round; the cursor jumps to it.
void next_sequence_point(Step& step);
// The point with the event's name, of the route or designated; an unknown name is refused.
void select_sequence_point(Step& step);

// The first of the route in the order of stepping; none when there is no route.
void select_first_sequence_point(databuffer::RadarState& state, const radar::RadarConfiguration& configuration);

// The selected point of the route, or the target designated when that is selected.
std::optional<radar::RoutePoint> selected_point(const databuffer::RadarState& state,
                                                const radar::RadarConfiguration& configuration);

// Fills `points`: at most five, the nearest within the range, the selected one and the target designated always among
// them; declutter leaves targets, their offsets and the selected one. Costs a geodesic a route point: call it when
// something has changed and a few times a second.
void draw_points(databuffer::RadarState& state, const Surroundings& surroundings,
                 const radar::RadarConfiguration& configuration);

}  // namespace yars::statemachine
