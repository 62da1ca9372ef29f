// printable(): text from outside with control characters and invalid UTF-8 escaped, safe for terminals and logs.
#include <gtest/gtest.h>

#include "lib/error/error.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::text {
namespace {

TEST(Printable, TextWithoutControlCharactersIsUnchanged) {
  for (const char* text : {"", "plain", "Zürich 東京 🛩", "a\\b"}) EXPECT_EQ(printable(text), text);
}

TEST(Printable, ControlCharactersAreEscaped) {
  EXPECT_EQ(printable("\x1b[31mred\x07"), "\\x1b[31mred\\x07");
  EXPECT_EQ(printable("a\nb\tc\r\x7f"), "a\\nb\\tc\\x0d\\x7f");
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
  EXPECT_EQ(printable("\u009b31m"), "\\xc2\\x9b31m") << "the control sequence introducer of ISO 6429 in one character";
  EXPECT_EQ(printable("a\u202eb"), "a\\xe2\\x80\\xaeb") << "right-to-left override";
}

TEST(Printable, InvalidUtf8IsEscaped) {
  EXPECT_EQ(printable("\x9b"
                      "31m"),
            "\\x9b31m");
  EXPECT_EQ(printable("\xc3"), "\\xc3");
  EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b") << "overlong encoding";
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "one surrogate of a pair";
  EXPECT_EQ(printable("\xf8\x88\x80\x80\x80"), "\\xf8\\x88\\x80\\x80\\x80");
}

TEST(Printable, PrintableLinesKeepsLineEndsAndTabs) {
  EXPECT_EQ(printable_lines("a\n\tb\x1b"), "a\n\tb\\x1b");
}

TEST(Printable, UnfinishedBytesCountsAnIncompleteCharacterAtTheEnd) {
  EXPECT_EQ(unfinished_bytes("abc"), 0U);
  EXPECT_EQ(unfinished_bytes("ab\xc3"), 1U);
  EXPECT_EQ(unfinished_bytes("ab\xe6\x9d"), 2U);
  EXPECT_EQ(unfinished_bytes("ab\xf0\x9f\x9b"), 3U);
  EXPECT_EQ(unfinished_bytes("東"), 0U);
  EXPECT_EQ(unfinished_bytes("\x80\x80\x80"), 0U);
}

TEST(Printable, AnErrorIsOneLineForAnyFileName) {
  const error::Error error{"evil\n\x1b[2J.dt1", "a cell", "none", ""};
  EXPECT_EQ(error.message(), "evil\\n\\x1b[2J.dt1: expected a cell, found none");
}

TEST(Shortened, ALongTextIsCutBehindACharacterAndTellsItsLength) {
  EXPECT_EQ(shortened(std::string(500, 'x')), std::string(500, 'x'));
  EXPECT_EQ(shortened(std::string(70'000, 'x')), std::string(500, 'x') + "... (70000 bytes)");
  std::string umlauts = "x";
  for (int i = 0; i < 300; ++i) umlauts += "ä";
  EXPECT_EQ(shortened(umlauts), umlauts.substr(0, 499) + "... (601 bytes)");
  const error::Error error{std::string(70'000, 'a'), "a cell", std::string(70'000, 'b'), ""};
  EXPECT_LT(error.message().size(), 1'200U);
}

}  // namespace
}  // namespace yars::text
