// One producer, any readers, N records deep; the producer never waits and knows of no reader. Each reader keeps its
// own cursor: the number of the record it wants next, counted from 0 since the session began. A reader that falls
// behind is told how many records it lost. A producer killed anywhere leaves every record but the oldest readable; a
// restarted one goes on from the stored count. Zero-filled memory is the empty ring.
// Of a record with `used_bytes` only those travel; the rest of `out` keeps what it held.
#pragma once

#include <array>

#include "shm/words.hpp"

namespace yars::shm {

struct RingRead {
  bool delivered;      // a record was copied out
  std::uint64_t lost;  // records skipped by this call because the producer overtook the reader
};

template <Record T, std::size_t N, class Access = PlainAccess>
class BroadcastRing {
  static_assert(N >= 2 && (N & (N - 1)) == 0, "a power of two: the slot is found by a mask");

 public:
  // The number that the record got.
  std::uint64_t publish(const T& record);
  // The number that the next record will get = records published so far.
  std::uint64_t next() const { return Access::load(next_, std::memory_order_acquire); }
  // The oldest record that can be read: the producer may be writing over the slot behind it.
  std::uint64_t oldest() const { return oldest_before(next()); }
  // Copies the record at `cursor` out and moves the cursor past it. Not delivered: nothing new (lost 0), or overtaken
  // again and again (lost > 0); `out` may then hold anything.
  RingRead read(std::uint64_t& cursor, T& out) const;

  static constexpr std::size_t kDepth = N;
  static constexpr std::size_t next_offset() { return offsetof(BroadcastRing, next_); }
  static constexpr std::size_t slots_offset() { return offsetof(BroadcastRing, slots_); }
  static constexpr std::size_t slot_stride() { return sizeof(Slot); }

 private:
  static constexpr int kRetries = 8;

  struct alignas(kCacheLine) Slot {
    AtomicWord sequence;  // 2 n + 1: record n is being written; 2 n + 2: it is whole
    AtomicWord used;      // words that travel
    std::array<AtomicWord, kWordsOf<T>> words;
  };

  static constexpr std::uint64_t oldest_before(std::uint64_t next) { return next < N ? 0 : next - N + 1; }
  bool copy_out(std::uint64_t number, T& out) const;

  alignas(kCacheLine) AtomicWord next_;
  std::array<Slot, N> slots_;
};

template <Record T, std::size_t N, class Access>
std::uint64_t BroadcastRing<T, N, Access>::publish(const T& record) {
  const std::uint64_t number = Access::load(next_, std::memory_order_relaxed);
  Slot& slot = slots_[number % N];
  const std::size_t used = used_words(record);
  Access::store(slot.sequence, 2 * number + 1, std::memory_order_relaxed);
  Access::store(slot.used, used, std::memory_order_release);
  store_words<Access>(slot.words.data(), &record, used);
  Access::store(slot.sequence, 2 * number + 2, std::memory_order_release);
  Access::store(next_, number + 1, std::memory_order_release);
  return number;
}

template <Record T, std::size_t N, class Access>
bool BroadcastRing<T, N, Access>::copy_out(std::uint64_t number, T& out) const {
  const Slot& slot = slots_[number % N];
  const Word whole = 2 * number + 2;
  if (Access::load(slot.sequence, std::memory_order_acquire) != whole) return false;
  const Word used = Access::load(slot.used, std::memory_order_acquire);
  if (used > kWordsOf<T>) return false;
  load_words<Access>(slot.words.data(), &out, used);
  return Access::load(slot.sequence, std::memory_order_relaxed) == whole;
}

template <Record T, std::size_t N, class Access>
RingRead BroadcastRing<T, N, Access>::read(std::uint64_t& cursor, T& out) const {
  RingRead result{false, 0};
  for (int attempt = 0; attempt <= kRetries; ++attempt) {
    const std::uint64_t end = next();
    cursor = std::min(cursor, end);
    const std::uint64_t begin = oldest_before(end);
    if (cursor < begin) {
      result.lost += begin - cursor;
      cursor = begin;
    }
    if (cursor == end) return result;
    result.delivered = copy_out(cursor, out);
    if (result.delivered) {
      ++cursor;
      return result;
    }
  }
  return result;
}

}  // namespace yars::shm
