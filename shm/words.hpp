// Records in shared memory as atomic 64-bit words, moved 16 bytes at a time on x86-64.
// Inputs: trivially copyable records with a size that is a multiple of 8 bytes (concept Record).
// Threads: one writer and any number of readers of the same words have no data race.
// Source: Intel SDM vol. 3, 9.2.2 (order of loads and stores); docs/decisions/0005.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace yars::shm {

// Size [bytes] of one wide move between a record and shared memory. A wide move replaces the moves of two atomic words.
// x86-64 keeps loads in order among themselves, and stores in order among themselves (Intel SDM vol. 3, 9.2.2).
// A wide load is therefore ordered like two acquire loads, a wide store like two release stores. The asm clobber keeps
// the compiler from reordering them. A reader detects a move torn between its two words by the slot's sequence
// (publishing order below). Throughput of complete sweep records, relative to a ring that uses memcpy: single words 0.4
// to 0.75, wide moves at least 0.97. kWideMoves is false on other processors. It is also false under ThreadSanitizer (a
// compiler's check for data races), which models only the atomics of C++.
inline constexpr std::size_t kWideBytes = 16;

#if defined(__x86_64__) && !defined(__SANITIZE_THREAD__)
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define YARS_WORDS_ONLY
#endif
#endif
#else
#define YARS_WORDS_ONLY
#endif

#ifdef YARS_WORDS_ONLY
#undef YARS_WORDS_ONLY
inline constexpr bool kWideMoves = false;
inline void wide_move(void* /*to*/, const void* /*from*/) {}
#else
inline constexpr bool kWideMoves = true;
inline void wide_move(void* to, const void* from) {
  struct Block {
    unsigned char bytes[kWideBytes];
  };
  asm volatile(
      "movdqu %1, %%xmm0\n\t"
      "movdqu %%xmm0, %0"
      : "=m"(*static_cast<Block*>(to))
      : "m"(*static_cast<const Block*>(from))
      : "xmm0", "memory");
}
#endif

// Publishing order of a slot (a sequence number and the words of a record): the sequence becomes odd, the words are
// stored (release), the sequence becomes even (release). A reader that acquires a new word also sees the odd sequence.
// There are no fences, because ThreadSanitizer does not model them.
// `Access` is the policy class with which a container loads and stores words. Tests substitute a policy that stops the
// writer after every store and runs the writer before every load of the reader.
// A record of variable length declares `std::size_t used_bytes(const Record&)` in its own namespace. Only that many
// leading bytes, rounded up to whole words, are copied.

inline constexpr std::size_t kCacheLine = 64;  // [bytes] alignment against false sharing (two writers per cache line)

using Word = std::uint64_t;
using AtomicWord = std::atomic<Word>;
static_assert(AtomicWord::is_always_lock_free && sizeof(AtomicWord) == sizeof(Word));

inline constexpr std::size_t kWideWords = kWideBytes / sizeof(Word);

// Access policy of the programs: the operations of std::atomic.
struct PlainAccess {
  static constexpr bool kWide = kWideMoves;
  static void store(AtomicWord& word, Word value, std::memory_order order) { word.store(value, order); }
  static Word load(const AtomicWord& word, std::memory_order order) { return word.load(order); }
  static Word fetch_add(AtomicWord& word, Word value, std::memory_order order) { return word.fetch_add(value, order); }
  static bool compare_exchange(AtomicWord& word, Word& seen, Word value, std::memory_order order) {
    return word.compare_exchange_strong(seen, value, order, std::memory_order_relaxed);
  }
};

template <class T>
concept Record = std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(Word) == 0;

template <class T>
concept PartlyUsedRecord = Record<T> && requires(const T& record) {
  { used_bytes(record) } -> std::convertible_to<std::size_t>;
};

template <Record T>
inline constexpr std::size_t kWordsOf = sizeof(T) / sizeof(Word);

// Number of words to copy: all of the record, or the leading part that `used_bytes` states.
template <Record T>
std::size_t used_words(const T& record) {
  if constexpr (PartlyUsedRecord<T>)
    return std::min<std::size_t>((used_bytes(record) + sizeof(Word) - 1) / sizeof(Word), kWordsOf<T>);
  else
    return kWordsOf<T>;
}

// Smallest odd number above `sequence`. An odd `sequence` is left by a writer that was killed while it filled the slot.
constexpr Word next_odd(Word sequence) {
  return (sequence + 1) | 1U;
}

// Copies `count` words of `record` to shared memory (release). Unrolled, because most records are short.
template <class Access>
void store_words(AtomicWord* words, const void* record, std::size_t count) {
  const auto* bytes = static_cast<const std::byte*>(record);
  std::size_t i = 0;
  if constexpr (Access::kWide) {
#pragma GCC unroll 4
    for (; i + kWideWords <= count; i += kWideWords) wide_move(&words[i], bytes + i * sizeof(Word));
  }
#pragma GCC unroll 8
  for (; i < count; ++i) {
    Word word;
    std::memcpy(&word, bytes + i * sizeof(Word), sizeof(Word));
    Access::store(words[i], word, std::memory_order_release);
  }
}

// Copies `count` words from shared memory to `record` (acquire).
template <class Access = PlainAccess>
void load_words(const AtomicWord* words, void* record, std::size_t count) {
  auto* bytes = static_cast<std::byte*>(record);
  std::size_t i = 0;
  if constexpr (Access::kWide) {
#pragma GCC unroll 4
    for (; i + kWideWords <= count; i += kWideWords) wide_move(bytes + i * sizeof(Word), &words[i]);
  }
#pragma GCC unroll 8
  for (; i < count; ++i) {
    const Word word = Access::load(words[i], std::memory_order_acquire);
    std::memcpy(bytes + i * sizeof(Word), &word, sizeof(Word));
  }
}

// Stores `text` in `count` words. Longer text is truncated, unused bytes are zero, and the last byte is always zero.
template <class Access = PlainAccess>
void store_text(AtomicWord* words, std::size_t count, std::string_view text) {
  for (std::size_t i = 0; i < count; ++i) {
    std::array<char, sizeof(Word)> letters{};
    const std::size_t begin = std::min(i * sizeof(Word), text.size());
    text.substr(begin).copy(letters.data(), i + 1 == count ? letters.size() - 1 : letters.size());
    store_words<Access>(&words[i], letters.data(), 1);
  }
}

// Reads text that store_text() has stored.
inline std::string load_text(const AtomicWord* words, std::size_t count) {
  std::string text(count * sizeof(Word), '\0');
  load_words(words, text.data(), count);
  return text.substr(0, std::min(text.find('\0'), text.size() - 1));
}

}  // namespace yars::shm
