// Lanes of the local segment that this gateway fills for other hosts, and the names of these lanes on their own hosts.
// Records name lanes by number. Numbers are translated where a record leaves or enters a host.
// Threads: one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "databuffer/session/session_layout.hpp"

namespace yars::gateway {

struct RemoteName {
  std::uint64_t host = 0;
  std::uint32_t lane = 0;
};

struct LaneNames {
  std::array<std::optional<RemoteName>, databuffer::kInputLanes> input;  // of the local input lanes
  std::optional<std::size_t> ownship_lane;  // local ownship lane with the ownship of another host
  RemoteName ownship;                       // whose it is

  // Name of a local ownship lane for other hosts; `self`: this host.
  RemoteName ownship_name(std::uint32_t lane, std::uint64_t self) const {
    return ownship_lane && lane == *ownship_lane ? ownship : RemoteName{self, lane};
  }
  // Local number of an ownship lane; `none` if this host has no such lane.
  std::uint32_t local_ownship_lane(RemoteName name, std::uint64_t self, std::uint32_t none) const {
    if (name.host == self) return name.lane;
    const bool is_ours = ownship_lane && ownship.host == name.host && ownship.lane == name.lane;
    return is_ours ? static_cast<std::uint32_t>(*ownship_lane) : none;
  }
  RemoteName input_name(std::uint32_t lane, std::uint64_t self) const {
    return lane < input.size() && input[lane] ? *input[lane] : RemoteName{self, lane};
  }
};

}  // namespace yars::gateway
