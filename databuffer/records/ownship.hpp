// Where the aircraft is and how it moves: the truth (video is made from it) and what the navigators believe
// (symbols are placed by it). Written by a flight model into one of four lanes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace yars::databuffer {

inline constexpr std::uint32_t kOwnshipOnGround = 1U;

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

}  // namespace yars::databuffer
