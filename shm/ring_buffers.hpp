// Ring buffers in shared memory: BroadcastRing (one producer) and NoteRing (many writers).
// Outputs: complete records, or an indication that a record was overwritten.
// Errors: a slow reader loses the oldest records. BroadcastRing reports how many.
// Threads: any number of readers; neither writers nor readers wait. Zero-filled memory is an empty ring.
#pragma once

#include <array>
#include <optional>

#include "shm/words.hpp"

namespace yars::shm {

// Result of BroadcastRing::read().
struct RingRead {
  bool delivered;         // a record was copied to `out`
  std::uint64_t lost;     // records that this call skipped because the producer overtook the reader
  std::size_t words = 0;  // length of the delivered record
};

// History of one producer. Of its N slots, N - 1 hold the readable records, which are the last published. Each reader
// keeps its own cursor: the number of the record to read next, counted from 0 since the session began. The producer
// does not know its readers. A producer killed after any store leaves all N - 1 records readable. A restarted producer
// continues the numbers. If the record type has `used_bytes` (words.hpp), read() changes only that many leading bytes
// of `out`, rounded up to a multiple of 8.
template <Record T, std::size_t N, class Access = PlainAccess>
class BroadcastRing {
  static_assert(N >= 2 && (N & (N - 1)) == 0, "must be a power of two, so that the modulo is a bit mask");

 public:
  // Appends a record and returns its number, counted from 0.
  std::uint64_t publish(const T& record);
  // Number of the next record, which equals the number of records published.
  std::uint64_t next() const { return Access::load(next_, std::memory_order_acquire); }
  // Number of the oldest readable record. The producer may be overwriting the record before the oldest.
  std::uint64_t oldest() const { return oldest_before(next()); }
  // Copies the record at `cursor` to `out` and advances the cursor. If no record was delivered and `lost` is 0, there
  // is no new record, or the record's slot is damaged. If no record was delivered and `lost` is above 0, the producer
  // overtook the reader, and all attempts failed. A failed attempt leaves `out` unspecified. If there is no new record,
  // `out` is unchanged.
  RingRead read(std::uint64_t& cursor, T& out) const;

  static constexpr std::size_t kDepth = N;
  static constexpr std::size_t next_offset() { return offsetof(BroadcastRing, next_); }
  static constexpr std::size_t slots_offset() { return offsetof(BroadcastRing, slots_); }
  static constexpr std::size_t slot_stride() { return sizeof(Slot); }

 private:
  static constexpr int kRetries = 8;  // more are needed only if the producer overtakes the reader continuously

  struct alignas(kCacheLine) Slot {
    AtomicWord sequence;  // 2 n + 1: record n is being written; 2 n + 2: record n is complete
    AtomicWord used;      // [words] length of the record
    std::array<AtomicWord, kWordsOf<T>> words;
  };

  static constexpr std::uint64_t oldest_before(std::uint64_t next) { return next < N ? 0 : next - N + 1; }
  std::optional<std::size_t> copy_out(std::uint64_t number, T& out) const;  // words copied

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
std::optional<std::size_t> BroadcastRing<T, N, Access>::copy_out(std::uint64_t number, T& out) const {
  const Slot& slot = slots_[number % N];
  const Word complete = 2 * number + 2;
  if (Access::load(slot.sequence, std::memory_order_acquire) != complete) return std::nullopt;
  const Word used = Access::load(slot.used, std::memory_order_acquire);
  if (used > kWordsOf<T>) return std::nullopt;
  load_words<Access>(slot.words.data(), &out, used);
  if (Access::load(slot.sequence, std::memory_order_relaxed) != complete) return std::nullopt;
  return used;
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
    if (const auto words = copy_out(cursor, out)) {
      ++cursor;
      return {true, result.lost, *words};
    }
  }
  return result;
}

// Ring of the last N lines from any number of writers. T is the record of one line. No writer waits. Lines are numbered
// from 0 since the session began. A writer that dies loses only the line that it was writing.
// A writer that pauses while N newer lines are appended finds one of them in its slot. It then abandons its own line
// and counts the loss. Each word is stored by compare-exchange: only if the word still has the value that the writer
// read while it owned the slot. If the newer line has stored that same value in the word, the exchange succeeds and
// corrupts the newer line. The checksum detects this case.
template <Record T, std::size_t N, class Access = PlainAccess>
class NoteRing {
 public:
  // Appends a line and returns its number.
  std::uint64_t append(const T& line);
  // Number of lines abandoned, because a newer line took their slot or kAttempts attempts failed.
  std::uint64_t lost() const { return Access::load(lost_, std::memory_order_relaxed); }
  // Number of lines begun since the session began.
  std::uint64_t total() const { return Access::load(total_, std::memory_order_acquire); }
  // Number of the oldest line that can still be in the ring.
  std::uint64_t oldest() const {
    const std::uint64_t end = total();
    return end < N ? 0 : end - N;
  }
  // False: the line was lost, overwritten or damaged, or is not yet complete. `out` is then unchanged.
  bool read(std::uint64_t number, T& out) const;

  static constexpr std::size_t kDepth = N;
  static constexpr std::size_t total_offset() { return offsetof(NoteRing, total_); }
  static constexpr std::size_t slots_offset() { return offsetof(NoteRing, slots_); }
  static constexpr std::size_t slot_stride() { return sizeof(Slot); }

 private:
  struct Slot {
    AtomicWord sequence;  // 2 n + 1: line n is being written; 2 n + 2: line n is complete
    AtomicWord checksum;
    std::array<AtomicWord, kWordsOf<T>> words;
  };
  using Copy = std::array<Word, kWordsOf<T>>;
  static constexpr int kAttempts = 8;  // more are needed only if other programs overwrite the slot continuously

  // True: this writer owns the slot until a newer line takes it.
  bool take(Slot& slot, std::uint64_t number);
  // Stores one word. False: a newer line has taken the slot.
  static bool put(Slot& slot, AtomicWord& word, Word value, Word own_sequence);
  bool write(Slot& slot, std::uint64_t number, const Copy& copy);

  // 64-bit hash FNV-1a over the line's number and words. Each step takes a word instead of a byte.
  static Word checksum_of(std::uint64_t number, const Copy& words) {
    Word sum = 0xcbf29ce484222325U;
    const auto mix = [&sum](Word word) { sum = (sum ^ word) * 0x100000001b3U; };
    mix(number);
    for (const Word word : words) mix(word);
    return sum;
  }

  alignas(kCacheLine) AtomicWord total_;
  AtomicWord lost_;  // in padding of total_'s cache line that was zero before this counter was added
  alignas(kCacheLine) std::array<Slot, N> slots_;
};

// `occupant`: number of the line in the slot. A sequence that no line of this slot can have counts as damaged and
// is overwritten.
template <Record T, std::size_t N, class Access>
bool NoteRing<T, N, Access>::take(Slot& slot, std::uint64_t number) {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    Word seen = Access::load(slot.sequence, std::memory_order_acquire);
    const std::uint64_t occupant = (seen - 1) / 2;
    if (seen != 0 && occupant > number && occupant < total() && occupant % N == number % N) return false;
    if (Access::compare_exchange(slot.sequence, seen, 2 * number + 1, std::memory_order_acq_rel)) return true;
  }
  return false;
}

// The word is loaded before the sequence. So a writer that loads a newer line's word also sees that line's sequence.
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
  const Word complete = 2 * number + 2;
  if (Access::load(slot.sequence, std::memory_order_acquire) != complete) return false;
  const Word checksum = Access::load(slot.checksum, std::memory_order_acquire);
  Copy copy;
  load_words<Access>(slot.words.data(), copy.data(), kWordsOf<T>);
  if (Access::load(slot.sequence, std::memory_order_relaxed) != complete) return false;
  if (checksum_of(number, copy) != checksum) return false;
  std::memcpy(&out, copy.data(), sizeof(T));
  return true;
}

}  // namespace yars::shm
