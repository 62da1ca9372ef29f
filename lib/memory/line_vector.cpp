#include "lib/memory/line_vector.hpp"

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace yars::memory {

namespace {
constexpr std::size_t kLine = 64;
constexpr std::size_t kLargePage = std::size_t{2} << 20U;
}  // namespace

void* allocate_lines(std::size_t bytes) {
  const bool large = bytes >= kLargePage;
  const std::size_t unit = large ? kLargePage : kLine;
  const std::size_t whole = (bytes + unit - 1) / unit * unit;
  void* memory = whole >= bytes ? std::aligned_alloc(unit, whole) : nullptr;
  if (memory == nullptr) throw std::bad_alloc();
  // A wish: a kernel without them does as it always did.
  if (large) madvise(memory, whole, MADV_HUGEPAGE);
  return memory;
}

void free_lines(void* memory) {
  std::free(memory);
}

}  // namespace yars::memory
