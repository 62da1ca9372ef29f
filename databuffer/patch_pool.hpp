// The pool of whole patch maps in the segment: one writer, any readers, found by id. The writer takes a slot's id away,
// writes, and puts the new id in last; so a writer killed anywhere leaves a slot that is empty, never half a map.
// A reader copies between two reads of the id. Ids count up and are never used twice.
// What a slot holds is not judged here: ask why_refused(PatchMap) of validation.hpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "databuffer/session_layout.hpp"
#include "shm/words.hpp"

namespace yars::databuffer {

// Bytes of the picture; of a size beyond the slot's as much as there is.
inline std::size_t patch_pixels(const PatchMap& map) {
  const std::size_t edge = std::min(map.size, kMostPatchPixels);
  return edge * edge;
}

// The greatest id in the pool, 0 = empty: a restarted writer goes on above it.
template <class Access = shm::PlainAccess>
std::uint64_t greatest_patch_id(const SessionLayout& layout) {
  std::uint64_t greatest = 0;
  for (const PatchSlot& slot : layout.patches)
    greatest = std::max(greatest, Access::load(slot.id, std::memory_order_acquire));
  return greatest;
}

namespace patch_pool_detail {

template <class Access>
const PatchSlot* slot_of(const SessionLayout& layout, std::uint64_t id) {
  const auto* slot = std::find_if(layout.patches.begin(), layout.patches.end(), [id](const PatchSlot& candidate) {
    return Access::load(candidate.id, std::memory_order_acquire) == id;
  });
  return id == 0 || slot == layout.patches.end() ? nullptr : slot;
}

// The writer may have taken the slot meanwhile; words are loaded with acquire, so whoever saw a new one sees that too.
template <class Access>
bool still_holds(const PatchSlot& slot, std::uint64_t id) {
  return Access::load(slot.id, std::memory_order_relaxed) == id;
}

// Empty ones first, then the oldest; nullptr when all are kept.
template <class Access>
PatchSlot* slot_to_fill(SessionLayout& layout, std::span<const std::uint64_t> keep) {
  PatchSlot* chosen = nullptr;
  std::uint64_t least = 0;
  for (PatchSlot& slot : layout.patches) {
    const std::uint64_t id = Access::load(slot.id, std::memory_order_relaxed);
    if (id != 0 && std::find(keep.begin(), keep.end(), id) != keep.end()) continue;
    if (chosen != nullptr && id >= least) continue;
    chosen = &slot;
    least = id;
  }
  return chosen;
}

template <class Access>
void store_pixels(PatchSlot& slot, const std::uint8_t* pixels, std::size_t bytes) {
  const std::size_t words = bytes / sizeof(shm::Word);
  shm::store_words<Access>(slot.pixels.data(), pixels, words);
  if (const std::size_t rest = bytes % sizeof(shm::Word); rest != 0) {
    shm::Word last = 0;
    std::memcpy(&last, pixels + words * sizeof(shm::Word), rest);
    shm::store_words<Access>(&slot.pixels[words], &last, 1);
  }
}

}  // namespace patch_pool_detail

// Writes a map with its id and size() pixels, in the place of the oldest map that `keep` does not name: keep what the
// radar state names and what it may be about to name, the writer's own last map. False: all slots are kept.
template <class Access = shm::PlainAccess>
bool publish_patch(SessionLayout& layout, const PatchMap& map, std::span<const std::uint8_t> pixels,
                   std::span<const std::uint64_t> keep) {
  PatchSlot* slot = patch_pool_detail::slot_to_fill<Access>(layout, keep);
  if (slot == nullptr) return false;
  constexpr std::uint32_t kWhole_permille = 1000;
  Access::store(slot->id, 0, std::memory_order_relaxed);
  slot->epoch.store(map.epoch, std::memory_order_release);
  slot->progress_permille.store(kWhole_permille, std::memory_order_release);
  shm::store_words<Access>(slot->map.data(), &map, shm::kWordsOf<PatchMap>);
  patch_pool_detail::store_pixels<Access>(*slot, pixels.data(), std::min(pixels.size(), patch_pixels(map)));
  Access::store(slot->id, map.id, std::memory_order_release);
  return true;
}

// What the map with this id is; false, and `map` may hold anything, when no slot has it.
template <class Access = shm::PlainAccess>
bool read_patch(const SessionLayout& layout, std::uint64_t id, PatchMap& map) {
  const PatchSlot* slot = patch_pool_detail::slot_of<Access>(layout, id);
  if (slot == nullptr) return false;
  shm::load_words<Access>(slot->map.data(), &map, shm::kWordsOf<PatchMap>);
  return patch_pool_detail::still_holds<Access>(*slot, id) && map.id == id;
}

// The same with its picture: rows without padding, patch_pixels(map) bytes.
template <class Access = shm::PlainAccess>
bool read_patch(const SessionLayout& layout, std::uint64_t id, PatchMap& map, std::vector<std::uint8_t>& pixels) {
  const PatchSlot* slot = patch_pool_detail::slot_of<Access>(layout, id);
  if (slot == nullptr) return false;
  shm::load_words<Access>(slot->map.data(), &map, shm::kWordsOf<PatchMap>);
  const std::size_t bytes = patch_pixels(map);
  const std::size_t words = (bytes + sizeof(shm::Word) - 1) / sizeof(shm::Word);
  pixels.resize(words * sizeof(shm::Word));
  shm::load_words<Access>(slot->pixels.data(), pixels.data(), words);
  pixels.resize(bytes);
  return patch_pool_detail::still_holds<Access>(*slot, id) && map.id == id;
}

}  // namespace yars::databuffer
