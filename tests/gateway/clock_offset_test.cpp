// Offset between two clocks over a simulated network with different delays there and back.
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <random>
#include <string>

#include "gateway/host_agreement.hpp"
#include "tests/gateway/random_seed.hpp"

namespace yars::gateway {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kGreatest = std::numeric_limits<std::int64_t>::max();

class OffsetProperty : public ::testing::Test {
 protected:
  std::int64_t up_to(std::int64_t limit) {
    return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(limit + 1));
  }
  const std::uint64_t seed_ = testing::random_seed();
  const ::testing::ScopedTrace trace_{__FILE__, __LINE__, "YARS_SEED=" + std::to_string(seed_)};
  std::mt19937_64 random_{seed_};
};

TEST_F(OffsetProperty, TheErrorIsAtMostHalfOfTheRoundTrip) {
  for (int run = 0; run < 200; ++run) {
    const std::int64_t offset_ns = up_to(400'000 * kSecond_ns) - 200'000 * kSecond_ns;
    const std::int64_t most_ns = 1 + up_to(100'000'000);
    std::int64_t now_ns = 300'000 * kSecond_ns;
    OffsetEstimator estimator;
    for (int answer = 0; answer < 40; ++answer) {
      ProbeTimes times;
      times.asked_ns = now_ns;
      times.received_ns = (now_ns += up_to(most_ns)) + offset_ns;
      times.answered_ns = (now_ns += up_to(50'000)) + offset_ns;
      times.returned_ns = now_ns += up_to(most_ns / 4);
      ASSERT_TRUE(estimator.add(times));
      const auto best = estimator.best();
      ASSERT_TRUE(best);
      EXPECT_LE(std::abs(best->offset_ns - offset_ns), best->round_trip_ns / 2 + 2) << "rounded twice";
      EXPECT_LE(best->round_trip_ns, 2 * estimator.latency_ns() + 1) << "the best is no worse than the last";
      now_ns += kSecond_ns / 4;
    }
    EXPECT_EQ(estimator.count(), 40u);
  }
}

TEST_F(OffsetProperty, ASlewedOffsetMovesSlowlyAndArrives) {
  SlewedOffset slewed;
  std::int64_t measured_ns = 5'000'000;
  for (int pass = 0; pass < 40'000; ++pass) {
    if (pass < 2000) measured_ns += up_to(20'000) - 10'000;
    const std::int64_t before_ns = slewed.offset_ns();
    const std::int64_t elapsed_ns = up_to(10'000'000);
    slewed.approach(measured_ns, elapsed_ns);
    const bool is_far = std::abs(measured_ns - before_ns) > 2'000'000;
    EXPECT_LE(std::abs(slewed.offset_ns() - before_ns), elapsed_ns / (is_far ? 100 : 1000));
  }
  EXPECT_LE(std::abs(slewed.offset_ns() - measured_ns), 50'000);
}

TEST(SlewedOffset, NoiseBelow50MicrosecondsMovesNothing) {
  SlewedOffset slewed;
  slewed.set(1'000'000);
  EXPECT_FALSE(slewed.approach(1'049'000, kSecond_ns));
  EXPECT_EQ(slewed.offset_ns(), 1'000'000);
  EXPECT_TRUE(slewed.approach(1'051'000, kSecond_ns));
  EXPECT_EQ(slewed.offset_ns(), 1'051'000) << "never beyond the measured value";
}

TEST(SlewedOffset, AnyMeasuredOffsetIsFollowedWithoutOverflow) {
  constexpr std::int64_t kMost_ns = std::int64_t{1} << 61;  // an estimate is never greater
  SlewedOffset slewed;
  slewed.set(-kMost_ns);
  EXPECT_TRUE(slewed.approach(kMost_ns, 5'000'000));
  EXPECT_EQ(slewed.offset_ns(), -kMost_ns + 50'000);
}

// Times of another host may be any numbers. Run with -fsanitize=undefined (preset asan) this finds overflows.
TEST(OffsetEstimator, ExtremeTimesDoNotOverflow) {
  for (const std::int64_t asked : {kLeast, std::int64_t{-1}, std::int64_t{0}, kSecond_ns, kGreatest - 1, kGreatest})
    for (const std::int64_t received : {kLeast, std::int64_t{-1}, std::int64_t{0}, kGreatest / 4, kGreatest})
      for (const std::int64_t answered : {kLeast, std::int64_t{-1}, std::int64_t{0}, kGreatest / 4 + 1, kGreatest})
        for (const std::int64_t returned : {std::int64_t{0}, 2 * kSecond_ns, kGreatest}) {
          OffsetEstimator estimator;
          if (!estimator.add({asked, received, answered, returned})) {
            EXPECT_FALSE(estimator.best());
            continue;
          }
          EXPECT_GE(estimator.best()->round_trip_ns, 0);
          EXPECT_LE(estimator.best()->round_trip_ns, 2 * kSecond_ns);
        }
}

TEST(OffsetEstimator, NoOffsetIsGreaterThan18Years) {
  OffsetEstimator estimator;
  EXPECT_FALSE(estimator.add({1000, (std::int64_t{1} << 59) + 1, (std::int64_t{1} << 59) + 1, 2000}));
  ASSERT_TRUE(estimator.add({1000, std::int64_t{1} << 59, std::int64_t{1} << 59, 2000}));
  EXPECT_LE(estimator.best()->offset_ns, std::int64_t{1} << 59);
}

TEST(OffsetEstimator, TimesThatContradictEachOtherAreLeftOut) {
  OffsetEstimator estimator;
  EXPECT_FALSE(estimator.add({1000, 5000, 6000, 900})) << "returned before it was asked";
  EXPECT_FALSE(estimator.add({1000, 6000, 5000, 2000})) << "answered before it was received";
  EXPECT_FALSE(estimator.add({1000, 5000, 9000, 2000})) << "the answer took longer than the round trip";
  EXPECT_FALSE(estimator.add({0, 5000, 6000, 3 * kSecond_ns})) << "an answer from a time long past";
  EXPECT_FALSE(estimator.best());
  EXPECT_EQ(estimator.latency_ns(), 0);
}

TEST(OffsetEstimator, AnOldAnswerIsForgottenSoThatADriftingClockIsFollowed) {
  OffsetEstimator estimator;
  ASSERT_TRUE(estimator.add({1000, 1050, 1050, 1100}));  // the best round trip, of a clock with offset 0
  std::int64_t asked_ns = kSecond_ns;
  for (int answer = 0; answer < 16; ++answer, asked_ns += kSecond_ns)
    ASSERT_TRUE(estimator.add({asked_ns, asked_ns + 500'100, asked_ns + 500'100, asked_ns + 200}));
  EXPECT_EQ(estimator.best()->offset_ns, 500'000);
}

}  // namespace
}  // namespace yars::gateway
