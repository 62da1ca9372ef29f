// The pool of whole patch maps in the segment (picture_pool.hpp): radar-model writes, any read.
// What a slot holds is not judged here: ask why_refused(PatchMap) of validation.hpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "databuffer/picture_pool.hpp"
#include "databuffer/session_layout.hpp"

namespace yars::databuffer {

// Bytes of the picture; of a size beyond the slot's as much as there is.
inline std::size_t patch_pixels(const PatchMap& map) {
  const std::size_t edge = std::min(map.size, kMostPatchPixels);
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

}  // namespace yars::databuffer
