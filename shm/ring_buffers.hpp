// Ring buffers in shared memory: InputLanes (a lane for each event source, one producer and one consumer),
// BroadcastRing (one producer) and NoteRing (many writers).
// Outputs: complete records, or an indication that a record was overwritten. `lane` is in [0, Lanes). Each lane is
// FIFO; records of different lanes have no common order.
// Errors: push() to a full lane drops the record and counts the drop. A slow reader of a ring loses the oldest records.
// BroadcastRing reports how many.
// Threads: one producer per lane, one consumer for all lanes; any number of readers of a ring. No call waits for
// another process (wait-free). Zero-filled memory is the valid empty state.
// Crash and restart of lanes: the cursors `pushed` and `popped` lie in the segment; a new producer or consumer
// continues where the old one stopped. A producer killed at any point leaves only complete records.
#pragma once

#include <array>
#include <optional>

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
