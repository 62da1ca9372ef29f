#include "lib/memory/line_vector.hpp"

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace yars::memory {

namespace {
constexpr std::size_t kLine_bytes = 64;                          // cache line of x86-64 and most 64-bit Arm cores
constexpr std::size_t kLargePage_bytes = std::size_t{2} << 20U;  // huge page of x86-64
}  // namespace

void* allocate_lines(std::size_t bytes) {
  const bool large = bytes >= kLargePage_bytes;
  const std::size_t unit = large ? kLargePage_bytes : kLine_bytes;
  const std::size_t rounded_bytes = (bytes + unit - 1) / unit * unit;
  void* memory = rounded_bytes >= bytes ? std::aligned_alloc(unit, rounded_bytes) : nullptr;
  if (memory == nullptr) throw std::bad_alloc();
  // The result is not checked: the advice only changes speed, and a system without large pages ignores it.
  if (large) madvise(memory, rounded_bytes, MADV_HUGEPAGE);
  return memory;
}

void free_lines(void* memory) {
  std::free(memory);
}

}  // namespace yars::memory
