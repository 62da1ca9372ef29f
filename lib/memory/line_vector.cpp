#include "lib/memory/line_vector.hpp"

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <new>

namespace yars::memory {

namespace {
constexpr std::size_t kLine_bytes = 64;                          // cache line of x86-64 and most 64-bit Arm cores
constexpr std::size_t kLargePage_bytes = std::size_t{2} << 20U;  // huge page of x86-64
}  // namespace

void* allocate_lines(std::size_t bytes) {
  if (bytes > static_cast<std::size_t>(PTRDIFF_MAX)) throw std::bad_alloc();
  const std::size_t large_bytes = bytes / kLargePage_bytes * kLargePage_bytes;
  void* memory = nullptr;
  if (posix_memalign(&memory, large_bytes > 0 ? kLargePage_bytes : kLine_bytes, bytes) != 0) throw std::bad_alloc();
  // A large page for the rest would occupy 2 MiB, however short the rest is.
  // The result is not checked: the advice only changes speed, and a system without large pages ignores it.
  if (large_bytes > 0) madvise(memory, large_bytes, MADV_HUGEPAGE);
  return memory;
}

void free_lines(void* memory) {
  std::free(memory);
}

}  // namespace yars::memory
