// What the state machine tells the rest of the aircraft: sensors, weapons, head-up display. Points are as the navigator
// in use has them. Written every tick, also with the radar off: a target forgotten has to be told.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "databuffer/records/radar_state.hpp"

namespace yars::databuffer {

enum class SteeringCommand : std::uint8_t { none = 0, azimuth = 1, bank = 2 };

struct Outputs {
  std::int64_t tick;
  std::int64_t sim_time_ns;
  // CUE and TGT: where another sensor shall look.
  double cue_latitude_deg;   // [deg] holds while cue_count > 0
  double cue_longitude_deg;  // [deg]
  double cue_elevation_m;    // [m] MSL; NaN = unknown
  // TGT
  double target_latitude_deg;   // [deg] holds while target_name is not empty
  double target_longitude_deg;  // [deg]
  double target_elevation_m;    // [m] MSL; NaN = unknown
  char target_name[8];          // zero terminated; empty = none designated
  // Ranging to the target, from the aircraft; NaN = no target.
  double slant_range_m;   // [m]
  double bearing_deg;     // [deg] [0, 360) true
  double depression_deg;  // [deg] below the horizon
  // Steering to the target; NaN = none.
  double steering_deg;  // [deg] azimuth: of the target, right of the ground track; bank: right wing down
  double approach_deg;  // [deg] [0, 360) true heading of the pattern steering line
  std::uint32_t epoch;
  std::uint32_t cue_count;     // counts up with each cue
  std::uint32_t target_count;  // counts up with each designation
  std::uint8_t steering;       // SteeringCommand
  std::uint8_t mark_count;     // entries of marks
  std::uint8_t reserved_bytes[2];
  Mark marks[kMarks];  // oldest first
  std::uint64_t reserved[8];
};
static_assert(sizeof(Outputs) % 8 == 0 && std::is_trivially_copyable_v<Outputs>);
static_assert(offsetof(Outputs, marks) == 128);

}  // namespace yars::databuffer
