// Pools of pictures in the segment, addressed by id: patch maps, and frames of the display.
// Inputs: a PatchMap or GlassFrame with its pixels.
// Outputs: a whole picture by id, or the newest frame.
// Errors: reading gives false if no slot has the id, or if the writer replaced the picture during the copy. Writing a
//   map gives false if no slot may be overwritten. Records are not validated here.
// Threads: one writer and any number of readers; none waits. If the writer is killed, readers find no partial picture.
// Source: docs/shared_memory.md.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "databuffer/messages/pictures.hpp"
#include "databuffer/session/session_layout.hpp"
#include "shm/words.hpp"

namespace yars::databuffer {

// The writer clears a slot's id, writes the picture, and stores the new id last. A reader copies between two loads of
// the id. Ids count up and are never reused. A slot with an id greater than the id to be written is damaged. The
// writer fills such a slot first. Ids above kLatestPictureId (2^53) are invalid.

// Greatest valid id in the pool; 0: no slot has a valid id. A restarted writer continues with greater ids.
template <class Access, class Slots>
std::uint64_t greatest_id(const Slots& slots) {
  std::uint64_t greatest = 0;
  for (const auto& slot : slots)
    if (const std::uint64_t id = Access::load(slot.id, std::memory_order_acquire); id <= kLatestPictureId)
      greatest = std::max(greatest, id);
  return greatest;
}

// Slot with this id; nullptr if there is none.
template <class Access, class Slots>
auto slot_of(Slots& slots, std::uint64_t id) -> decltype(&slots[0]) {
  const auto slot = std::find_if(slots.begin(), slots.end(), [id](const auto& candidate) {
    return Access::load(candidate.id, std::memory_order_acquire) == id;
  });
  return id == 0 || slot == slots.end() ? nullptr : &*slot;
}

// True if the slot still has the id; all words copied before this call then belong to the picture. Words are loaded
// with acquire: a reader that has loaded a word of a newer picture also sees that the id was cleared.
template <class Access, class Slot>
bool still_holds(const Slot& slot, std::uint64_t id) {
  return Access::load(slot.id, std::memory_order_relaxed) == id;
}

// Slot for the picture with the id `next`: an empty or damaged slot, else the slot of the oldest picture. Slots with an
// id in `keep` are left out. nullptr: the ids of all slots are in `keep`.
template <class Access, class Slots>
auto slot_to_fill(Slots& slots, std::uint64_t next, std::span<const std::uint64_t> keep) -> decltype(&slots[0]) {
  decltype(&slots[0]) chosen = nullptr;
  std::uint64_t lowest = 0;
  for (auto& slot : slots) {
    const std::uint64_t id = Access::load(slot.id, std::memory_order_relaxed);
    if (id != 0 && std::find(keep.begin(), keep.end(), id) != keep.end()) continue;
    const std::uint64_t order = id > next ? 0 : id;
    if (chosen != nullptr && order >= lowest) continue;
    chosen = &slot;
    lowest = order;
  }
  return chosen;
}

template <class Access, class Slot>
void store_pixels(Slot& slot, std::span<const std::uint8_t> pixels) {
  const std::size_t words = pixels.size() / sizeof(shm::Word);
  shm::store_words<Access>(slot.pixels.data(), pixels.data(), words);
  if (const std::size_t rest = pixels.size() % sizeof(shm::Word); rest != 0) {
    shm::Word last = 0;
    std::memcpy(&last, pixels.data() + words * sizeof(shm::Word), rest);
    shm::store_words<Access>(&slot.pixels[words], &last, 1);
  }
}

// `bytes`: at most the capacity of the slot.
template <class Access, class Slot>
void load_pixels(const Slot& slot, std::size_t bytes, std::vector<std::uint8_t>& pixels) {
  const std::size_t words = (bytes + sizeof(shm::Word) - 1) / sizeof(shm::Word);
  pixels.resize(words * sizeof(shm::Word));
  shm::load_words<Access>(slot.pixels.data(), pixels.data(), words);
  pixels.resize(bytes);
}

// Pool of patch maps, written by radar-model. Readers validate the record with validate(PatchMap).

// Size of the picture [bytes], limited to the capacity of a slot.
inline std::size_t patch_bytes(const PatchMap& map) {
  const std::size_t edge = std::min(map.size, kMaxPatchPixels);
  return edge * edge;
}

// Writes a map and at most patch_bytes(map) bytes of pixels to the slot that slot_to_fill() chooses. `keep` holds the
// ids that the radar state names or may name next, and the id of the writer's last map. False: the ids of all slots are
// in `keep`.
template <class Access = shm::PlainAccess>
bool publish_patch(SessionLayout& layout, const PatchMap& map, std::span<const std::uint8_t> pixels,
                   std::span<const std::uint64_t> keep) {
  PatchSlot* slot = slot_to_fill<Access>(layout.patches, map.id, keep);
  if (slot == nullptr) return false;
  constexpr std::uint32_t kWhole_permille = 1000;
  Access::store(slot->id, 0, std::memory_order_relaxed);
  slot->epoch.store(map.epoch, std::memory_order_release);
  slot->progress_permille.store(kWhole_permille, std::memory_order_release);
  shm::store_words<Access>(slot->map.data(), &map, shm::kWordsOf<PatchMap>);
  store_pixels<Access>(*slot, pixels.first(std::min(pixels.size(), patch_bytes(map))));
  Access::store(slot->id, map.id, std::memory_order_release);
  return true;
}

// Reads the record of the map with this id. False: no slot has the id, or the writer replaced the map during the copy.
// `map` is then unspecified.
template <class Access = shm::PlainAccess>
bool read_patch(const SessionLayout& layout, std::uint64_t id, PatchMap& map) {
  const PatchSlot* slot = slot_of<Access>(layout.patches, id);
  if (slot == nullptr) return false;
  shm::load_words<Access>(slot->map.data(), &map, shm::kWordsOf<PatchMap>);
  return still_holds<Access>(*slot, id) && map.id == id;
}

// As above, and reads the picture: rows without padding, patch_bytes(map) bytes.
template <class Access = shm::PlainAccess>
bool read_patch(const SessionLayout& layout, std::uint64_t id, PatchMap& map, std::vector<std::uint8_t>& pixels) {
  const PatchSlot* slot = slot_of<Access>(layout.patches, id);
  if (slot == nullptr) return false;
  shm::load_words<Access>(slot->map.data(), &map, shm::kWordsOf<PatchMap>);
  load_pixels<Access>(*slot, patch_bytes(map), pixels);
  return still_holds<Access>(*slot, id) && map.id == id;
}

// Pool of frames, written by one radar-display with `--publish`.

// Size of the picture [bytes], limited to the capacity of a slot.
inline std::size_t frame_bytes(const GlassFrame& frame) {
  const std::size_t width = std::min(frame.width, kMaxFramePixels);
  return 4 * width * std::min(frame.height, kMaxFramePixels);
}

// Writes a frame to an empty or damaged slot, else over the oldest frame. `frame.id` must be greater than all earlier
// ids. `pixels` has frame_bytes(frame) bytes; further bytes are left out.
template <class Access = shm::PlainAccess>
void publish_frame(SessionLayout& layout, const GlassFrame& frame, std::span<const std::uint8_t> pixels) {
  FrameSlot* slot = slot_to_fill<Access>(layout.frames, frame.id, {});
  Access::store(slot->id, 0, std::memory_order_relaxed);
  shm::store_words<Access>(slot->frame.data(), &frame, shm::kWordsOf<GlassFrame>);
  store_pixels<Access>(*slot, pixels.first(std::min(pixels.size(), frame_bytes(frame))));
  Access::store(slot->id, frame.id, std::memory_order_release);
}

// Reads the newest frame if its id differs from `after`, the id of the last frame that was read. False: there is no
// such frame, or the writer replaced it during each of 8 attempts. A smaller id than `after` is also new, because
// `after` may come from a damaged slot and exceed all ids of the writer.
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
