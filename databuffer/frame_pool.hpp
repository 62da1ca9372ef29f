// The frames of the glass in the segment (picture_pool.hpp): one radar-display writes (`--publish`), any read the
// newest.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "databuffer/picture_pool.hpp"
#include "databuffer/session_layout.hpp"

namespace yars::databuffer {

// Bytes of the picture; of sizes beyond the slot's as much as there is.
inline std::size_t frame_bytes(const GlassFrame& frame) {
  const std::size_t width = std::min(frame.width, kMostFramePixels);
  return 4 * width * std::min(frame.height, kMostFramePixels);
}

// Writes a frame in the place of the oldest one. `frame.id` is greater than all before; `pixels` has frame_bytes().
template <class Access = shm::PlainAccess>
void publish_frame(SessionLayout& layout, const GlassFrame& frame, std::span<const std::uint8_t> pixels) {
  FrameSlot* slot = slot_to_fill<Access>(layout.frames, frame.id, {});
  Access::store(slot->id, 0, std::memory_order_relaxed);
  shm::store_words<Access>(slot->frame.data(), &frame, shm::kWordsOf<GlassFrame>);
  store_pixels<Access>(*slot, pixels.first(std::min(pixels.size(), frame_bytes(frame))));
  Access::store(slot->id, frame.id, std::memory_order_release);
}

// The newest frame if it is another one than `after`; false: there is none, or its writer was faster than this reader 8
// times. Not "greater than": an id that cannot be would hold the reader for ever.
template <class Access = shm::PlainAccess>
bool read_newest_frame(const SessionLayout& layout, std::uint64_t after, GlassFrame& frame,
                       std::vector<std::uint8_t>& pixels) {
  constexpr int kTries = 8;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    const std::uint64_t id = greatest_id<Access>(layout.frames);
    if (id == 0 || id == after) return false;
    const FrameSlot* slot = slot_of<Access>(layout.frames, id);
    if (slot == nullptr) continue;
    shm::load_words<Access>(slot->frame.data(), &frame, shm::kWordsOf<GlassFrame>);
    load_pixels<Access>(*slot, frame_bytes(frame), pixels);
    if (still_holds<Access>(*slot, id) && frame.id == id) return true;
  }
  return false;
}

}  // namespace yars::databuffer
