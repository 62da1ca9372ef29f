// Records of the state machine, of what it tells the aircraft, and of the recorder it starts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "lib/radar/modes.hpp"

namespace yars::databuffer {

struct DrawnPoint {
  double latitude_deg;
  double longitude_deg;
  double elevation_m;     // [m] MSL; NaN = unknown
  char name[8];           // "2.01", zero terminated
  std::uint8_t kind;      // radar::PointKind
  std::uint8_t selected;  // 1: the selected sequence point
  std::uint8_t reserved[6];
};
static_assert(sizeof(DrawnPoint) == 40);

// What a navigator has wrong beside what its lane says: added to the lane's position and velocity.
struct NavigatorError {
  double north_m;             // [m]
  double east_m;              // [m]
  double velocity_north_mps;  // [m/s]
  double velocity_east_mps;   // [m/s]
  double velocity_down_mps;   // [m/s]
};
static_assert(sizeof(NavigatorError) == 40);

// What MARK stored.
struct Mark {
  double latitude_deg;   // [deg] as the navigator in use has it
  double longitude_deg;  // [deg]
  double elevation_m;    // [m] MSL; NaN = unknown
  std::int64_t sim_time_ns;
};
static_assert(sizeof(Mark) == 32);
inline constexpr std::size_t kMarks = 10;

inline constexpr double kUpdateErrorInFeet = 3000.0;  // [ft] UPDT errors are told in feet up to here, in NM beyond

enum class SteeringLine : std::uint8_t { none = 0, line_of_sight = 1, slewing = 2, fixed = 3 };

// Bits of RadarState::flags.
inline constexpr std::uint32_t kDeclutter = 1U << 0;
inline constexpr std::uint32_t kFreeze = 1U << 1;  // commanded by the pilot; the scan stops at its end
inline constexpr std::uint32_t kSniff = 1U << 2;
inline constexpr std::uint32_t kIpvu = 1U << 3;
inline constexpr std::uint32_t kVtr = 1U << 4;
inline constexpr std::uint32_t kSet = 1U << 5;
inline constexpr std::uint32_t kMenu = 1U << 6;
inline constexpr std::uint32_t kMultiLook2 = 1U << 7;
inline constexpr std::uint32_t kProgressive = 1U << 8;  // PROG; else STAB
inline constexpr std::uint32_t kAltimeterFailed = 1U << 9;
inline constexpr std::uint32_t kCursorValid = 1U << 10;
inline constexpr std::uint32_t kTdcPressed = 1U << 11;
inline constexpr std::uint32_t kFrozenByHrmExit = 1U << 12;
inline constexpr std::uint32_t kMapping = 1U << 14;        // a map was commanded and is not there yet
inline constexpr std::uint32_t kRangeSet = 1U << 13;       // the range rule has been applied since power-up
inline constexpr std::uint32_t kUpdateShown = 1U << 15;    // update_north_m and update_east_m hold
inline constexpr std::uint32_t kUpdateInvalid = 1U << 16;  // INV: the cursor's place is too old for an INS update
inline constexpr std::uint32_t kTargetDesignated = 1U << 17;
inline constexpr std::uint32_t kVelocityShown = 1U << 18;   // velocity_along_mps and its sisters hold
inline constexpr std::uint32_t kMapWindowBlank = 1U << 19;  // map_window_nm was chosen by range: none was selected
inline constexpr std::uint32_t kRecalledByHrmExit = 1U << 20;

inline constexpr std::int64_t kUntilCauseEnds = -1;  // of message_until_tick

// Bits of RadarState::asked_for: whose elevation is awaited. Bit n below these: marks[n].
inline constexpr std::uint32_t kAskedForTarget = 1U << 16;
inline constexpr std::uint32_t kAskedForCue = 1U << 17;

// The whole state of the state machine: what the pilot has set, what the legends say, and all that a restarted
// state machine needs to go on. Written once a tick when it has changed.
struct RadarState {
  std::int64_t tick;             // tick of the last change
  double range_nm;               // [NM] selected range
  double scan_width_deg;         // [deg] whole width
  double antenna_elevation_deg;  // [deg] [-60, 60] commanded, against the horizon
  double cursor_latitude_deg;    // [deg] the ground point under the cursor on the video: where it truly lies
  double cursor_longitude_deg;
  double cursor_elevation_m;     // [m] MSL; NaN = unknown
  double cursor_bearing_deg;     // [deg] magnetic, from the aircraft
  double cursor_range_nm;        // [NM] ground range from the aircraft
  double tdc_x, tdc_y;           // [-1, 1] held deflection
  double window_nm;              // [NM]; 0 = blank
  std::uint64_t events_applied;  // since the session began
  std::uint32_t epoch;
  std::uint32_t flags;         // kDeclutter...
  std::uint32_t scan_restart;  // counts up when the scan has to start anew (range, mode, width changed)
  std::uint32_t boxed;         // bit n: legend of PB n is boxed
  std::uint8_t power;          // radar::Power
  std::uint8_t mode;           // radar::Mode as shown (RBM, ..., MENU)
  std::uint8_t master;         // radar::Master
  std::uint8_t resume_mode;    // radar::Mode that runs; equal to mode but under the menu
  std::uint8_t range_index;
  std::uint8_t scan;                // radar::ScanWidth
  std::uint8_t gain;                // 0..3
  std::uint8_t brightness;          // 0..15
  std::uint8_t contrast;            // 0..15
  std::uint8_t cursor_function;     // radar::CursorFunction
  std::uint8_t navigator;           // radar::Navigator
  std::uint8_t channel;             // 1..8
  std::uint8_t band;                // 0..4: A..E
  std::uint8_t points_drawn;        // entries of points
  std::uint8_t window_index;        // into the configuration's windows; 255 = blank
  std::uint8_t recall;              // radar::Recall
  char sequence_point[8];           // name of the selected one, zero terminated
  char message[32];                 // for the pilot, zero terminated; empty = none
  std::int64_t message_until_tick;  // the message goes at this tick; kUntilCauseEnds
  DrawnPoint points[radar::kMaxPointsDrawn];
  char legends[radar::kBezelButtons + 1][8];  // [n]: legend of PB n, zero terminated, empty = none; [0] unused
  double frame_latitude_deg;   // [deg] apex of the cursor's frame: the aircraft, or where it was when the picture froze
  double frame_longitude_deg;  // [deg]
  double frame_track_deg;      // [deg] [0, 360) true ground track of that frame, up on the glass
  std::uint8_t ground_mode;    // radar::Mode to go back to from A/A and ranging
  std::uint8_t reserved_bytes[3];
  std::uint32_t map_request;  // counts up with every map that the pilot commands
  double map_latitude_deg;    // [deg] centre of that map
  double map_longitude_deg;   // [deg]
  double map_window_nm;       // [NM] its edge
  // Maps by id, 0 = none; the radar model reuses no slot that is named here.
  std::uint64_t map_newest;
  std::uint64_t map_old;
  std::uint64_t map_stored;
  std::uint64_t map_shown;
  double cursor_believed_latitude_deg;   // [deg] the cursor as the navigator in use has it: told to others
  double cursor_believed_longitude_deg;  // [deg]
  NavigatorError mission;
  NavigatorError ins;
  // UPDT: from the selected sequence point as the glass shows it to the cursor.
  double update_north_m;           // [m]
  double update_east_m;            // [m]
  std::int64_t cursor_moved_tick;  // when the cursor was last slewed or sent to a point
  std::int32_t update_seconds;     // [s] until the cursor's place is too old for an INS update; -1 = it does not age
  std::uint32_t vtr_request;       // counts up with PB 12: the recorder starts or stops writing
  // The designated target, and what leads to it.
  double target_latitude_deg;   // [deg] as the navigator had it
  double target_longitude_deg;  // [deg]
  double target_elevation_m;    // [m] MSL; NaN = unknown
  char target_name[8];          // "4.", "2.01", zero terminated
  double steering_line_deg;     // [deg] [0, 360) true heading of the pattern steering line, toward the target
  double cue_latitude_deg;      // [deg] what the other sensor was last slaved to; holds while cue_count > 0
  double cue_longitude_deg;     // [deg]
  double cue_elevation_m;       // [m] MSL; NaN = unknown
  std::uint32_t cue_count;      // counts up with CUE and TGT
  std::uint32_t target_count;   // counts up with TGT
  std::uint8_t steering_line;   // SteeringLine
  std::uint8_t mark_count;      // entries of marks; the oldest makes way
  std::uint8_t reserved_bytes2[2];
  std::uint32_t velocity_taken;            // ModelStatus::velocity_count that was last looked at
  std::int64_t velocity_updated_tick;      // when the navigator's velocity was last put right; -1 = never
  std::int64_t velocity_shown_until_tick;  // the differences of IPVU go at this tick
  double velocity_along_mps;               // [m/s] radar less mission navigator, along the ground track
  double velocity_across_mps;              // [m/s] to the right
  double velocity_vertical_mps;            // [m/s] up
  Mark marks[kMarks];
  double magnetic_variation_deg;  // [deg] east positive: of the navigator, of the field's model, or configured
  // The ground whose elevation the model is to tell: a point that was designated, else the cursor's.
  double asked_latitude_deg;   // [deg] on the video
  double asked_longitude_deg;  // [deg]
  std::int64_t asked_tick;     // when it was designated
  std::uint32_t asked_for;     // kAskedFor...; 0 = the cursor alone
  std::uint32_t reserved_word;
  std::uint64_t reserved[3];
};
static_assert(sizeof(RadarState) % 8 == 0 && std::is_trivially_copyable_v<RadarState>);
static_assert(offsetof(RadarState, power) == 120);

enum class SteeringCommand : std::uint8_t { none = 0, azimuth = 1, bank = 2 };

// What the state machine tells the rest of the aircraft: sensors, weapons, head-up display. Points are as the navigator
// in use has them. Written every tick, also with the radar off: a target forgotten has to be told.
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

// What the recorder says of itself: PB 12 is boxed while it writes.
struct RecorderStatus {
  std::int64_t tick;
  std::int64_t sim_time_ns;
  std::uint64_t bytes;        // of the file so far
  std::uint32_t writing;      // 1: what happens now goes into the file
  std::uint32_t vtr_request;  // the last RadarState::vtr_request obeyed
  char problem[48];           // why it stopped writing, zero terminated; empty = none
  std::uint64_t reserved[4];
};
static_assert(sizeof(RecorderStatus) == 112 && std::is_trivially_copyable_v<RecorderStatus>);

}  // namespace yars::databuffer
