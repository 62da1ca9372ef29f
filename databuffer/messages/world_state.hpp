// World state as records: session clock, ownship, navigators, surface traffic.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace yars::databuffer {

// [ns] 18 years: the latest base of sim time and of CLOCK_MONOTONIC, for who sets the clock and for who reads it. Sums
// at the highest rate still fit.
inline constexpr std::int64_t kLatestClockBase_ns = std::int64_t{1} << 59;
// [s] of sim time that may be asked for.
inline constexpr double kLatestSimTime_s = static_cast<double>(kLatestClockBase_ns / 1'000'000'000);

// The session's clock: sim time [ns] = base + rate x (CLOCK_MONOTONIC - base), while it runs.
struct ClockState {
  std::int64_t base_sim_ns;        // [ns]
  std::int64_t base_monotonic_ns;  // [ns]
  double rate;                     // [0, 10]
  std::uint32_t running;           // 1 runs, 0 frozen
  std::uint32_t epoch;             // raised by each reset or repositioning
  double reposition_latitude_deg;  // [deg] of the last repositioning; NaN = none in this epoch
  double reposition_longitude_deg;
  double reposition_altitude_m;   // [m] MSL
  double reposition_heading_deg;  // [deg] true
  std::uint32_t followed;         // 1: the aircraft's source had jumped there by itself, and the epoch only tells of it
  std::uint32_t reserved0;
  std::uint64_t reserved[3];
};
static_assert(sizeof(ClockState) == 96 && std::is_trivially_copyable_v<ClockState>);

inline constexpr std::uint32_t kOwnshipOnGround = 1U;

// Where the aircraft is and how it moves: the truth (video is made from it), and in Nav what the navigators believe
// (symbols are placed by it). Written by a flight model into one of four lanes.
struct Ownship {
  std::int64_t source_time_ns;  // [ns] the source's own stamp: carried, not believed
  double latitude_deg;          // [deg] [-90, 90] WGS84
  double longitude_deg;         // [deg] [-180, 180] WGS84
  double altitude_msl_m;        // [m] [-1000, 200000] above mean sea level
  double heading_deg;           // [deg] [0, 360] true
  double pitch_deg;             // [deg] [-90, 90] nose up positive
  double roll_deg;              // [deg] [-180, 180] right wing down positive
  double velocity_north_mps;    // [m/s] [-10000, 10000] over ground
  double velocity_east_mps;     // [m/s] [-10000, 10000] over ground
  double velocity_down_mps;     // [m/s] [-10000, 10000] over ground
  double radar_altitude_m;      // [m] [0, 200000] above ground; NaN = no radar altimeter
  std::uint32_t epoch;          // session epoch that the writer knew; a new one makes a jump legal
  std::uint32_t flags;          // kOwnship...
  char source[16];              // "route", "fixed", "csv", "jsbsim": for people, printable ASCII
  double flight_time_s;         // [s] [0, 1e10] into the source's own recording, for its successor; 0 = not told
  std::uint64_t reserved[3];
};
static_assert(sizeof(Ownship) == 144 && std::is_trivially_copyable_v<Ownship>);
static_assert(offsetof(Ownship, latitude_deg) == 8 && offsetof(Ownship, epoch) == 88);

inline constexpr std::uint32_t kNavAttitudeInvalid = 1U;   // pitch ball crossed out
inline constexpr std::uint32_t kNavAttitudeFromAhrs = 2U;  // pitch ball square instead of round

struct Nav {
  std::int64_t source_time_ns;
  double mission_latitude_deg;  // [deg] mission navigator
  double mission_longitude_deg;
  double ins_latitude_deg;  // [deg] inertial navigation system
  double ins_longitude_deg;
  double velocity_north_mps;  // [m/s] the navigator's
  double velocity_east_mps;
  double velocity_down_mps;
  double magnetic_variation_deg;  // [deg] east positive; NaN = use the configuration's
  std::uint32_t epoch;
  std::uint32_t flags;  // kNav...
  std::uint64_t reserved[6];
};
static_assert(sizeof(Nav) == 128 && std::is_trivially_copyable_v<Nav>);

inline constexpr std::size_t kMaxTraffic = 64;

struct TrafficEntity {
  double latitude_deg;   // [deg] [-90, 90] WGS84
  double longitude_deg;  // [deg] [-180, 180] WGS84
  double velocity_north_mps;
  double velocity_east_mps;
  double height_m;          // [m] [0, 1000] of what returns, above the ground or water
  double cross_section_m2;  // [m²] [0, 1e7] of its radar echo
  std::uint32_t id;         // the source's own
  std::uint32_t reserved0;
};
static_assert(sizeof(TrafficEntity) == 56);

// Surface traffic from outside: ships and vehicles that an instructor's station or a bridge knows of. The radar shows
// them as moving targets. Between two records of the source an entity goes straight on at its velocity.
// All entities of this moment; one that is not named any more is gone. A source that has said nothing for
// kTrafficStaleAfter_ns has none.
struct Traffic {
  std::int64_t tick;            // at which the radar model took it over; 0 on the way in
  std::int64_t source_time_ns;  // [ns] the source's own stamp: carried, not believed
  std::uint32_t count;          // used entries
  std::uint32_t epoch;          // session epoch that the writer knew
  std::uint64_t reserved[5];
  TrafficEntity entities[kMaxTraffic];
};
static_assert(sizeof(Traffic) == 64 + 56 * kMaxTraffic && std::is_trivially_copyable_v<Traffic>);

inline constexpr std::int64_t kTrafficStaleAfter_ns = 12'000'000'000;  // [ns] DIS tells of what stands still every 5 s

}  // namespace yars::databuffer
