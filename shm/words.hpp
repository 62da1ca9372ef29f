// Records as atomic 64-bit words in shared memory, moved 16 bytes at a time where that is safe.
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

// Moves 16 bytes between a record and shared memory by one instruction, where that is as good as two atomic words.
// x86-64 keeps loads in order among themselves and stores in order among themselves (Intel SDM vol. 3, 9.2.2), so a
// block loaded is two acquire loads and a block stored two release stores; the clobber holds the compiler to it. A
// block torn between its words is caught by the sequence around it like any other torn record. Words alone reach
// 0.4 to 0.75 of a memcpy ring's speed on a whole sweep, blocks 0.97 and more (docs/decisions/0005). On other
// processors, and under ThreadSanitizer, which understands the language's atomics only, kWideMoves is false and words
// travel.
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

// Records travel through shared memory as 64-bit atomic words, so that a reader who meets a writer has no data race.
// Publishing order: a slot's sequence goes odd, words (release), sequence even (release). A reader loads words with
// acquire: whoever has seen one new word also sees the odd sequence in front of it. No fences: ThreadSanitizer
// understands this. `Access` is how a container reaches memory; tests put one in its place that stops the writer
// after every single store, and lets a writer in before every single load. A record whose length varies declares, in
// its own namespace, `std::size_t used_bytes(const Record&)`: only these leading bytes travel.
inline constexpr std::size_t kCacheLine = 64;  // [bytes] cursors of writer and reader lie on lines of their own

using Word = std::uint64_t;
using AtomicWord = std::atomic<Word>;
static_assert(AtomicWord::is_always_lock_free && sizeof(AtomicWord) == sizeof(Word));

inline constexpr std::size_t kWideWords = kWideBytes / sizeof(Word);

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

// Words of a record that travel: all of them, unless the record says how much of it is used.
template <Record T>
std::size_t used_words(const T& record) {
  if constexpr (PartlyUsedRecord<T>)
    return std::min<std::size_t>((used_bytes(record) + sizeof(Word) - 1) / sizeof(Word), kWordsOf<T>);
  else
    return kWordsOf<T>;
}

// What a writer that takes over from a dead one puts into a slot: the next higher odd number.
constexpr Word next_odd(Word sequence) {
  return (sequence + 1) | 1U;
}

// Few records are long enough for a loop's overhead not to count, hence the unrolling.
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

// A name for people, in `count` words: what is too long is cut, the last byte is zero.
template <class Access = PlainAccess>
void store_text(AtomicWord* words, std::size_t count, std::string_view text) {
  for (std::size_t i = 0; i < count; ++i) {
    std::array<char, sizeof(Word)> piece{};
    const std::size_t begin = std::min(i * sizeof(Word), text.size());
    text.substr(begin).copy(piece.data(), i + 1 == count ? piece.size() - 1 : piece.size());
    store_words<Access>(&words[i], piece.data(), 1);
  }
}

inline std::string load_text(const AtomicWord* words, std::size_t count) {
  std::string text(count * sizeof(Word), '\0');
  load_words(words, text.data(), count);
  return text.substr(0, std::min(text.find('\0'), text.size() - 1));
}

}  // namespace yars::shm
