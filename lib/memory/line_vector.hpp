// std::vector whose data begin at the start of a cache line (64 bytes), so that no aligned SIMD load spans two lines.
// An allocation of 2 MiB or more requests large memory pages (MADV_HUGEPAGE) for its whole multiples of 2 MiB; the rest
// has small pages. With small pages, access along rows and columns of an array of many MiB misses the TLB, the
// processor's cache of page addresses, more often than the data cache.
// Errors: std::bad_alloc. If large pages are not available, small pages are used.
#pragma once

#include <cstddef>
#include <vector>

namespace yars::memory {

// Memory aligned to 64 bytes, or to 2 MiB if `bytes` is 2 MiB or more. Release it by free_lines().
void* allocate_lines(std::size_t bytes);
void free_lines(void* memory);

template <class T>
struct LineAllocator {
  using value_type = T;

  LineAllocator() = default;
  template <class U>
  LineAllocator(const LineAllocator<U>& /*other*/) {}  // NOLINT(google-explicit-constructor): allocators convert

  T* allocate(std::size_t count) { return static_cast<T*>(allocate_lines(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t /*count*/) { free_lines(memory); }
  friend bool operator==(const LineAllocator& /*one*/, const LineAllocator& /*other*/) { return true; }
};

template <class T>
using CacheAlignedVector = std::vector<T, LineAllocator<T>>;

}  // namespace yars::memory
