// What the navigators have wrong: put in by the instructor, grown by drift, taken out by updates. Truth and video never
// see it; symbols do. Source: spec physics.md, "Navigation errors"; pvi.md rule 13.
#pragma once

#include "statemachine/step.hpp"

namespace yars::statemachine {

void put_position_error(Step& step);  // `nav error`: [ft] north, east
void put_drift(Step& step);           // `nav drift`: [ft/s] north, east

}  // namespace yars::statemachine
