// What the radar model publishes: each tick what it latched, each sweep, and its own status.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "databuffer/messages/world_state.hpp"

namespace yars::databuffer {

// The part of the radar state that the model acts on; so that a legend's change does not count as an input.
struct RadarCommand {
  double range_nm;               // [NM]
  double scan_width_deg;         // [deg]
  double antenna_elevation_deg;  // [deg] against the horizon
  double cursor_latitude_deg;    // [deg]
  double cursor_longitude_deg;
  double window_nm;
  std::uint32_t scan_restart;  // a change restarts the scan
  std::uint32_t flags;         // RadarState's flags that matter here: freeze, sniff, looks, mapping
  std::uint8_t power, mode, scan, gain;
  std::uint8_t range_index, channel, band, reserved0;
  double map_latitude_deg;  // [deg] centre of the patch map asked for
  double map_longitude_deg;
  float map_window_nm;        // [NM]
  std::uint32_t map_request;  // a change asks for a map
};
static_assert(sizeof(RadarCommand) == 88 && std::is_trivially_copyable_v<RadarCommand>);

inline constexpr std::uint32_t kTickOwnshipChanged = 1U;  // ownship differs from the tick before
inline constexpr std::uint32_t kTickCommandChanged = 2U;
inline constexpr std::uint32_t kTickOwnshipValid = 4U;  // a fresh ownship was selected
inline constexpr std::uint32_t kTickRestart = 8U;  // the kernel was made anew before this tick (start of the process)
inline constexpr std::uint32_t kTickTerrainPending =
    16U;  // posts in view were still loading: this scan is not reproducible
inline constexpr std::uint32_t kTickMapComplete = 32U;  // the patch map under way went out before this tick

struct ModelTick {
  std::int64_t tick;
  std::int64_t sim_time_ns;
  Ownship ownship;
  RadarCommand command;
  std::uint64_t terrain_generation;
  std::uint32_t epoch;
  std::uint32_t flags;         // kTick...
  std::uint32_t ownship_lane;  // which lane was selected; 0xffffffff = none
  std::uint32_t samples;       // a sweep, fidelity used
  char fidelity[16];
  std::int64_t resumed_tick;  // with kTickRestart: tick of the status that the new kernel took up; -1 = none
  std::uint64_t traffic;      // records of traffic_latched before this tick; the last of them holds
  std::uint64_t reserved[2];
};
static_assert(sizeof(ModelTick) == 16 + 144 + 88 + 8 + 16 + 16 + 32 && std::is_trivially_copyable_v<ModelTick>);

// Values of AppliedEvent::effective.
inline constexpr std::uint32_t kEventDead = 0;     // dead in this mode, or it changed nothing
inline constexpr std::uint32_t kEventDone = 1;     // it changed something
inline constexpr std::uint32_t kEventRefused = 2;  // it cannot be done; the display says why

struct AppliedEvent {
  std::int64_t tick;          // of the state machine that applied it
  std::int64_t monotonic_ns;  // [ns] when it was applied
  InputEvent event;
  std::uint32_t lane;       // input lane it came by
  std::uint32_t effective;  // kEvent...
};
static_assert(sizeof(AppliedEvent) == 80 && std::is_trivially_copyable_v<AppliedEvent>);

inline constexpr std::uint32_t kSweepBlank = 1U;      // nothing transmitted, nothing received (turn-around, blanking)
inline constexpr std::uint32_t kSweepNoiseOnly = 2U;  // SNIFF: receiver noise, no returns
inline constexpr std::uint32_t kSweepScanStart = 4U;  // first of its scan
inline constexpr std::uint32_t kSweepScanEnd = 8U;    // last of its scan
inline constexpr std::uint32_t kSweepNotReady = 16U;  // some posts were not loaded yet

struct Sweep {
  std::int64_t tick;
  std::int64_t sim_time_ns;
  double apex_latitude_deg;  // [deg] where the aircraft was
  double apex_longitude_deg;
  double apex_altitude_msl_m;  // [m]
  double azimuth_left_deg;     // [deg] true, counter-clockwise edge of the wedge
  double azimuth_right_deg;    // [deg] true, clockwise edge of the wedge
  double ground_track_deg;     // [deg] true, at the time
  double elevation_deg;        // [deg] antenna, against the horizon
  double range_m;              // [m] ground range of the far end of the last sample
  std::uint64_t hash;          // XXH3 64 of the fields above but for the times, then of the used samples
  std::uint32_t epoch;
  std::uint32_t scan;                             // number of the scan, counts up
  std::uint32_t number;                           // of the sweep, counts up over all scans
  std::uint32_t samples;                          // used entries of video
  std::uint32_t flags;                            // kSweep...
  std::uint8_t mode, gain, direction, reserved0;  // direction 1: clockwise, 0: counter-clockwise
  std::uint64_t reserved[4];
  std::uint8_t video[radar::kMaxSamples];  // near to far; 0 black, 255 white; gain applied, brightness not
};
static_assert(offsetof(Sweep, video) == 144 && sizeof(Sweep) == 144 + radar::kMaxSamples);
static_assert(std::is_trivially_copyable_v<Sweep>);

// Bytes of a sweep that travel through the ring: the fields and the samples used.
inline std::size_t used_bytes(const Sweep& sweep) {
  return offsetof(Sweep, video) + std::min<std::size_t>(sweep.samples, radar::kMaxSamples);
}

inline constexpr std::uint32_t kModelFrozen = 1U;  // the scan has stopped at its end
inline constexpr std::uint32_t kModelScanning = 2U;
inline constexpr std::uint32_t kModelStale = 4U;  // no fresh ownship

// Published every tick. A restarted model resumes servo and scan number from it.
struct ModelStatus {
  std::int64_t tick;
  std::int64_t sim_time_ns;
  double antenna_azimuth_deg;        // [deg] against the nose, right positive
  double antenna_elevation_deg;      // [deg] against the horizon
  double height_above_ground_m;      // [m] below the aircraft; NaN = unknown
  double ground_elevation_m;         // [m] MSL below the aircraft; NaN = unknown
  double cursor_ground_elevation_m;  // [m] MSL below the cursor; NaN = unknown
  double map_timer_s;                // [s] NaN = none
  double map_progress;               // 0..1; NaN = none
  double load;                       // share of a core that the kernel took, smoothed
  std::uint64_t terrain_generation;
  std::uint64_t terrain_bytes;
  std::uint64_t sweeps;         // published since the session began
  std::uint64_t late_ticks;     // skipped
  std::uint64_t refused;        // inputs refused at the border
  std::uint64_t posts_pending;  // look-ups that met a post still loading
  std::uint32_t epoch;
  std::uint32_t scan;
  std::uint32_t sweep;
  std::uint32_t flags;         // kModel...
  std::uint32_t scan_restart;  // the last one obeyed
  std::uint32_t ownship_lane;
  std::int8_t scan_direction;  // +1 clockwise, -1 counter-clockwise
  std::uint8_t mode;
  std::uint8_t scan_bar;
  std::uint8_t mappable;  // 1: a patch could be commanded at the cursor
  char why_not[20];       // when not mappable: "BLIND ZONE", ...
  char fidelity[16];
  Ownship ownship;  // the one used, for those who draw and log
  Nav nav;          // goes with it
  // What a restarted model, or a replay from the middle of a scan, needs to go on with the very next sweep.
  double scan_centre_deg;        // [deg] true, at the end of the tick
  double scan_width_deg;         // [deg] of the scan under way
  double scan_range_m;           // [m] of the scan under way
  std::uint32_t scan_tick;       // within the scan
  std::uint8_t antenna_phase;    // antenna::Phase
  std::uint8_t scan_noise_only;  // 1: SNIFF holds for the scan under way
  std::uint8_t reserved0[2];
  std::int64_t ownship_received_ns;  // [ns] sim time at which the ownship used came; staleness is judged by it
  // The patch map under way: where it will lie; a window of 0 = none. Its time left is map_timer_s, its share
  // map_progress.
  double map_latitude_deg;         // [deg] centre
  double map_longitude_deg;        // [deg]
  double map_up_deg;               // [deg] true bearing that will point up
  double map_window_nm;            // [NM] edge
  std::uint64_t map_newest;        // id of the last map that was completed; 0 = none
  std::uint32_t map_request;       // the last request taken up
  std::uint32_t map_done_request;  // the request that the last map answers
  double scan_offset_deg;          // [deg] middle of the sector against the ground track
  double scan_rate_dps;            // [deg/s] of the scan under way; 0: the configuration's
  // PVU and IPVU: the aircraft's velocity over ground as the radar last measured it.
  double velocity_north_mps;
  double velocity_east_mps;
  double velocity_down_mps;
  std::int64_t velocity_due_tick;  // IPVU: when the next measurement falls due; -1 = none
  std::uint32_t velocity_count;    // measurements completed since the session began
  std::uint32_t velocity_dwell;    // ticks that the beam under way has stood
  std::uint8_t velocity_beam;      // 1, 2, ... under way; 0 = none
  std::uint8_t reserved_bytes[7];
  // The ground that RadarState asked for.
  double answered_latitude_deg;   // [deg] as asked
  double answered_longitude_deg;  // [deg]
  double answered_elevation_m;    // [m] MSL; NaN = unknown
  char map_stopped[16];           // why the patch is not mapped again: "BLIND ZONE", ...; empty = it is
  std::uint64_t reserved[3];
};
static_assert(sizeof(ModelStatus) % 8 == 0 && std::is_trivially_copyable_v<ModelStatus>);

}  // namespace yars::databuffer
