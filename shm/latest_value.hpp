// The last whole value that one writer published, for any readers; nobody waits. A writer that is killed anywhere
// leaves the last whole value; the next writer (one at a time: a byte lock sees to it) goes on from what lies here.
// Zero-filled memory is the empty state. Version: counts up with each publish and each clear, 0 = never touched.
// Reading copies out and checks; overtaken 8 times in a row it gives up and the caller keeps what it had.
// LatestReader does that keeping and counts the reads given up.
#pragma once

#include <array>
#include <optional>

#include "shm/words.hpp"

namespace yars::shm {

template <Record T, class Access = PlainAccess>
class LatestValue {
 public:
  void publish(const T& value);
  // Takes the value away: readers find nothing until the next publish.
  void clear();
  // The version copied; nullopt: nothing there, or overtaken too often. `out` is then untouched.
  std::optional<std::uint64_t> read(T& out) const;
  std::uint64_t version() const { return Access::load(state_, std::memory_order_acquire) >> 1; }
  bool has_value() const { return (Access::load(state_, std::memory_order_acquire) & kPresent) != 0; }

  // Where things lie, for databuffer/client/yars.h and `yars status --layout`.
  static constexpr std::size_t kSlots = 4;
  static constexpr std::size_t state_offset() { return offsetof(LatestValue, state_); }
  static constexpr std::size_t slots_offset() { return offsetof(LatestValue, slots_); }
  static constexpr std::size_t slot_stride() { return sizeof(Slot); }

 private:
  static constexpr Word kPresent = 1;
  static constexpr int kRetries = 8;

  struct alignas(kCacheLine) Slot {
    AtomicWord sequence;  // odd: being written
    AtomicWord version;   // of the value inside
    std::array<AtomicWord, kWordsOf<T>> words;
  };

  alignas(kCacheLine) AtomicWord state_;  // version * 2 + (1: a value is there); its slot is version % kSlots
  std::array<Slot, kSlots> slots_;
};

template <Record T, class Access>
void LatestValue<T, Access>::publish(const T& value) {
  const Word version = (Access::load(state_, std::memory_order_relaxed) >> 1) + 1;
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
  const Word version = (Access::load(state_, std::memory_order_relaxed) >> 1) + 1;
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
    // A later value in the same slot may be one that its writer never lived to announce: only the announced one counts.
    if (Access::load(slot.version, std::memory_order_acquire) != version) continue;
    std::array<Word, kWordsOf<T>> copy;
    load_words<Access>(slot.words.data(), copy.data(), kWordsOf<T>);
    if (Access::load(slot.sequence, std::memory_order_relaxed) != before) continue;
    std::memcpy(&out, copy.data(), sizeof(T));
    return version;
  }
  return std::nullopt;
}

// One reader's view: the last value it got whole, its version, and how many reads it had to give up.
template <Record T, class Access = PlainAccess>
class LatestReader {
 public:
  explicit LatestReader(const LatestValue<T, Access>& source) : source_(&source) {}

  // True when a value newer than the one held has come.
  bool refresh() {
    if (source_->version() == version_ || !source_->has_value()) return false;
    const auto version = source_->read(value_);
    if (!version) {
      lost_ += source_->has_value() ? 1 : 0;
      return false;
    }
    const bool newer = *version != version_;
    version_ = *version;
    return newer;
  }
  bool has_value() const { return version_ != 0; }
  const T& value() const { return value_; }  // zero until refresh() has returned true
  // The source has taken away what it had; the value held is the last one seen.
  bool withdrawn() const { return has_value() && !source_->has_value(); }
  std::uint64_t version() const { return version_; }
  std::uint64_t lost() const { return lost_; }

 private:
  const LatestValue<T, Access>* source_;
  T value_{};
  std::uint64_t version_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace yars::shm
