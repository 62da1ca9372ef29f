#include "databuffer/messages/validation.hpp"

#include <cmath>

#include "databuffer/messages/inspection.hpp"
#include "databuffer/messages/record_checks.hpp"

// check_fields() is generated from the ranges in the IDL. This file checks the fields whose range applies only under a
// condition on another field, such as a flag. The IDL marks these fields with @by_hand.
namespace yars::databuffer {

namespace {

// Validates a record in which no field's range depends on another field.
template <class Record>
Refusal validate_fields(const Record& record) {
  Inspection inspection;
  check_fields(inspection, record);
  return inspection.result();
}

// Checks the cursor. Without kCursorValid its fields may be NaN, but numbers must still be in range.
void inspect_cursor(Inspection& inspection, const RadarState& state) {
  using Range = RadarStateLimits;
  const Missing missing = (state.flags & kCursorValid) != 0U ? Missing::refused : Missing::allowed;
  inspection.range("cursor_latitude_deg", state.cursor_latitude_deg, Range::cursor_latitude_deg, missing);
  inspection.range("cursor_longitude_deg", state.cursor_longitude_deg, Range::cursor_longitude_deg, missing);
  inspection.range("cursor_bearing_deg", state.cursor_bearing_deg, Range::cursor_bearing_deg, missing);
  inspection.range("cursor_range_nm", state.cursor_range_nm, Range::cursor_range_nm, missing);
  inspection.range("cursor_believed_latitude_deg", state.cursor_believed_latitude_deg,
                   Range::cursor_believed_latitude_deg, missing);
  inspection.range("cursor_believed_longitude_deg", state.cursor_believed_longitude_deg,
                   Range::cursor_believed_longitude_deg, missing);
}

}  // namespace

Refusal validate(const RadarState& state) {
  Inspection inspection;
  check_fields(inspection, state);
  inspect_cursor(inspection, state);
  return inspection.result();
}

Refusal validate(const ClockState& clock) {
  using Range = ClockStateLimits;
  Inspection inspection;
  check_fields(inspection, clock);
  // A NaN latitude means that no repositioning took place. The other reposition fields are then not used.
  if (std::isnan(clock.reposition_latitude_deg)) return inspection.result();
  inspection.range("reposition_latitude_deg", clock.reposition_latitude_deg, Range::reposition_latitude_deg);
  inspection.range("reposition_longitude_deg", clock.reposition_longitude_deg, Range::reposition_longitude_deg);
  inspection.range("reposition_altitude_m", clock.reposition_altitude_m, Range::reposition_altitude_m);
  inspection.range("reposition_heading_deg", clock.reposition_heading_deg, Range::reposition_heading_deg);
  return inspection.result();
}

Refusal validate(const Outputs& outputs) {
  Inspection inspection;
  check_fields(inspection, outputs);
  // Of the marks in use, latitude and longitude are checked; their elevation is not, although the IDL gives it a range.
  // Numbers without a range in the IDL are not checked.
  for (const Mark& mark : used(outputs.marks, outputs.mark_count)) {
    inspection.latitude("marks.latitude_deg", mark.latitude_deg);
    inspection.longitude("marks.longitude_deg", mark.longitude_deg);
  }
  return inspection.result();
}

Refusal validate(const Ownship& ownship) {
  return validate_fields(ownship);
}

Refusal validate(const Nav& nav) {
  return validate_fields(nav);
}

Refusal validate(const PilotAdvice& advice) {
  return validate_fields(advice);
}

Refusal validate(const RecorderStatus& status) {
  return validate_fields(status);
}

Refusal validate(const Caption& caption) {
  return validate_fields(caption);
}

Refusal validate(const PatchMap& map) {
  return validate_fields(map);
}

Refusal validate(const Traffic& traffic) {
  return validate_fields(traffic);
}

Refusal validate(const GlassFrame& frame) {
  return validate_fields(frame);
}

Refusal validate(const ModelStatus& status) {
  return validate_fields(status);
}

Refusal validate(const Sweep& sweep) {
  return validate_fields(sweep);
}

Refusal validate(const ModelTick& tick) {
  return validate_fields(tick);
}

}  // namespace yars::databuffer
