// Which of the ownship lanes the radar believes: the highest fresh priority, with hysteresis. Pure; called once a tick.
// A lane is fresh while its version has changed within kStaleAfter by the caller's clock (stamps from outside are not
// believed). A version met for the first time is no news: it may be what a dead writer left.
// A higher lane takes over after delivering without a gap for kTakeoverAfter; the chosen lane is left only when it is
// stale or such a lane is there. Equal priorities: the chosen one stays; none chosen: the lower index.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace yars::databuffer {

inline constexpr std::size_t kMaxOwnshipLanes = 4;
// [ns] 25 records of a 50 Hz source; shorter and a loaded machine loses its source, longer and a dead one flies on.
inline constexpr std::int64_t kStaleAfter = 500'000'000;
// [ns] a lane must have delivered this long before it displaces a good one; a source that flaps faster never does.
inline constexpr std::int64_t kTakeoverAfter = 250'000'000;

struct OwnshipLane {
  bool present = false;        // a value has ever been published and the lane has a priority
  std::uint32_t priority = 0;  // higher wins
  std::uint64_t version = 0;   // of the LatestValue: changes with each record
};

// The choice and what the next call needs to know; begin with a default one.
struct OwnshipSelection {
  struct Memory {
    bool seen = false;
    std::uint64_t version = 0;
    std::optional<std::int64_t> received_ns;  // the newest version's arrival
    std::int64_t delivering_since_ns = 0;     // first arrival after the last gap
  };
  std::optional<std::size_t> lane;
  std::array<Memory, kMaxOwnshipLanes> memory;
};

// `lanes` has at most kMaxOwnshipLanes entries, always in the same order. `now_ns` is CLOCK_MONOTONIC, or sim time in
// lockstep; when it goes back, each lane counts as received at that moment.
OwnshipSelection select_ownship(std::span<const OwnshipLane> lanes, std::int64_t now_ns,
                                const OwnshipSelection& previous);

}  // namespace yars::databuffer
