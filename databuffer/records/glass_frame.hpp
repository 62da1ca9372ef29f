// What a picture of the glass is: goes with the pixels of its slot. Rows from the top, without padding, 4 bytes a pixel
// in the order red, green, blue, 255.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace yars::databuffer {

inline constexpr std::uint32_t kMostFramePixels = 1024;  // on an edge
inline constexpr std::size_t kFrameSlots = 3;

struct GlassFrame {
  std::uint64_t id;          // counts up over the session; 0 = none
  std::int64_t tick;         // of the radar state that is on it
  std::int64_t sim_time_ns;  // [ns] when it was drawn
  std::uint32_t width;       // [pixels]
  std::uint32_t height;      // [pixels]
  std::uint64_t reserved[4];
};
static_assert(sizeof(GlassFrame) == 64 && std::is_trivially_copyable_v<GlassFrame>);

}  // namespace yars::databuffer
