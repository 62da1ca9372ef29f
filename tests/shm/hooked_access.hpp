// A writer that dies after a given number of stores: the next one throws, so that nothing later reaches the memory.
// Stores reach memory in program order (every store of the containers but the first of a slot is a release), hence
// this leaves what a kill -9 at that place leaves.
#pragma once

#include <limits>

#include "shm/words.hpp"

namespace yars::shm::testing {

struct WriterKilled {};

struct CountedStores {
  static constexpr long kForever = std::numeric_limits<long>::max();
  inline static thread_local long left = kForever;

  static void spend() {
    if (left == 0) throw WriterKilled{};
    --left;
  }
  static void store(AtomicWord& word, Word value, std::memory_order order) {
    spend();
    word.store(value, order);
  }
  static Word fetch_add(AtomicWord& word, Word value, std::memory_order order) {
    spend();
    return word.fetch_add(value, order);
  }
};

// True: the action came to its end; false: its writer died after `stores` stores.
template <class Action>
bool survives(long stores, Action action) {
  CountedStores::left = stores;
  bool alive = true;
  try {
    action();
  } catch (const WriterKilled&) {
    alive = false;
  }
  CountedStores::left = CountedStores::kForever;
  return alive;
}

}  // namespace yars::shm::testing
