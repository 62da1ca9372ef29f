// Latest value of one writer for any number of readers, in shared memory.
// Outputs: a whole copy of the newest value and its version. A torn value (part old, part new) is never returned.
// Version: counts up with each publish and each clear; 0 means never written. Zero-filled memory is the empty state.
// Errors: read() gives up after 9 attempts during which the writer changed the slot. LatestReader then keeps its last
// value.
// Threads: one writer at a time, which a byte lock of the segment ensures. Readers and the writer never wait.
// A writer killed after any store leaves the previous or the new value whole. The next writer continues from the stored
// version.
#pragma once

#include <array>
#include <optional>

#include "shm/words.hpp"

namespace yars::shm {

template <Record T, class Access = PlainAccess>
class LatestValue {
 public:
  void publish(const T& value);
  // Withdraws the value. Readers find no value until the next publish().
  void clear();
  // Copies the value to `out` and returns its version. Returns nullopt and leaves `out` untouched if there is no value,
  // or if the writer changed the slot during every attempt.
  std::optional<std::uint64_t> read(T& out) const;
  std::uint64_t version() const { return Access::load(state_, std::memory_order_acquire) >> 1; }
  bool has_value() const { return (Access::load(state_, std::memory_order_acquire) & kPresent) != 0; }

  // Number of slots, and offsets [bytes], for databuffer/client/yars.h and `yars status --layout`.
  static constexpr std::size_t kSlots = 4;  // a slot is rewritten 4 versions later at the earliest
  static constexpr std::size_t state_offset() { return offsetof(LatestValue, state_); }
  static constexpr std::size_t slots_offset() { return offsetof(LatestValue, slots_); }
  static constexpr std::size_t slot_stride() { return sizeof(Slot); }

 private:
  static constexpr Word kPresent = 1;
  static constexpr Word kLastVersion = ~Word{0} >> 1;
  static constexpr int kRetries = 8;

  struct alignas(kCacheLine) Slot {
    AtomicWord sequence;  // odd while the writer fills the slot
    AtomicWord version;   // version of the value in `words`
    std::array<AtomicWord, kWordsOf<T>> words;
  };

  // Version of the next value. After the last one comes 1, because 0 means never written.
  Word next_version() const {
    const Word version = Access::load(state_, std::memory_order_relaxed) >> 1;
    return version == kLastVersion ? 1 : version + 1;
  }

  alignas(kCacheLine) AtomicWord state_;  // 2 * version + (1 if a value is present); value in slots_[version % kSlots]
  std::array<Slot, kSlots> slots_;
};

template <Record T, class Access>
void LatestValue<T, Access>::publish(const T& value) {
  const Word version = next_version();
  Slot& slot = slots_[version % kSlots];
  const Word odd = next_odd(Access::load(slot.sequence, std::memory_order_relaxed));
  Access::store(slot.sequence, odd, std::memory_order_relaxed);
  Access::store(slot.version, version, std::memory_order_release);
  store_words<Access>(slot.words.data(), &value, kWordsOf<T>);
  Access::store(slot.sequence, odd + 1, std::memory_order_release);
  Access::store(state_, version << 1 | kPresent, std::memory_order_release);
}

template <Record T, class Access>
void LatestValue<T, Access>::clear() {
  const Word version = next_version();
  Access::store(state_, version << 1, std::memory_order_release);
}

template <Record T, class Access>
std::optional<std::uint64_t> LatestValue<T, Access>::read(T& out) const {
  for (int attempt = 0; attempt <= kRetries; ++attempt) {
    const Word state = Access::load(state_, std::memory_order_acquire);
    if ((state & kPresent) == 0) return std::nullopt;
    const Word version = state >> 1;
    const Slot& slot = slots_[version % kSlots];
    const Word before = Access::load(slot.sequence, std::memory_order_acquire);
    if (before % 2 != 0) continue;
    // A writer may die after filling the slot and before updating state_. Only the version in state_ counts.
    if (Access::load(slot.version, std::memory_order_acquire) != version) continue;
    std::array<Word, kWordsOf<T>> copy;
    load_words<Access>(slot.words.data(), copy.data(), kWordsOf<T>);
    if (Access::load(slot.sequence, std::memory_order_relaxed) != before) continue;
    std::memcpy(&out, copy.data(), sizeof(T));
    return version;
  }
  return std::nullopt;
}

// One reader's copy of a LatestValue: the last whole value read, and its version.
template <Record T, class Access = PlainAccess>
class LatestReader {
 public:
  explicit LatestReader(const LatestValue<T, Access>& source) : source_(&source) {}

  // Copies a newer value, if there is one, to value(). Returns true if value() is then a newer one.
  bool refresh() {
    if (source_->version() == version_ || !source_->has_value()) return false;
    const auto version = source_->read(value_);
    if (!version) return false;
    const bool newer = *version != version_;
    version_ = *version;
    return newer;
  }
  bool has_value() const { return version_ != 0; }
  // Last value copied; zero-filled until refresh() has returned true. It remains when the writer calls clear().
  const T& value() const { return value_; }
  std::uint64_t version() const { return version_; }

 private:
  const LatestValue<T, Access>* source_;
  T value_{};
  std::uint64_t version_ = 0;
};

}  // namespace yars::shm
