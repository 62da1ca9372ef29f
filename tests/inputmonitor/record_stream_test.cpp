// RecordStream: raw events from a stream of bytes that is cut anywhere.
#include <gtest/gtest.h>

#include "inputmonitor/device_decoder.hpp"
#include "tests/inputmonitor/device_support.hpp"

namespace yars::inputmonitor {
namespace {

using namespace testing;

TEST(RecordStream, RecordsAreCompleteForAnyLengthOfFragments) {
  const std::vector<RawEvent> sent{key(BTN_TRIGGER, 1), axis(ABS_X, -32768), kReport, key(0x2c0, 0)};
  const auto bytes = bytes_of(sent);
  for (std::size_t length = 1; length <= bytes.size(); ++length) {
    RecordStream stream;
    std::vector<RawEvent> found;
    for (std::size_t at = 0; at < bytes.size(); at += length)
      for (const RawEvent& event : stream.feed({bytes.data() + at, std::min(length, bytes.size() - at)}))
        found.push_back(event);
    ASSERT_EQ(found.size(), sent.size()) << "bytes in a fragment: " << length;
    for (std::size_t i = 0; i < sent.size(); ++i) {
      EXPECT_EQ(found[i].type, sent[i].type);
      EXPECT_EQ(found[i].code, sent[i].code);
      EXPECT_EQ(found[i].value, sent[i].value);
    }
  }
}

TEST(RecordStream, RestartDiscardsAnIncompleteRecord) {
  const auto bytes = bytes_of({key(BTN_TRIGGER, 1)});
  RecordStream stream;
  EXPECT_TRUE(stream.feed({bytes.data(), 10}).empty());
  stream.restart();
  EXPECT_EQ(stream.feed(bytes).size(), 1U);
}

}  // namespace
}  // namespace yars::inputmonitor
