// The session's clock: sim time [ns] = base + rate x (CLOCK_MONOTONIC - base), while it runs.
#pragma once

#include <cstdint>
#include <type_traits>

namespace yars::databuffer {

// [ns] 18 years: the latest base of sim time and of CLOCK_MONOTONIC, for who sets the clock and for who reads it. Sums
// at the highest rate still fit.
inline constexpr std::int64_t kLatestClockBase_ns = std::int64_t{1} << 59;
// [s] of sim time that may be asked for.
inline constexpr double kLatestSimTime_s = static_cast<double>(kLatestClockBase_ns / 1'000'000'000);

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

}  // namespace yars::databuffer
