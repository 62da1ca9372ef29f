// Memory access with hooks, for a writer that dies and a reader that is interrupted.
// Writer: after a given number of stores, the next store throws, so that no later store reaches memory. Stores reach
// memory in program order, because all but the first store of a slot are releases. The memory is therefore the same as
// after kill -9. Reader: before a given load, other code runs.
#pragma once

#include <functional>
#include <limits>
#include <utility>

#include "shm/words.hpp"

namespace yars::shm::testing {

struct WriterKilled {};

struct HookedAccess {
  static constexpr bool kWide = false;  // no wide moves: each word is a hooked store or load
  static constexpr long kForever = std::numeric_limits<long>::max();
  inline static thread_local long stores_left = kForever;  // stores until the writer dies

  inline static thread_local std::function<void()> interruption;  // other code; its loads are not interrupted
  inline static thread_local long loads_before = 0;  // number of the load that is interrupted, from 1; 0: the next one
  inline static thread_local bool interrupt_always = false;

  static void count_store() {
    if (stores_left == 0) throw WriterKilled{};
    --stores_left;
  }
  static void interrupt_if_due() {
    if (interruption && (loads_before == 0 || --loads_before == 0)) {
      auto action = std::exchange(interruption, nullptr);
      action();
      if (interrupt_always) interruption = std::move(action);
    }
  }
  static void store(AtomicWord& word, Word value, std::memory_order order) {
    count_store();
    word.store(value, order);
  }
  static Word load(const AtomicWord& word, std::memory_order order) {
    interrupt_if_due();
    return word.load(order);
  }
  static Word fetch_add(AtomicWord& word, Word value, std::memory_order order) {
    count_store();
    return word.fetch_add(value, order);
  }
  // An interruption is also possible between the load of `seen` and the exchange.
  static bool compare_exchange(AtomicWord& word, Word& seen, Word value, std::memory_order order) {
    count_store();
    interrupt_if_due();
    return word.compare_exchange_strong(seen, value, order, std::memory_order_relaxed);
  }
};

// Runs `action`, which may make `stores` stores. True: it finished. False: it was killed at the next store.
template <class Action>
bool survives(long stores, Action action) {
  HookedAccess::stores_left = stores;
  bool alive = true;
  try {
    action();
  } catch (const WriterKilled&) {
    alive = false;
  }
  HookedAccess::stores_left = HookedAccess::kForever;
  return alive;
}

// Runs `read`, and `action` once before load number `load` (from 1) of `read`. False: `read` has fewer loads, and
// `action` has not run.
template <class Read>
bool interrupted_at(long load, std::function<void()> action, Read read) {
  HookedAccess::loads_before = load;
  HookedAccess::interruption = std::move(action);
  read();
  return !std::exchange(HookedAccess::interruption, nullptr);
}

// Runs `read`, and `action` before each of its loads.
template <class Read>
void interrupted_always(std::function<void()> action, Read read) {
  HookedAccess::interrupt_always = true;
  interrupted_at(0, std::move(action), read);
  HookedAccess::interrupt_always = false;
}

}  // namespace yars::shm::testing
