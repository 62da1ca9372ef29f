// A pool of pictures in the segment, found by id: patch maps, frames of the glass. One writer, any readers. The writer
// takes a slot's id away, writes, and puts the new id in last; so a writer killed anywhere leaves a slot that is empty,
// never half a picture. A reader copies between two reads of the id. Ids count up and are never used twice. An id above
// the writer's own is nobody's: a reader passes over one beyond kLatestPictureId, and the writer fills that slot first.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "databuffer/records/picture_id.hpp"
#include "shm/words.hpp"

namespace yars::databuffer {

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

}  // namespace yars::databuffer
