// RepeatFilter: in each window of 10 s it passes the first lines of each kind, then suppresses and counts lines.
// Lines of one kind are equal apart from digits and the text after ", found".
#include <gtest/gtest.h>

#include <string>

#include "lib/log/log.hpp"

namespace yars::log {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

TEST(RepeatFilter, TheFirstLinesOfAKindPassAndTheRestIsCountedAndReportedOnce) {
  RepeatFilter filter(3, 100);
  int passed = 0;
  for (int i = 0; i < 1000; ++i)
    passed += filter.passes("ownship: latitude_deg: expected [-90, 90], found " + std::to_string(i * 1e300), i) ? 1 : 0;
  EXPECT_EQ(passed, 3);
  EXPECT_TRUE(filter.take_suppressed(9 * kSecond_ns).empty()) << "the window has not ended";
  const auto suppressed = filter.take_suppressed(11 * kSecond_ns);
  ASSERT_EQ(suppressed.size(), 1U);
  EXPECT_EQ(suppressed[0].count, 997U);
  EXPECT_NE(suppressed[0].text().find("(and 996 more suppressed)"), std::string::npos) << suppressed[0].text();
  EXPECT_TRUE(filter.take_suppressed(12 * kSecond_ns).empty()) << "reported once";
  EXPECT_TRUE(filter.passes("ownship: latitude_deg: expected [-90, 90], found 5", 12 * kSecond_ns));
}

TEST(RepeatFilter, AlternatingLinesAreTwoKinds) {
  RepeatFilter filter(3, 100);
  int passed = 0;
  for (int i = 0; i < 1000; ++i) passed += filter.passes(i % 2 == 0 ? "to here" : "to there", i) ? 1 : 0;
  EXPECT_EQ(passed, 6);
}

TEST(RepeatFilter, ALineEveryFourSecondsAlwaysPasses) {
  RepeatFilter filter(3, 100);
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(filter.passes("radar-model resumes", i * 4 * kSecond_ns)) << i;
}

// 10,000 lines of 10,000 kinds, as a sender outside of YARS could cause them.
TEST(RepeatFilter, ManyKindsAreBoundedInMemoryAndInLines) {
  RepeatFilter filter(3, 20);
  int passed = 0;
  for (int i = 0; i < 10'000; ++i) {
    std::string text = "event";
    for (int rest = i; rest > 0; rest /= 26) text += static_cast<char>('a' + rest % 26);
    passed += filter.passes(text, i * 1000) ? 1 : 0;
  }
  EXPECT_EQ(passed, 20);
  std::uint64_t suppressed = 0;
  for (const auto& lines : filter.take_suppressed(11 * kSecond_ns)) suppressed += lines.count;
  EXPECT_EQ(suppressed, 10'000U - 20U) << "each suppressed line is counted";
  EXPECT_LE(filter.take_suppressed(0, true).size(), RepeatFilter::kMaxKinds);
}

// Line of a kind of its own, for numbers 0 to 675.
std::string kind_number(int number) {
  return std::string("kind ") + static_cast<char>('a' + number / 26) + static_cast<char>('a' + number % 26);
}

// A new kind evicts the oldest kind. Each kind has a limit of its own.
TEST(RepeatFilter, AFullTableEvictsItsOldestKindAndKeepsItsCount) {
  constexpr int kKinds = 200;
  RepeatFilter filter(2, 10'000);
  int passed = 0;
  for (int number = 0; number < kKinds; ++number)
    for (int line = 0; line < 5; ++line) passed += filter.passes(kind_number(number), number) ? 1 : 0;
  EXPECT_EQ(passed, 2 * kKinds);
  EXPECT_FALSE(filter.passes(kind_number(kKinds - 1), kKinds)) << "still in the table and over its limit";
  EXPECT_TRUE(filter.passes(kind_number(0), kKinds)) << "evicted, so a new kind";
  const auto suppressed = filter.take_suppressed(11 * kSecond_ns);
  EXPECT_LE(suppressed.size(), RepeatFilter::kMaxKinds);
  std::uint64_t count = 0;
  for (const auto& lines : suppressed) count += lines.count;
  EXPECT_EQ(count, 3U * kKinds + 1U) << "each suppressed line is counted";
  EXPECT_TRUE(filter.take_suppressed(0, true).empty());
}

}  // namespace
}  // namespace yars::log
