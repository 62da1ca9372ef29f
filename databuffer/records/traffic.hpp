// Surface traffic from outside: ships and vehicles that an instructor's station or a bridge knows of. The radar shows
// them as moving targets. Between two records of the source an entity goes straight on at its velocity.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace yars::databuffer {

inline constexpr std::size_t kMostTraffic = 64;

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

// All entities of this moment; one that is not named any more is gone. A source that has said nothing for
// kTrafficStaleAfter has none.
struct Traffic {
  std::int64_t tick;            // at which the radar model took it over; 0 on the way in
  std::int64_t source_time_ns;  // [ns] the source's own stamp: carried, not believed
  std::uint32_t count;          // used entries
  std::uint32_t epoch;          // session epoch that the writer knew
  std::uint64_t reserved[5];
  TrafficEntity entities[kMostTraffic];
};
static_assert(sizeof(Traffic) == 64 + 56 * kMostTraffic && std::is_trivially_copyable_v<Traffic>);

inline constexpr std::int64_t kTrafficStaleAfter = 12'000'000'000;  // [ns] DIS tells of what stands still every 5 s

}  // namespace yars::databuffer
