// What a consumer latches once a tick: the ownship and nav of the lane that select_ownship picks. Records that do
// not validate are refused and counted; the last good value of their lane stands. So does it when the place jumps
// within an epoch (jump_guard.hpp), but in lockstep, where nobody can set the clock.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "databuffer/jump_guard.hpp"
#include "databuffer/records/select_ownship.hpp"
#include "databuffer/session_layout.hpp"

namespace yars::databuffer {

inline constexpr std::uint32_t kNoLane = 0xffffffffU;

// What messages call the source of a lane: by the name that it gives itself, or by its place when it gives none.
std::string name_of_source(const Ownship& ownship, std::uint32_t lane);

class OwnshipReceiver {
 public:
  struct Selected {
    bool valid = false;  // a fresh lane was found
    std::uint32_t lane = kNoLane;
    Ownship ownship{};  // of the lane; the last one used when none is fresh
    Nav nav{};
    std::int64_t received_ns = 0;  // [ns] sim time of the tick that met it first
    // Where the source says that the aircraft is now, far from where it was: it takes a new epoch.
    std::optional<Ownship> jump;
    std::uint32_t jump_lane = kNoLane;  // of that source
  };
  // `sim_time_ns` is the time of the tick: receipt is judged by it, so that lockstep and live agree.
  const Selected& refresh(const SessionLayout& layout, std::int64_t sim_time_ns, std::uint32_t epoch);

  std::uint64_t refused() const { return refused_ + guard_.passed(); }
  // Why, a sentence for each record that the last refresh() refused.
  const std::vector<std::string>& refusals() const { return refusals_; }

 private:
  void receive(const SessionLayout& layout, std::size_t lane);

  struct Lane {
    std::uint64_t version = 0;  // newest one looked at
    std::uint64_t nav_version = 0;
    std::uint64_t accepted = 0;  // counts good ownships: what select_ownship sees as the version
    Ownship ownship{};
    Nav nav{};
    bool has_nav = false;
  };
  std::array<Lane, kOwnshipLanes> lanes_;
  OwnshipSelection selection_;
  JumpGuard guard_;
  Selected selected_;
  std::uint64_t refused_ = 0;
  std::vector<std::string> refusals_;
};

}  // namespace yars::databuffer
