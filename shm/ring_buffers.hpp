// Ring buffers in shared memory: one producer of records, or many writers of notes.
#pragma once

#include <array>

#include "shm/words.hpp"

namespace yars::shm {

// One producer, any readers, N records deep; the producer never waits and knows of no reader. Each reader keeps its
// own cursor: the number of the record it wants next, counted from 0 since the session began. A reader that falls
// behind is told how many records it lost. A producer killed anywhere leaves every record but the oldest readable; a
// restarted one goes on from the stored count. Zero-filled memory is the empty ring.
// Of a record with `used_bytes` only those travel; the rest of `out` keeps what it held.
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

// The last N lines that any process wrote; many writers, none waits, each line belongs to one writer. A writer that
// dies loses its own line only. A writer that was stopped while the ring went round gives its line up and counts it:
// each word is exchanged against the one found while the slot was still its own. Where a newer writer has put the same
// word meanwhile, the exchange passes and that line is spoilt: a checksum tells. Lines are numbered from 0 since the
// session began. Zero-filled memory is the empty ring.
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
