// The beginning of a participant's GUID that its certificate's name gives.
#include <gtest/gtest.h>

#include "gateway/dds/topics.hpp"

namespace yars::gateway::dds {
namespace {

// The numbers come from: printf '\x30\x0c\x31\x0a\x30\x08\x06\x03\x55\x04\x03\x0c\x01\x61' | sha256sum; 13 for
// PrintableString.
TEST(GuidPrefix, IsTheHashOfTheSubjectNameMovedByOneBit) {
  EXPECT_EQ(guid_prefix_of("a", NameEncoding::utf8), (GuidPrefix{0x9b, 0xc0, 0x99, 0xf4, 0xcd, 0xc4}));
  EXPECT_EQ(guid_prefix_of("a", NameEncoding::printable), (GuidPrefix{0xde, 0x17, 0x00, 0x9a, 0x39, 0x79}));
}

}  // namespace
}  // namespace yars::gateway::dds
