// CacheAlignedVector: alignment to cache lines of 64 bytes and large pages of 2 MiB; failed allocation.
#include "lib/memory/line_vector.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <limits>
#include <new>
#include <string>
#include <vector>

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

// [KiB] Resident memory of the process.
long resident_kib() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::stol(line.substr(6));
  return 0;
}

TEST(CacheAlignedVector, OccupiesNoLargePageForARest) {
  constexpr std::size_t kBytes = (2U << 20U) + 1024U;
  std::vector<CacheAlignedVector<char>> all;
  all.reserve(16);
  const long before_kib = resident_kib();
  for (int i = 0; i < 16; ++i) all.emplace_back(kBytes, 'x');
  EXPECT_LT(resident_kib() - before_kib, 16L * 3 * 1024) << "2 MiB each and a little, not 4 MiB";
}

TEST(CacheAlignedVector, ThrowsBadAllocIfMemoryIsTooSmall) {
  EXPECT_THROW(allocate_lines(std::numeric_limits<std::size_t>::max() - 100U), std::bad_alloc);
}

}  // namespace
}  // namespace yars::memory
