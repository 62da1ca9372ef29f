// Validation of every record but input events at the trust boundary.
#pragma once

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/inspection.hpp"
#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/pictures.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "databuffer/messages/world_state.hpp"

namespace yars::databuffer {

// The border: whether a record that another process wrote can be believed. Each function gives nothing for a good
// record, else the first fault as text: field, what was expected, what was found. Nothing is repaired: the reader
// keeps its last good value and counts the refusal.
// Ranges are those written in the records. Both ends of a circle belong to it: heading 360 and longitude +-180 are
// what rounding makes of 0 and of the antimeridian, and every user of them wraps; 360.0001 is refused.
Refusal validate(const Ownship& ownship);
Refusal validate(const Nav& nav);
Refusal validate(const ClockState& clock);
Refusal validate(const PatchMap& map);
Refusal validate(const RecorderStatus& status);
Refusal validate(const Traffic& traffic);
Refusal validate(const GlassFrame& frame);
Refusal validate(const Outputs& outputs);
Refusal validate(const RadarState& state);
// What the radar model publishes. NaN stands where the records allow "unknown".
Refusal validate(const ModelStatus& status);
Refusal validate(const Sweep& sweep);
Refusal validate(const ModelTick& tick);

}  // namespace yars::databuffer
