// Lines, words, fields and numbers of plain text; reading of text files.
#include "lib/text/plain_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "lib/file/text_file.hpp"

namespace yars::text {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(PlainText, CommentsAndEmptyLinesCountButAreNotReturned) {
  const auto lines = numbered_lines("# head\n\n  one 1 # tail\r\ntwo\n   # only\nthree");
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].number, 3);
  EXPECT_EQ(lines[0].text, "one 1");
  EXPECT_EQ(lines[1].number, 4);
  EXPECT_EQ(lines[2].number, 6);
  EXPECT_EQ(lines[2].text, "three");
}

TEST(PlainText, TextWithoutContentHasNoLines) {
  EXPECT_TRUE(numbered_lines("").empty());
  EXPECT_TRUE(numbered_lines("\n\n# x").empty());
}

TEST(PlainText, WordsAreSeparatedByBlanksAndTabs) {
  EXPECT_THAT(words_of("  a\tbc  d "), ElementsAre("a", "bc", "d"));
  EXPECT_TRUE(words_of(" \t").empty());
}

TEST(PlainText, FieldsMayBeEmpty) {
  EXPECT_THAT(fields_of("a, b ,,c,", ','), ElementsAre("a", "b", "", "c", ""));
  EXPECT_THAT(fields_of("", ','), ElementsAre(""));
}

TEST(PlainText, AFiniteNumberFillsItsWord) {
  EXPECT_EQ(finite_number("-12.5"), -12.5);
  EXPECT_EQ(finite_number("+3e2"), 300.0);
  for (const auto* word : {"", "+", "-", "1x", "x1", "nan", "inf", "-inf", "1e999", "+-1", "--1", "1 2", "0x10"})
    EXPECT_EQ(finite_number(word), std::nullopt) << word;
}

TEST(PlainText, AnIntegerFillsItsWordAndFitsItsType) {
  EXPECT_EQ(whole_number<int>("-12"), -12);
  EXPECT_EQ(whole_number<std::uint16_t>("ffff", 16), 0xFFFF);
  for (const auto* word : {"", "-", "+1", " 1", "1 ", "1.0", "1x", "128", "-129"})
    EXPECT_EQ(whole_number<std::int8_t>(word), std::nullopt) << word;
  EXPECT_EQ(whole_number<unsigned>("-1"), std::nullopt);
}

TEST(PlainText, ANumberIsUnchangedAfterConversionToTextAndBack) {
  for (const double value : {0.1, -1.0 / 3.0, 1e-300, 123456789.125, 5e-324}) {
    EXPECT_EQ(finite_number(text_of_number(value)), value);
  }
}

TEST(PlainText, ACountHasItsNounInTheSingularOrThePlural) {
  EXPECT_EQ(counted(0, "warning"), "0 warnings");
  EXPECT_EQ(counted(1, "warning"), "1 warning");
  EXPECT_EQ(counted(2, "warning"), "2 warnings");
  EXPECT_EQ(counted(1, "vertex", "vertices"), "1 vertex");
  EXPECT_EQ(counted(3, "vertex", "vertices"), "3 vertices");
}

TEST(TextFile, IsReadCompletelyAndErrorsNameTheReason) {
  const auto path = std::filesystem::temp_directory_path() / ("yars_text_file_test_" + std::to_string(::getpid()));
  std::ofstream(path) << "one\ntwo\n";
  EXPECT_EQ(file::read_text_file(path).value(), "one\ntwo\n");
  std::filesystem::remove(path);
  const auto absent = file::read_text_file(path);
  ASSERT_FALSE(absent);
  EXPECT_THAT(absent.error().message(), HasSubstr(path.string()));
  const auto folder = file::read_text_file(std::filesystem::temp_directory_path());
  ASSERT_FALSE(folder);
  EXPECT_THAT(folder.error().message(), HasSubstr("folder"));
}

}  // namespace
}  // namespace yars::text
