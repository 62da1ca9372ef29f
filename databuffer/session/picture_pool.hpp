// Pools of pictures in the segment: found by id, patch maps, frames of the display.
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

// A pool of pictures in the segment, found by id: patch maps, frames of the glass. One writer, any readers. The writer
// takes a slot's id away, writes, and puts the new id in last; so a writer killed anywhere leaves a slot that is empty,
// never half a picture. A reader copies between two reads of the id. Ids count up and are never used twice. An id above
// the writer's own is nobody's: a reader passes over one beyond kLatestPictureId, and the writer fills that slot first.

// The greatest id in the pool, 0 = empty: a restarted writer goes on above it.
template <class Access, class Slots>
std::uint64_t greatest_id(const Slots& slots) {
  std::uint64_t greatest = 0;
  for (const auto& slot : slots)
    if (const std::uint64_t id = Access::load(slot.id, std::memory_order_acquire); id <= kLatestPictureId)
      greatest = std::max(greatest, id);
  return greatest;
}

// nullptr: no slot has it.
template <class Access, class Slots>
auto slot_of(Slots& slots, std::uint64_t id) -> decltype(&slots[0]) {
  const auto slot = std::find_if(slots.begin(), slots.end(), [id](const auto& candidate) {
    return Access::load(candidate.id, std::memory_order_acquire) == id;
  });
  return id == 0 || slot == slots.end() ? nullptr : &*slot;
}

// The writer may have taken the slot meanwhile; words are loaded with acquire, so whoever saw a new one sees that too.
template <class Access, class Slot>
bool still_holds(const Slot& slot, std::uint64_t id) {
  return Access::load(slot.id, std::memory_order_relaxed) == id;
}

// For the picture `next`. Empty ones first, and those with an id that cannot be, then the oldest; nullptr when all are
// kept.
template <class Access, class Slots>
auto slot_to_fill(Slots& slots, std::uint64_t next, std::span<const std::uint64_t> keep) -> decltype(&slots[0]) {
  decltype(&slots[0]) chosen = nullptr;
  std::uint64_t least = 0;
  for (auto& slot : slots) {
    const std::uint64_t id = Access::load(slot.id, std::memory_order_relaxed);
    if (id != 0 && std::find(keep.begin(), keep.end(), id) != keep.end()) continue;
    const std::uint64_t age = id > next ? 0 : id;
    if (chosen != nullptr && age >= least) continue;
    chosen = &slot;
    least = age;
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

// `bytes` no more than the slot has.
template <class Access, class Slot>
void load_pixels(const Slot& slot, std::size_t bytes, std::vector<std::uint8_t>& pixels) {
  const std::size_t words = (bytes + sizeof(shm::Word) - 1) / sizeof(shm::Word);
  pixels.resize(words * sizeof(shm::Word));
  shm::load_words<Access>(slot.pixels.data(), pixels.data(), words);
  pixels.resize(bytes);
}

// The pool of whole patch maps: radar-model writes, any read. What a slot holds is not judged here: ask
// validate(PatchMap).

// Bytes of the picture; of a size beyond the slot's as much as there is.
inline std::size_t patch_pixels(const PatchMap& map) {
  const std::size_t edge = std::min(map.size, kMaxPatchPixels);
  return edge * edge;
}

template <class Access = shm::PlainAccess>
std::uint64_t greatest_patch_id(const SessionLayout& layout) {
  return greatest_id<Access>(layout.patches);
}

// Writes a map with its id and size() pixels, in the place of the oldest map that `keep` does not name: keep what the
// radar state names and what it may be about to name, the writer's own last map. False: all slots are kept.
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
  store_pixels<Access>(*slot, pixels.first(std::min(pixels.size(), patch_pixels(map))));
  Access::store(slot->id, map.id, std::memory_order_release);
  return true;
}

// What the map with this id is; false, and `map` may hold anything, when no slot has it.
template <class Access = shm::PlainAccess>
bool read_patch(const SessionLayout& layout, std::uint64_t id, PatchMap& map) {
  const PatchSlot* slot = slot_of<Access>(layout.patches, id);
  if (slot == nullptr) return false;
  shm::load_words<Access>(slot->map.data(), &map, shm::kWordsOf<PatchMap>);
  return still_holds<Access>(*slot, id) && map.id == id;
}

// The same with its picture: rows without padding, patch_pixels(map) bytes.
template <class Access = shm::PlainAccess>
bool read_patch(const SessionLayout& layout, std::uint64_t id, PatchMap& map, std::vector<std::uint8_t>& pixels) {
  const PatchSlot* slot = slot_of<Access>(layout.patches, id);
  if (slot == nullptr) return false;
  shm::load_words<Access>(slot->map.data(), &map, shm::kWordsOf<PatchMap>);
  load_pixels<Access>(*slot, patch_pixels(map), pixels);
  return still_holds<Access>(*slot, id) && map.id == id;
}

// The frames of the glass: one radar-display writes (`--publish`), any read the newest.

// Bytes of the picture; of sizes beyond the slot's as much as there is.
inline std::size_t frame_bytes(const GlassFrame& frame) {
  const std::size_t width = std::min(frame.width, kMaxFramePixels);
  return 4 * width * std::min(frame.height, kMaxFramePixels);
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
