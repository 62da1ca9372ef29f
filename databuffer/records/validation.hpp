// The border: whether a record that another process wrote can be believed. Each function gives nothing for a good
// record, else the first fault as text: field, what was expected, what was found. Nothing is repaired: the reader
// keeps its last good value and counts the refusal.
// Ranges are those written in the records. Both ends of a circle belong to it: heading 360 and longitude +-180 are
// what rounding makes of 0 and of the antimeridian, and every user of them wraps; 360.0001 is refused.
#pragma once

#include "databuffer/records/clock_state.hpp"
#include "databuffer/records/event_validation.hpp"
#include "databuffer/records/glass_frame.hpp"
#include "databuffer/records/outputs.hpp"
#include "databuffer/records/ownship.hpp"
#include "databuffer/records/patch_map.hpp"
#include "databuffer/records/radar_state_validation.hpp"
#include "databuffer/records/recorder_status.hpp"
#include "databuffer/records/traffic.hpp"

namespace yars::databuffer {

Refusal why_refused(const Ownship& ownship);
Refusal why_refused(const Nav& nav);
Refusal why_refused(const ClockState& clock);
Refusal why_refused(const PatchMap& map);
Refusal why_refused(const RecorderStatus& status);
Refusal why_refused(const Traffic& traffic);
Refusal why_refused(const GlassFrame& frame);
Refusal why_refused(const Outputs& outputs);

}  // namespace yars::databuffer
