// Queues from several sources to one consumer: each source has a lane of its own (one producer, one consumer, order
// kept), so that no source can hold up or tear another's. A full lane drops the newest and counts it. Both cursors
// lie in the segment: a restarted consumer goes on where the dead one stopped, and a producer killed anywhere leaves
// whole records only. A lane whose producer is gone may be taken over once it is empty. Zero-filled memory is the
// empty state. `lane` in [0, Lanes).
#pragma once

#include <array>

#include "shm/words.hpp"

namespace yars::shm {

template <Record T, std::size_t Lanes, std::size_t Depth, class Access = PlainAccess>
class InputLanes {
  static_assert(Depth >= 2 && (Depth & (Depth - 1)) == 0, "a power of two: the slot is found by a mask");

 public:
  // The lane's producer. False: the lane was full, the record is dropped and counted.
  bool push(std::size_t lane, const T& record);
  // The consumer. False: nothing there. What it has peeked at is still there to be popped.
  bool peek(std::size_t lane, T& out);
  bool pop(std::size_t lane, T& out);

  bool empty(std::size_t lane) const { return pushed(lane) == popped(lane); }
  std::uint64_t pushed(std::size_t lane) const { return Access::load(lanes_[lane].pushed, std::memory_order_acquire); }
  std::uint64_t popped(std::size_t lane) const { return Access::load(lanes_[lane].popped, std::memory_order_acquire); }
  std::uint64_t dropped(std::size_t lane) const {
    return Access::load(lanes_[lane].dropped, std::memory_order_relaxed);
  }

  // Who feeds the lane, for people: 23 characters are kept.
  void set_source(std::size_t lane, std::string_view source) {
    store_text<Access>(lanes_[lane].source.data(), kSourceWords, source);
  }
  std::string source(std::size_t lane) const { return load_text(lanes_[lane].source.data(), kSourceWords); }

  static constexpr std::size_t kLanes = Lanes;
  static constexpr std::size_t kDepth = Depth;
  static constexpr std::size_t lane_stride() { return sizeof(Lane); }
  static constexpr std::size_t pushed_offset() { return offsetof(Lane, pushed); }
  static constexpr std::size_t dropped_offset() { return offsetof(Lane, dropped); }
  static constexpr std::size_t source_offset() { return offsetof(Lane, source); }
  static constexpr std::size_t popped_offset() { return offsetof(Lane, popped); }
  static constexpr std::size_t records_offset() { return offsetof(Lane, records); }

 private:
  static constexpr std::size_t kSourceWords = 3;
  using StoredRecord = std::array<AtomicWord, kWordsOf<T>>;

  struct Lane {
    alignas(kCacheLine) AtomicWord pushed;  // the producer's line
    AtomicWord dropped;
    AtomicWord popped_seen;  // popped as the producer last looked: it looks again only when the lane seems full
    std::array<AtomicWord, kSourceWords> source;
    alignas(kCacheLine) AtomicWord popped;  // the consumer's line
    AtomicWord pushed_seen;                 // pushed as the consumer last looked
    alignas(kCacheLine) std::array<StoredRecord, Depth> records;
  };

  std::array<Lane, Lanes> lanes_;
};

template <Record T, std::size_t Lanes, std::size_t Depth, class Access>
bool InputLanes<T, Lanes, Depth, Access>::push(std::size_t lane, const T& record) {
  Lane& into = lanes_[lane];
  const Word number = Access::load(into.pushed, std::memory_order_relaxed);
  if (number - Access::load(into.popped_seen, std::memory_order_relaxed) >= Depth) {
    const Word popped = Access::load(into.popped, std::memory_order_acquire);
    Access::store(into.popped_seen, popped, std::memory_order_relaxed);
    if (number - popped >= Depth) {
      Access::store(into.dropped, Access::load(into.dropped, std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return false;
    }
  }
  store_words<Access>(into.records[number % Depth].data(), &record, kWordsOf<T>);
  Access::store(into.pushed, number + 1, std::memory_order_release);
  return true;
}

template <Record T, std::size_t Lanes, std::size_t Depth, class Access>
bool InputLanes<T, Lanes, Depth, Access>::peek(std::size_t lane, T& out) {
  Lane& from = lanes_[lane];
  const Word number = Access::load(from.popped, std::memory_order_relaxed);
  Word pushed = Access::load(from.pushed_seen, std::memory_order_relaxed);
  if (number == pushed) {
    pushed = Access::load(from.pushed, std::memory_order_acquire);
    Access::store(from.pushed_seen, pushed, std::memory_order_relaxed);
    if (number == pushed) return false;
  }
  // No producer gets further ahead than the lane is deep: the cursors are damaged, and what lies there is in no order.
  if (pushed - number > Depth) {
    pushed = Access::load(from.pushed, std::memory_order_acquire);
    Access::store(from.pushed_seen, pushed, std::memory_order_relaxed);
    if (pushed - number > Depth) Access::store(from.popped, pushed, std::memory_order_release);
    if (pushed - number > Depth || pushed == number) return false;
  }
  load_words<Access>(from.records[number % Depth].data(), &out, kWordsOf<T>);
  return true;
}

template <Record T, std::size_t Lanes, std::size_t Depth, class Access>
bool InputLanes<T, Lanes, Depth, Access>::pop(std::size_t lane, T& out) {
  if (!peek(lane, out)) return false;
  Lane& from = lanes_[lane];
  Access::store(from.popped, Access::load(from.popped, std::memory_order_relaxed) + 1, std::memory_order_release);
  return true;
}

}  // namespace yars::shm
