// Lines about gateways that exchange nothing.
#include "gateway/dds/participants.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "databuffer/messages/note.hpp"

namespace yars::gateway::dds {
namespace {

TEST(SilenceOf, TheNoteFitsTheFlightRecorderAndSaysWhatToDo) {
  for (const bool secured : {false, true})
    for (const std::string& name : {std::string("b"), std::string(64, 'x')})
      for (const std::string& address : {std::string("192.168.100.200"), std::string(64, '1'), std::string()}) {
        const Remark remark = silence_of(name, address, secured);
        EXPECT_TRUE(remark.is_fault);
        EXPECT_LT(remark.note.size(), sizeof(databuffer::Note::text)) << remark.note;
        EXPECT_THAT(remark.note, ::testing::StartsWith(name.substr(0, 15)));
        EXPECT_THAT(remark.note, ::testing::EndsWith(" exchanges nothing: compare `security`, open UDP ports"));
      }
  EXPECT_EQ(silence_of("b", "192.168.10.2", true).note,
            "b (192.168.10.2) exchanges nothing: compare `security`, open UDP ports");
}

TEST(RejoinLimit, AllowsThreeAtOnceAndThenOneEveryTwoMinutes) {
  constexpr std::int64_t kMinute_ns = 60'000'000'000;
  RejoinLimit limit;
  for (int i = 0; i < RejoinLimit::kAtOnce; ++i) EXPECT_TRUE(limit.take(kMinute_ns));
  EXPECT_FALSE(limit.take(kMinute_ns));
  EXPECT_FALSE(limit.take(2 * kMinute_ns));
  EXPECT_TRUE(limit.take(3 * kMinute_ns));
  EXPECT_FALSE(limit.take(3 * kMinute_ns));
  for (int i = 0; i < RejoinLimit::kAtOnce; ++i) EXPECT_TRUE(limit.take(60 * kMinute_ns));
  EXPECT_FALSE(limit.take(60 * kMinute_ns));
}

}  // namespace
}  // namespace yars::gateway::dds
