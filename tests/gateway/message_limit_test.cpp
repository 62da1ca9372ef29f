// Messages of a library that others can make it write: what passes, what is counted, and that little waits.
#include "gateway/message_limit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace yars::gateway {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::int64_t kOneSecond_ns = 1'000'000'000;
constexpr std::int64_t kFloodBegin_ns = 40'000 * kOneSecond_ns;

TEST(MessageLimit, AFewMessagesPassAsTheyAre) {
  MessageLimit limit;
  limit.add("one", kFloodBegin_ns);
  limit.add("two", kFloodBegin_ns);
  EXPECT_THAT(limit.take("X", kFloodBegin_ns), ElementsAre("one", "two"));
  EXPECT_THAT(limit.take("X", kFloodBegin_ns + kOneSecond_ns), IsEmpty());
}

TEST(MessageLimit, AFloodGivesSomeLinesASecondAndItsCount) {
  MessageLimit limit;
  std::uint64_t lines = 0, counted = 0, sent = 0;
  constexpr int kSeconds = 100, kLooks = 2;
  for (int look = 0; look < kSeconds * kLooks; ++look) {
    const std::int64_t now_ns = kFloodBegin_ns + look * kOneSecond_ns / kLooks;
    for (int i = 0; i < 200; ++i) limit.add("malformed packet " + std::to_string(sent), now_ns), ++sent;
    for (const std::string& line : limit.take("X", now_ns)) {
      if (line.starts_with("malformed packet"))
        ++lines;
      else
        counted += std::stoull(line);
    }
  }
  EXPECT_LE(lines, 2U * kSeconds + MessageLimit::kBurst);
  EXPECT_GE(lines, 1U * kSeconds);
  for (const std::string& line : limit.take("X", kFloodBegin_ns + 1000 * kOneSecond_ns)) {
    EXPECT_THAT(line, ::testing::EndsWith(" more messages of X left out"));
    counted += std::stoull(line);
  }
  EXPECT_EQ(lines + counted, sent);
}

TEST(MessageLimit, AfterAPauseABurstPassesAgain) {
  MessageLimit limit;
  for (int i = 0; i < 100; ++i) limit.add("a" + std::to_string(i), kFloodBegin_ns);
  EXPECT_EQ(limit.take("X", kFloodBegin_ns).size(), MessageLimit::kBurst + 1);
  for (const char* text : {"b", "c", "d", "e"}) limit.add(text, kFloodBegin_ns + 60 * kOneSecond_ns);
  EXPECT_THAT(limit.take("X", kFloodBegin_ns + 60 * kOneSecond_ns), ElementsAre("b", "c", "d", "e"));
}

TEST(MessageLimit, TheSameMessageAppearsOnceAMinuteAndTheRestIsCounted) {
  MessageLimit limit;
  limit.add("no route to A", 0);  // before the first look at the clock
  for (int i = 0; i < 9; ++i) limit.add("no route to A", 0), limit.add("no route to B", 0);
  EXPECT_THAT(limit.take("X", kFloodBegin_ns),
              ElementsAre("no route to A", "no route to B", "17 more messages of X left out"));
  for (int second = 1; second < 60; ++second) {
    const std::int64_t now_ns = kFloodBegin_ns + second * kOneSecond_ns;
    limit.add("no route to A", now_ns);
    for (const std::string& line : limit.take("X", now_ns))
      EXPECT_THAT(line, ::testing::EndsWith(" more messages of X left out"));
  }
  limit.add("no route to A", kFloodBegin_ns + 61 * kOneSecond_ns);
  const auto taken = limit.take("X", kFloodBegin_ns + 61 * kOneSecond_ns);
  ASSERT_FALSE(taken.empty());
  EXPECT_EQ(taken.front(), "no route to A");
}

// A message has the text of a datagram in it.
TEST(MessageLimit, LittleWaitsAlsoWhenNobodyTakesIt) {
  MessageLimit limit;
  for (int second = 0; second < 1000; ++second)
    limit.add(std::to_string(second) + std::string(65'000, 'x'), kFloodBegin_ns + second * kOneSecond_ns);
  const auto taken = limit.take("X", kFloodBegin_ns + 1000 * kOneSecond_ns);
  EXPECT_EQ(taken.size(), MessageLimit::kBurst + 1);
  for (const std::string& text : taken) EXPECT_LE(text.size(), MessageLimit::kMaxLength + 4);
}

}  // namespace
}  // namespace yars::gateway
