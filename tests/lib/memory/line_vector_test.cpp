// CacheAlignedVector: alignment to cache lines of 64 bytes and large pages of 2 MiB; failed allocation.
#include "lib/memory/line_vector.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <new>

namespace yars::memory {
namespace {

TEST(CacheAlignedVector, BeginsOnACacheLineAtAnySize) {
  for (const std::size_t count : {1UL, 7UL, 1000UL, 3UL << 20U}) {
    const CacheAlignedVector<float> numbers(count, 1.0F);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(numbers.data()) % 64, 0U) << count;
    EXPECT_EQ(numbers.back(), 1.0F);
  }
}

TEST(CacheAlignedVector, BeginsOnALargePageWhenItIsLarge) {
  const CacheAlignedVector<float> numbers(1U << 20U);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(numbers.data()) % (2U << 20U), 0U);
}

TEST(CacheAlignedVector, ThrowsBadAllocIfMemoryIsTooSmall) {
  EXPECT_THROW(allocate_lines(std::numeric_limits<std::size_t>::max() - 100U), std::bad_alloc);
}

}  // namespace
}  // namespace yars::memory
