// Tests of the GUF parser's errors. Each kind of syntax error is reported with file, line and column, what the parser
// expected and what it found.
#include <gmock/gmock.h>

#include <string>

#include "config/guf/parser.hpp"

namespace yars::config {
namespace {

struct Case {
  const char* name;
  std::string text;
  std::string message;
};

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

class SyntaxError : public ::testing::TestWithParam<Case> {};

TEST_P(SyntaxError, NamesPositionExpectationAndFinding) {
  const auto tree = parse_text(GetParam().text, "a.guf");
  ASSERT_FALSE(tree);
  EXPECT_EQ(tree.error().message(), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Guf, SyntaxError,
    ::testing::Values(
        Case{"FormNotClosed", "( A\n  :b 1\n", "a.guf:3:1: expected a value, a slot or ), found the end of the file"},
        Case{"ClosedTwice", "( A ) )", "a.guf:1:7: expected a form, a value, a slot or the end of the file, found )"},
        Case{"ListWithoutQuote", "( A :b ( 1 2 ) )",
             "a.guf:1:10: expected a name, found 1; a form is ( name ... ), a list is `( ... )"},
        Case{"FormWithoutName", "( )",
             "a.guf:1:3: expected a name, found ); a form is ( name ... ), a list is `( ... )"},
        Case{"SlotWithoutValue", "( A :b :c 1 )", "a.guf:1:8: expected a value for the slot, found :c"},
        Case{"SlotAtTheEnd", "( A :b )", "a.guf:1:8: expected a value for the slot, found )"},
        Case{"QuoteBeforeNumber", "( A '1 )", "a.guf:1:6: expected ( or an identifier after the quote, found 1"},
        Case{"BracesNotClosed", "{ 1 2 )", "a.guf:1:7: expected a value or }, found )"},
        Case{"StringNotClosed", "( A\n \"abc )\n )",
             "a.guf:2:2: expected a closing \" on the same line, found \"abc )"},
        Case{"UnknownEscape", R"("a\qb")",
             R"(a.guf:1:1: expected one of \" \\ \n \t \xHH after a backslash, found \q)"},
        Case{"HalfAnEscape", R"("a\x4")", R"(a.guf:1:1: expected one of \" \\ \n \t \xHH after a backslash, found \x)"},
        Case{"NumberWithLetters", "( A 12px )", "a.guf:1:5: expected a number, found 12px"},
        Case{"TwoPoints", "1.2.3", "a.guf:1:1: expected a number, found 1.2.3"},
        Case{"NumberTooLarge", "1e999",
             "a.guf:1:1: expected a number between 2.3e-308 and 1.7e308 in magnitude, or 0, found 1e999"},
        Case{"PositionZero", "( A :0 1 )", "a.guf:1:5: expected a slot position of 1 or more, found :0"},
        Case{"PositionTooLarge", "( A :99999999999 1 )",
             "a.guf:1:5: expected a slot position of 1 or more, found :99999999999"},
        Case{"NamedSlotInList", "`( 1 :a 2 )", "a.guf:1:6: expected values by position in a list, found the slot :a"},
        Case{"PositionOutOfOrderInList", "`( 1 :3 2 )", "a.guf:1:6: expected position :2 here in the list, found :3"},
        Case{"StrayCharacter", "( A\n   #include )", "a.guf:2:4: expected a form, a value or a slot, found #"},
        Case{"ControlCharacter", std::string("1 \x01", 3),
             "a.guf:1:3: expected a form, a value or a slot, found <0x01>"},
        Case{"ZeroByte", std::string("1 \0 2", 5), "a.guf:1:3: expected a form, a value or a slot, found <0x00>"},
        Case{"TooDeep", repeated("( A ", 65),
             "a.guf:1:257: expected at most 64 brackets open at once, found one more; close a form before this one"},
        Case{"TooManyWords", repeated("1 ", 200'001),
             "a.guf:1:400000: expected at most 200000 words in a file, found more; split the file"},
        Case{"TooLarge", std::string((1U << 20U) + 1, ' '),
             "a.guf: expected at most 1048576 bytes in a file, found 1048577; split the file"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(SyntaxLimits, TextsWithinTheLimitsAreRead) {
  EXPECT_TRUE(parse_text(repeated("( A ", 64) + repeated(")", 64), "a.guf"));
  EXPECT_TRUE(parse_text(repeated("1 ", 199'999), "a.guf"));
  EXPECT_TRUE(parse_text(std::string(1U << 20U, ' '), "a.guf"));
}

}  // namespace
}  // namespace yars::config
