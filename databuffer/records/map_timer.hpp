// When the pilot is told how long a patch map takes. Source: docs/spec/pilots_interface.md#rule-6.
#pragma once

#include <optional>

#include "databuffer/records/model_records.hpp"
#include "databuffer/records/radar_state.hpp"

namespace yars::databuffer {

// Time left [s] of the map that forms; else what one at the cursor would take, in RBM, HRM PPI and on a patch, with
// cursor MAP, a window selected and the cursor mappable. Nothing when the model tells no number.
std::optional<double> map_timer_s(const RadarState& state, const ModelStatus& model);

}  // namespace yars::databuffer
