// The last N lines that any process wrote; many writers, none waits, each line belongs to one writer. A writer that
// dies loses its own line only. A writer that was stopped while the ring went round gives its line up and counts it:
// each word is exchanged against the one found while the slot was still its own. Where a newer writer has put the same
// word meanwhile, the exchange passes and that line is spoilt: a checksum tells. Lines are numbered from 0 since the
// session began. Zero-filled memory is the empty ring.
#pragma once

#include <array>

#include "shm/words.hpp"

namespace yars::shm {

template <Record T, std::size_t N, class Access = PlainAccess>
class NoteRing {
 public:
  // The number that the line got.
  std::uint64_t append(const T& line);
  // Lines that were given up because the ring had gone round meanwhile.
  std::uint64_t lost() const { return Access::load(lost_, std::memory_order_relaxed); }
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
  static constexpr int kAttempts = 8;  // more only with a slot that others damage all the time

  // True: the slot is this line's until a newer line takes it.
  bool take(Slot& slot, std::uint64_t number);
  // False: a newer line has the slot.
  static bool put(Slot& slot, AtomicWord& word, Word value, Word own_sequence);
  bool write(Slot& slot, std::uint64_t number, const Copy& copy);

  // FNV-1a over the line's number and words.
  static Word checksum_of(std::uint64_t number, const Copy& words) {
    Word sum = 0xcbf29ce484222325U;
    const auto mix = [&sum](Word word) { sum = (sum ^ word) * 0x100000001b3U; };
    mix(number);
    for (const Word word : words) mix(word);
    return sum;
  }

  alignas(kCacheLine) AtomicWord total_;
  AtomicWord lost_;  // in the rest of the line: creators of older builds have zeros there
  alignas(kCacheLine) std::array<Slot, N> slots_;
};

// A sequence that no line of this slot can have had is damage, and taken over like an older line's.
template <Record T, std::size_t N, class Access>
bool NoteRing<T, N, Access>::take(Slot& slot, std::uint64_t number) {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    Word seen = Access::load(slot.sequence, std::memory_order_acquire);
    const std::uint64_t there = (seen - 1) / 2;
    if (seen != 0 && there > number && there < total() && there % N == number % N) return false;
    if (Access::compare_exchange(slot.sequence, seen, 2 * number + 1, std::memory_order_acq_rel)) return true;
  }
  return false;
}

// The word is looked at first: who has seen a newer line's word also sees its sequence.
template <Record T, std::size_t N, class Access>
bool NoteRing<T, N, Access>::put(Slot& slot, AtomicWord& word, Word value, Word own_sequence) {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    Word seen = Access::load(word, std::memory_order_acquire);
    if (Access::load(slot.sequence, std::memory_order_acquire) != own_sequence) return false;
    if (Access::compare_exchange(word, seen, value, std::memory_order_release)) return true;
  }
  return false;
}

template <Record T, std::size_t N, class Access>
bool NoteRing<T, N, Access>::write(Slot& slot, std::uint64_t number, const Copy& copy) {
  if (!take(slot, number)) return false;
  Word own = 2 * number + 1;
  if (!put(slot, slot.checksum, checksum_of(number, copy), own)) return false;
  for (std::size_t i = 0; i < copy.size(); ++i)
    if (!put(slot, slot.words[i], copy[i], own)) return false;
  return Access::compare_exchange(slot.sequence, own, own + 1, std::memory_order_release);
}

template <Record T, std::size_t N, class Access>
std::uint64_t NoteRing<T, N, Access>::append(const T& line) {
  const std::uint64_t number = Access::fetch_add(total_, 1, std::memory_order_acq_rel);
  Copy copy;
  std::memcpy(copy.data(), &line, sizeof(T));
  if (!write(slots_[number % N], number, copy)) Access::fetch_add(lost_, 1, std::memory_order_relaxed);
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
