// Repeated and lost samples of one host and topic.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "gateway/sample_reception.hpp"
#include "tests/gateway/random_seed.hpp"

namespace yars::gateway {
namespace {

TEST(SampleNumbers, TheFirstSampleMayHaveAnyNumber) {
  SampleNumbers numbers;
  EXPECT_TRUE(numbers.is_new(7, 100));
  EXPECT_EQ(numbers.lost(), 0u) << "samples before this host joined are no loss";
  EXPECT_EQ(numbers.next(), 101u);
}

TEST(SampleNumbers, AHistoryThatComesAgainIsLeftOut) {
  SampleNumbers numbers;
  for (std::uint64_t number = 0; number < 100; ++number) EXPECT_TRUE(numbers.is_new(7, number));
  for (std::uint64_t number = 20; number < 100; ++number) EXPECT_FALSE(numbers.is_new(7, number));
  EXPECT_EQ(numbers.repeated(), 80u);
  EXPECT_EQ(numbers.received(), 100u);
  EXPECT_TRUE(numbers.is_new(7, 100));
}

TEST(SampleNumbers, AGapIsCounted) {
  SampleNumbers numbers;
  numbers.is_new(7, 0);
  EXPECT_TRUE(numbers.is_new(7, 5));
  EXPECT_EQ(numbers.lost(), 4u);
}

TEST(SampleNumbers, ANewProcessBeginsAnewAndSamplesOfItsPredecessorAreLate) {
  SampleNumbers numbers;
  numbers.is_new(7, 500);
  EXPECT_TRUE(numbers.is_new(8, 0));
  EXPECT_EQ(numbers.lost(), 0u);
  EXPECT_FALSE(numbers.is_new(7, 501)) << "of a process that has ended";
  EXPECT_TRUE(numbers.is_new(8, 1));
  EXPECT_TRUE(numbers.is_new(9, 0));
  EXPECT_FALSE(numbers.is_new(8, 2));
}

TEST(SampleNumbers, TheFirstProcessMayHaveTheNumberZero) {
  SampleNumbers numbers;
  EXPECT_TRUE(numbers.is_new(0, 0));
  EXPECT_TRUE(numbers.is_new(0, 1));
  EXPECT_TRUE(numbers.is_new(1, 0));
  EXPECT_FALSE(numbers.is_new(0, 2));
}

TEST(SampleNumbers, TheGreatestNumberIsNoNumber) {
  SampleNumbers numbers;
  constexpr std::uint64_t kLastNumber = std::numeric_limits<std::uint64_t>::max();
  EXPECT_TRUE(numbers.is_new(7, kLastNumber - 1));
  EXPECT_FALSE(numbers.is_new(7, kLastNumber)) << "after it all samples would be new again";
  EXPECT_FALSE(numbers.is_new(7, 0));
  EXPECT_FALSE(numbers.is_new(8, kLastNumber));
}

// Any order of arrival, with repetitions: no number is new twice, and the counts add up.
TEST(SampleNumbers, NoSampleIsNewTwice) {
  const std::uint64_t seed = testing::random_seed();
  SCOPED_TRACE("YARS_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int run = 0; run < 300; ++run) {
    SampleNumbers numbers;
    std::set<std::uint64_t> taken;
    std::uint64_t arrived = 0, greatest = 0, first = 0;
    for (; arrived < 200; ++arrived) {
      const std::uint64_t number = random() % 300;
      if (arrived == 0) first = number;
      greatest = std::max(greatest, number);
      EXPECT_TRUE(!numbers.is_new(3, number) || taken.insert(number).second);
    }
    EXPECT_EQ(numbers.received(), taken.size());
    EXPECT_EQ(numbers.received() + numbers.repeated(), arrived);
    EXPECT_EQ(numbers.received() + numbers.lost(), greatest - first + 1);
  }
}

// A forged or damaged number must not silence a host for ever.
TEST(SampleNumbers, ANumberFarAheadCountsOnlyWhenOthersFollowIt) {
  SampleNumbers numbers;
  for (std::uint64_t number = 0; number < 10; ++number) EXPECT_TRUE(numbers.is_new(1, number));
  EXPECT_FALSE(numbers.is_new(1, 1'000'000'000));
  EXPECT_TRUE(numbers.is_new(1, 10)) << "the sequence goes on";
  EXPECT_EQ(numbers.lost(), 0u);
  EXPECT_FALSE(numbers.is_new(1, 5'000'000));
  EXPECT_FALSE(numbers.is_new(1, 5'000'001));
  EXPECT_TRUE(numbers.is_new(1, 5'000'002)) << "after a long cut";
  EXPECT_EQ(numbers.next(), 5'000'003u);
}

TEST(SampleNumbers, AfterAForgedNumberTheTrueSequenceIsTakenAgain) {
  SampleNumbers numbers;
  constexpr std::uint64_t kRepeats = 8;
  EXPECT_TRUE(numbers.is_new(1, 100, kRepeats));
  EXPECT_TRUE(numbers.is_new(1, 60'000, kRepeats)) << "not far enough to be refused";
  for (std::uint64_t number = 101; number < 101 + kRepeats; ++number) EXPECT_FALSE(numbers.is_new(1, number, kRepeats));
  EXPECT_TRUE(numbers.is_new(1, 101 + kRepeats, kRepeats));
  EXPECT_TRUE(numbers.is_new(1, 102 + kRepeats, kRepeats));
}

}  // namespace
}  // namespace yars::gateway
