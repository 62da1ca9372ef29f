#include <gtest/gtest.h>

#include "inputmonitor/device_decoder.hpp"
#include "tests/inputmonitor/device_support.hpp"

namespace yars::inputmonitor {
namespace {

using namespace testing;

TEST(RecordStream, RecordsAreWholeHoweverTheBytesAreCut) {
  const std::vector<RawEvent> sent{key(BTN_TRIGGER, 1), axis(ABS_X, -32768), kReport, key(0x2c0, 0)};
  const auto bytes = bytes_of(sent);
  for (std::size_t piece = 1; piece <= bytes.size(); ++piece) {
    RecordStream stream;
    std::vector<RawEvent> found;
    for (std::size_t at = 0; at < bytes.size(); at += piece)
      for (const RawEvent& event : stream.feed({bytes.data() + at, std::min(piece, bytes.size() - at)}))
        found.push_back(event);
    ASSERT_EQ(found.size(), sent.size()) << "pieces of " << piece;
    for (std::size_t i = 0; i < sent.size(); ++i) {
      EXPECT_EQ(found[i].type, sent[i].type);
      EXPECT_EQ(found[i].code, sent[i].code);
      EXPECT_EQ(found[i].value, sent[i].value);
    }
  }
}

TEST(RecordStream, HalfARecordIsForgottenWhenAnotherStreamBegins) {
  const auto bytes = bytes_of({key(BTN_TRIGGER, 1)});
  RecordStream stream;
  EXPECT_TRUE(stream.feed({bytes.data(), 10}).empty());
  stream.restart();
  EXPECT_EQ(stream.feed(bytes).size(), 1U);
}

}  // namespace
}  // namespace yars::inputmonitor
