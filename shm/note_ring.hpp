// The last N lines that any process wrote; many writers, none waits, each line belongs to one writer. A writer that
// dies loses its own line only. A writer that was stopped while the ring went round spoils the line it wakes up in:
// a checksum tells, and that line counts as lost. Lines are numbered from 0 since the session began. Zero-filled
// memory is the empty ring.
#pragma once

#include <array>

#include "shm/words.hpp"

namespace yars::shm {

template <Record T, std::size_t N, class Access = PlainAccess>
class NoteRing {
 public:
  // The number that the line got.
  std::uint64_t append(const T& line);
  // Lines begun since the session began.
  std::uint64_t total() const { return Access::load(total_, std::memory_order_acquire); }
  std::uint64_t oldest() const {
    const std::uint64_t end = total();
    return end < N ? 0 : end - N;
  }
  // False: that line is lost, overwritten or not yet there; `out` is then untouched.
  bool read(std::uint64_t number, T& out) const;

  static constexpr std::size_t kDepth = N;
  static constexpr std::size_t total_offset() { return offsetof(NoteRing, total_); }
  static constexpr std::size_t slots_offset() { return offsetof(NoteRing, slots_); }
  static constexpr std::size_t slot_stride() { return sizeof(Slot); }

 private:
  struct Slot {
    AtomicWord sequence;  // 2 n + 1: line n is being written; 2 n + 2: it is whole
    AtomicWord checksum;
    std::array<AtomicWord, kWordsOf<T>> words;
  };
  using Copy = std::array<Word, kWordsOf<T>>;

  // FNV-1a over the line's number and words.
  static Word checksum_of(std::uint64_t number, const Copy& words) {
    Word sum = 0xcbf29ce484222325U;
    const auto mix = [&sum](Word word) { sum = (sum ^ word) * 0x100000001b3U; };
    mix(number);
    for (const Word word : words) mix(word);
    return sum;
  }

  alignas(kCacheLine) AtomicWord total_;
  alignas(kCacheLine) std::array<Slot, N> slots_;
};

template <Record T, std::size_t N, class Access>
std::uint64_t NoteRing<T, N, Access>::append(const T& line) {
  const std::uint64_t number = Access::fetch_add(total_, 1, std::memory_order_acq_rel);
  Slot& slot = slots_[number % N];
  Copy copy;
  std::memcpy(copy.data(), &line, sizeof(T));
  Access::store(slot.sequence, 2 * number + 1, std::memory_order_relaxed);
  Access::store(slot.checksum, checksum_of(number, copy), std::memory_order_release);
  store_words<Access>(slot.words.data(), copy.data(), kWordsOf<T>);
  Access::store(slot.sequence, 2 * number + 2, std::memory_order_release);
  return number;
}

template <Record T, std::size_t N, class Access>
bool NoteRing<T, N, Access>::read(std::uint64_t number, T& out) const {
  const Slot& slot = slots_[number % N];
  const Word whole = 2 * number + 2;
  if (Access::load(slot.sequence, std::memory_order_acquire) != whole) return false;
  const Word checksum = Access::load(slot.checksum, std::memory_order_acquire);
  Copy copy;
  load_words<Access>(slot.words.data(), copy.data(), kWordsOf<T>);
  if (Access::load(slot.sequence, std::memory_order_relaxed) != whole) return false;
  if (checksum_of(number, copy) != checksum) return false;
  std::memcpy(&out, copy.data(), sizeof(T));
  return true;
}

}  // namespace yars::shm
