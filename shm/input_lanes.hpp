// Input lanes: single-producer, single-consumer ring buffers in shared memory. Each event source has a lane. No call
// waits for another process (wait-free).
// Inputs: records pushed by the producer of a lane; `lane` in [0, Lanes).
// Outputs: the records of each lane in FIFO order. Records of different lanes have no common order.
// Errors: push() to a full lane drops the record and counts the drop.
// Threads: one producer per lane, one consumer for all lanes. Zero-filled memory is the valid empty state.
// Restart: the cursors `pushed` and `popped` lie in the segment. A new consumer continues where the old one stopped.
// Crash: a producer killed at any point leaves only complete records. A later producer continues with the same cursors.
#pragma once

#include <array>

#include "shm/words.hpp"

namespace yars::shm {

template <Record T, std::size_t Lanes, std::size_t Depth, class Access = PlainAccess>
class InputLanes {
  static_assert(Depth >= 2 && (Depth & (Depth - 1)) == 0, "must be a power of two, so that the modulo is a bit mask");

 public:
  // Called by the lane's producer. False: the lane was full, and the drop was counted.
  bool push(std::size_t lane, const T& record);
  // Called by the consumer. Copies the oldest record to `out`. peek() leaves the record in the lane; pop() removes it.
  // False: the lane is empty, or its damaged cursors were reset. `out` is then unchanged.
  bool peek(std::size_t lane, T& out);
  bool pop(std::size_t lane, T& out);
  // Called by the consumer. Copies the record with this number, counted from 0 since the segment was created, and
  // leaves it in the lane. False: the lane does not hold the record. `out` is then unchanged.
  bool peek_at(std::size_t lane, std::uint64_t number, T& out) const;

  // pushed(), popped() and dropped() count the records since the segment was created.
  bool empty(std::size_t lane) const { return pushed(lane) == popped(lane); }
  std::uint64_t pushed(std::size_t lane) const { return Access::load(lanes_[lane].pushed, std::memory_order_acquire); }
  std::uint64_t popped(std::size_t lane) const { return Access::load(lanes_[lane].popped, std::memory_order_acquire); }
  std::uint64_t dropped(std::size_t lane) const {
    return Access::load(lanes_[lane].dropped, std::memory_order_relaxed);
  }

  // Name of the lane's producer, for display. Characters after the 23rd are cut off.
  void set_source(std::size_t lane, std::string_view source) {
    store_text<Access>(lanes_[lane].source.data(), kSourceWords, source);
  }
  std::string source(std::size_t lane) const { return load_text(lanes_[lane].source.data(), kSourceWords); }

  static constexpr std::size_t kLanes = Lanes;
  static constexpr std::size_t kDepth = Depth;
  // Offsets [bytes] in a lane, for databuffer/client/yars.h and `yars status --layout`.
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
    alignas(kCacheLine) AtomicWord pushed;  // written by the producer
    AtomicWord dropped;
    AtomicWord popped_seen;  // the producer's copy of `popped`, refreshed only when the lane seems full
    std::array<AtomicWord, kSourceWords> source;
    alignas(kCacheLine) AtomicWord popped;  // written by the consumer
    AtomicWord pushed_seen;                 // the consumer's copy of `pushed`, refreshed only when the lane seems empty
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
  // A lane cannot hold more than Depth records. A larger difference of the cursors means that they are damaged. The
  // consumer then discards all records, because their order is unknown.
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
bool InputLanes<T, Lanes, Depth, Access>::peek_at(std::size_t lane, std::uint64_t number, T& out) const {
  const Lane& from = lanes_[lane];
  const Word first = Access::load(from.popped, std::memory_order_relaxed);
  const Word end = Access::load(from.pushed, std::memory_order_acquire);
  if (end - first > Depth || number - first >= end - first) return false;
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
