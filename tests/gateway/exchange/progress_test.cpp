// What a gateway leaves in the segment for the next one.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>

#include "gateway/exchange/history_progress.hpp"
#include "tests/gateway/random_seed.hpp"

namespace yars::gateway {
namespace {

// `local`: records in the container before record `next - 1` of the source was to be written.
TEST(Progress, AfterTheEntryTheRecordIsMissing) {
  EXPECT_EQ(next_of(progress_of(10, 4), 4, 9), 9u);
}

TEST(Progress, AfterTheRecordTheNextOneFollows) {
  EXPECT_EQ(next_of(progress_of(10, 4), 5, 9), 10u);
}

TEST(Progress, LocalRecordsSinceThenDoNotMatter) {
  EXPECT_EQ(next_of(progress_of(10, 4), 400, 9), 10u);
}

TEST(Progress, TheFirstRecordMayBeMissing) {
  EXPECT_EQ(next_of(progress_of(1, 0), 0, 0), 0u);
  EXPECT_EQ(next_of(progress_of(1, 0), 1, 0), 1u);
}

TEST(Progress, NumbersMayBeGreaterThan32Bits) {
  const std::uint64_t seed = testing::random_seed();
  SCOPED_TRACE("YARS_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int run = 0; run < 100'000; ++run) {
    // Half of the numbers are near a multiple of 2^32.
    const auto number = [&] { return run % 2 == 0 ? random() >> 8 : (random() >> 40 << 32) + random() % 8 - 4; };
    const std::uint64_t next = (number() | 1U) & (~std::uint64_t{0} >> 1), local = number();
    const std::uint64_t near = next + random() % 2000 - 1000;
    EXPECT_EQ(next_of(progress_of(next, local), local, near), next - 1);
    EXPECT_EQ(next_of(progress_of(next, local), local + 1 + random() % 1000, near), next);
  }
}

TEST(Progress, EachSourceKeepsItsEntryAndTheTableStaysFull) {
  std::array<databuffer::RemoteProgress, 4> entries{};
  for (std::uint64_t source = 1; source <= 4; ++source) {
    auto& entry = entry_of(entries, source);
    EXPECT_EQ(entry.source.load(), 0u);
    entry.source.store(source);
  }
  for (std::uint64_t source = 1; source <= 4; ++source) EXPECT_EQ(entry_of(entries, source).source.load(), source);
  EXPECT_EQ(&entry_of(entries, 5), &entries[1]) << "the fifth takes one of them";
}

}  // namespace
}  // namespace yars::gateway
