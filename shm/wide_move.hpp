// Moves 16 bytes between a record and shared memory by one instruction, where that is as good as two atomic words.
// x86-64 keeps loads in order among themselves and stores in order among themselves (Intel SDM vol. 3, 9.2.2), so a
// block loaded is two acquire loads and a block stored two release stores; the clobber holds the compiler to it. A
// block torn between its words is caught by the sequence around it like any other torn record. Words alone reach
// 0.4 to 0.75 of a memcpy ring's speed on a whole sweep, blocks 0.97 and more (docs/decisions/0005). On other
// processors, and under ThreadSanitizer, which understands the language's atomics only, kWideMoves is false and words
// travel.
#pragma once

#include <cstddef>

namespace yars::shm {

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

}  // namespace yars::shm
