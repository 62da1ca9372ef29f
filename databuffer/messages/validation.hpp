// Validation of the records that other processes write (trust boundary).
// Outputs: the first fault as text (field, expected value, found value); nullopt for a valid record.
// Use: validate() repairs nothing. The reader skips the record, so that its last valid one stays in use, and reports
// the refusal.
// Ranges: as in the IDL files; both ends are valid. Heading 360 and longitude +-180 are valid, because rounding gives
// them. Every reader wraps these values. Heading 360.0001 is refused. NaN is valid in fields with the annotation @nan
// or without a range, in the cursor fields of a RadarState or RadarCommand without kCursorValid, and in the reposition
// fields of a ClockState whose reposition latitude is NaN.
#pragma once

#include "databuffer/messages/caption.hpp"
#include "databuffer/messages/input_event_record.hpp"
#include "databuffer/messages/inspection.hpp"
#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/network_status.hpp"
#include "databuffer/messages/pictures.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "databuffer/messages/world_state.hpp"

namespace yars::databuffer {

inline constexpr double kMaxElevation_deg = 60.0;  // of a commanded antenna elevation, up and down
// 240 steps of 0.5 deg cover the antenna's elevation range of 120 deg. Zero steps are not an event.
inline constexpr int kMaxElevationSteps = 240;

Refusal validate(const Ownship& ownship);
Refusal validate(const Nav& nav);
Refusal validate(const ClockState& clock);
Refusal validate(const PatchMap& map);
Refusal validate(const RecorderStatus& status);
Refusal validate(const Traffic& traffic);
Refusal validate(const WorldState& world);
Refusal validate(const GlassFrame& frame);
Refusal validate(const Outputs& outputs);
Refusal validate(const RadarState& state);
Refusal validate(const Caption& caption);
Refusal validate(const InputEvent& event);
Refusal validate(const AppliedEvent& applied);
Refusal validate(const PilotAdvice& advice);
Refusal validate(const NetworkStatus& status);
// Records of radar-model.
Refusal validate(const ModelStatus& status);
Refusal validate(const Sweep& sweep);
Refusal validate(const ModelTick& tick);

}  // namespace yars::databuffer
