// Reference of shm_benchmark: a broadcast ring as shm::BroadcastRing, but with records copied by memcpy. For benchmarks
// only: the slot's sequence number detects a torn copy, but the copy itself is a data race in C++.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>

#include "shm/ring_buffers.hpp"

namespace yars::benchmarks {

template <class T, std::size_t N>
class MemcpyRing {
 public:
  std::uint64_t publish(const T& record) {
    const std::uint64_t number = next_.load(std::memory_order_relaxed);
    Slot& slot = slots_[number % N];
    const std::size_t used = shm::used_words(record) * sizeof(shm::Word);
    slot.sequence.store(2 * number + 1, std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_release);
    slot.used = used;
    std::memcpy(&slot.record, &record, used);
    slot.sequence.store(2 * number + 2, std::memory_order_release);
    next_.store(number + 1, std::memory_order_release);
    return number;
  }

  std::uint64_t next() const { return next_.load(std::memory_order_acquire); }

  shm::RingRead read(std::uint64_t& cursor, T& out) const {
    if (cursor == next()) return {false, 0};
    const Slot& slot = slots_[cursor % N];
    const std::uint64_t complete = 2 * cursor + 2;
    if (slot.sequence.load(std::memory_order_acquire) != complete) return {false, 0};
    std::memcpy(&out, &slot.record, slot.used);
    std::atomic_thread_fence(std::memory_order_acquire);
    if (slot.sequence.load(std::memory_order_relaxed) != complete) return {false, 0};
    ++cursor;
    return {true, 0};
  }

 private:
  struct alignas(shm::kCacheLine) Slot {
    std::atomic<std::uint64_t> sequence;  // record n: 2 n + 1 while it is written, 2 n + 2 when it is complete
    std::size_t used;                     // [bytes] of the record
    T record;
  };
  alignas(shm::kCacheLine) std::atomic<std::uint64_t> next_;
  std::array<Slot, N> slots_;
};

}  // namespace yars::benchmarks
