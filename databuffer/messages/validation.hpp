// Validation of the records that other processes write (trust boundary): validate() of each record, which the
// generated record_checks.hpp declares.
// Outputs: the first fault as text (field, expected value, found value); nullopt for a valid record.
// Use: validate() repairs nothing. The reader skips the record, so that its last valid one stays in use, and reports
// the refusal.
// Ranges: as in the IDL files; both ends are valid. Heading 360 and longitude +-180 are valid, because rounding gives
// them. Every reader wraps these values. Heading 360.0001 is refused. NaN is valid in fields with the annotation @nan
// or without a range, in the cursor fields of a RadarState or RadarCommand without kCursorValid, and in the reposition
// fields of a ClockState whose reposition latitude is NaN.
#pragma once

#include "databuffer/messages/record_checks.hpp"

namespace yars::databuffer {

inline constexpr double kMaxElevation_deg = 60.0;  // of a commanded antenna elevation, up and down
// 240 steps of 0.5 deg cover the antenna's elevation range of 120 deg. Zero steps are not an event.
inline constexpr int kMaxElevationSteps = 240;

}  // namespace yars::databuffer
