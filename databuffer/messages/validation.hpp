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
Refusal why_refused(const Ownship& ownship);
Refusal why_refused(const Nav& nav);
Refusal why_refused(const ClockState& clock);
Refusal why_refused(const PatchMap& map);
Refusal why_refused(const RecorderStatus& status);
Refusal why_refused(const Traffic& traffic);
Refusal why_refused(const GlassFrame& frame);
Refusal why_refused(const Outputs& outputs);
Refusal why_refused(const RadarState& state);
// What the radar model publishes. NaN stands where the records allow "unknown".
Refusal why_refused(const ModelStatus& status);
Refusal why_refused(const Sweep& sweep);
Refusal why_refused(const ModelTick& tick);

}  // namespace yars::databuffer
