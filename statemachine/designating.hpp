// CUE, TGT and MARK: what the point under the cursor is given to. Points are told as the navigator in use has them.
// Source: docs/spec/pilots_interface.md#rule-14.
#pragma once

#include <optional>

#include "statemachine/step.hpp"

namespace yars::statemachine {

void cue_sensor(Step& step);
void designate_target(Step& step);  // also cues; on a point of the route it takes that one
void store_mark(Step& step);        // ten are kept: the oldest makes way

// The designated target as a point among the sequence points; nothing when none is.
std::optional<radar::RoutePoint> designated_point(const databuffer::RadarState& state);

}  // namespace yars::statemachine
