// The part of the radar state that the model acts on.
#pragma once

#include "databuffer/records/model_records.hpp"

namespace yars::databuffer {

RadarCommand command_from_state(const RadarState& state);

}  // namespace yars::databuffer
