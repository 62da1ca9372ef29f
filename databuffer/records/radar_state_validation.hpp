// The border for the radar state; see validation.hpp.
#pragma once

#include "databuffer/records/radar_state.hpp"
#include "databuffer/records/refusal.hpp"

namespace yars::databuffer {

Refusal why_refused(const RadarState& state);

}  // namespace yars::databuffer
