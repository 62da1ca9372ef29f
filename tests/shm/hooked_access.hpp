// A writer that dies after a given number of stores: the next store throws, so no later store reaches memory. Stores
// reach memory in program order (all stores of the containers but the first of a slot are releases), so this leaves the
// same memory as a kill -9. Also a reader that is interrupted before a given load, at which other code runs.
#pragma once

#include <functional>
#include <limits>
#include <utility>

#include "shm/words.hpp"

namespace yars::shm::testing {

struct WriterKilled {};

struct HookedAccess {
  static constexpr bool kWide = false;  // word by word, so that none is left out
  static constexpr long kForever = std::numeric_limits<long>::max();
  inline static thread_local long left = kForever;

  inline static thread_local std::function<void()> interruption;  // what others do meanwhile; its own loads run through
  inline static thread_local long loads_before = 0;
  inline static thread_local bool interrupt_always = false;

  static void spend() {
    if (left == 0) throw WriterKilled{};
    --left;
  }
  static void let_others_in() {
    if (interruption && (loads_before == 0 || --loads_before == 0)) {
      auto action = std::exchange(interruption, nullptr);
      action();
      if (interrupt_always) interruption = std::move(action);
    }
  }
  static void store(AtomicWord& word, Word value, std::memory_order order) {
    spend();
    word.store(value, order);
  }
  static Word load(const AtomicWord& word, std::memory_order order) {
    let_others_in();
    return word.load(order);
  }
  static Word fetch_add(AtomicWord& word, Word value, std::memory_order order) {
    spend();
    return word.fetch_add(value, order);
  }
  // Also a moment at which others may come in: between what was seen and the exchange.
  static bool compare_exchange(AtomicWord& word, Word& seen, Word value, std::memory_order order) {
    spend();
    let_others_in();
    return word.compare_exchange_strong(seen, value, order, std::memory_order_relaxed);
  }
};

// True: the action came to its end; false: its writer died after `stores` stores.
template <class Action>
bool survives(long stores, Action action) {
  HookedAccess::left = stores;
  bool alive = true;
  try {
    action();
  } catch (const WriterKilled&) {
    alive = false;
  }
  HookedAccess::left = HookedAccess::kForever;
  return alive;
}

// Runs `read` while `action` happens once, before its load number `load` (from 1). False: it has fewer loads.
template <class Read>
bool interrupted_at(long load, std::function<void()> action, Read read) {
  HookedAccess::loads_before = load;
  HookedAccess::interruption = std::move(action);
  read();
  return !std::exchange(HookedAccess::interruption, nullptr);
}

// Runs `read` while `action` happens before each of its loads.
template <class Read>
void interrupted_always(std::function<void()> action, Read read) {
  HookedAccess::interrupt_always = true;
  interrupted_at(0, std::move(action), read);
  HookedAccess::interrupt_always = false;
}

}  // namespace yars::shm::testing
