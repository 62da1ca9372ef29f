// What the recorder says of itself: PB 12 is boxed while it writes.
#pragma once

#include <cstdint>
#include <type_traits>

namespace yars::databuffer {

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
