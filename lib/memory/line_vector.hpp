// A vector that begins on a cache line, so that loads of whole vectors do not straddle two; where it is large it asks
// the kernel for large pages: arrays of many MiB that are walked in all directions would else miss the page tables'
// cache more often than their own.
#pragma once

#include <cstddef>
#include <vector>

namespace yars::memory {

// Throws std::bad_alloc. What is not granted in large pages comes in small ones.
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
using LineVector = std::vector<T, LineAllocator<T>>;

}  // namespace yars::memory
