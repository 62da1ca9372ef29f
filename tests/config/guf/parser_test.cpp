// Tests of the GUF parser: values, lists, forms, positions in the text, and the spellings of 1996.
#include "config/guf/parser.hpp"

#include <gmock/gmock.h>

namespace yars::config {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<Slot> parsed(const std::string& text) {
  const auto tree = parse_text(text, "text.guf");
  EXPECT_TRUE(tree) << tree.error().message();
  return tree ? tree->arguments : std::vector<Slot>{};
}

// The value of a text that consists of one value.
Value value_of(const std::string& text) {
  auto arguments = parsed(text);
  EXPECT_EQ(arguments.size(), 1U) << text;
  return arguments.empty() ? Value{} : arguments[0].value;
}

// The value of a text that consists of one value of this type.
template <class Type>
Type value_as(const std::string& text) {
  const Value value = value_of(text);
  EXPECT_TRUE(std::holds_alternative<Type>(value.data)) << text;
  return std::holds_alternative<Type>(value.data) ? std::get<Type>(value.data) : Type{};
}

std::vector<double> numbers(const std::string& text) {
  std::vector<double> found;
  for (const Value& item : value_as<List>(text).items) found.push_back(std::get<double>(item.data));
  return found;
}

TEST(GufValues, NumbersHaveSignFractionAndExponent) {
  EXPECT_EQ(value_as<double>("480"), 480.0);
  EXPECT_EQ(value_as<double>("-0.6"), -0.6);
  EXPECT_EQ(value_as<double>("+2.5"), 2.5);
  EXPECT_EQ(value_as<double>(".5"), 0.5);
  EXPECT_EQ(value_as<double>("4."), 4.0);
  EXPECT_EQ(value_as<double>("1.5e3"), 1500.0);
  EXPECT_EQ(value_as<double>("25E-1"), 2.5);
}

TEST(GufValues, TrueAndFalseAreBooleansInUpperAndLowerCase) {
  EXPECT_TRUE(value_as<bool>("true"));
  EXPECT_TRUE(value_as<bool>("TRUE"));
  EXPECT_FALSE(value_as<bool>("false"));
  EXPECT_FALSE(value_as<bool>("FALSE"));
}

TEST(GufValues, StringsTakeEscapes) {
  EXPECT_EQ(value_as<std::string>(R"("doublebuffer")"), "doublebuffer");
  EXPECT_EQ(value_as<std::string>(R"("a \"b\" \\ \n\t")"), "a \"b\" \\ \n\t");
  EXPECT_EQ(value_as<std::string>(R"("")"), "");
  EXPECT_EQ(value_as<std::string>(R"("; no // comment")"), "; no // comment");
}

TEST(GufValues, IdentifiersMayContainHyphensAndBeQuoted) {
  EXPECT_EQ(value_as<Identifier>("hard-edge").name, "hard-edge");
  EXPECT_EQ(value_as<Identifier>("'alpha").name, "alpha");
  EXPECT_EQ(value_as<Identifier>("`alpha").name, "alpha");
}

TEST(GufLists, HaveThreeEqualSpellings) {
  EXPECT_THAT(numbers("( guf 1 2 3 )"), ElementsAre(1, 2, 3));
  EXPECT_THAT(numbers("`( 1 2 3 )"), ElementsAre(1, 2, 3));
  EXPECT_THAT(numbers("'( 1 2 3 )"), ElementsAre(1, 2, 3));
  EXPECT_THAT(numbers("`()"), IsEmpty());
}

TEST(GufLists, HoldFormsAndLists) {
  const List list = value_as<List>("`( ( A 1 ) `( 2 ) \"x\" )");
  ASSERT_EQ(list.items.size(), 3U);
  EXPECT_EQ(std::get<Form>(list.items[0].data).name, "A");
  EXPECT_EQ(std::get<List>(list.items[1].data).items.size(), 1U);
}

TEST(GufLists, AcceptItemsByPositionNumber) {
  EXPECT_THAT(numbers("`( :1 7 8 :3 9 )"), ElementsAre(7, 8, 9));
}

TEST(GufForms, KeepSlotsInOrderByNameAndByPosition) {
  const Form form = value_as<Form>("( rgb 0.5 :2 0.6 :blue 0.7 )");
  EXPECT_EQ(form.name, "rgb");
  ASSERT_EQ(form.slots.size(), 3U);
  EXPECT_EQ(form.slots[0].name, "");
  EXPECT_EQ(form.slots[0].position, 0);
  EXPECT_EQ(form.slots[1].position, 2);
  EXPECT_EQ(form.slots[2].name, "blue");
  EXPECT_EQ(std::get<double>(form.slots[2].value.data), 0.7);
}

TEST(GufForms, RecordThePositionOfEachPart) {
  const auto arguments = parsed("; first\n( A\n  :b 1\n\t( C ) )");
  const Value value = arguments[0].value;
  EXPECT_EQ(text_of(value.where), "text.guf:2:1");
  const Form& form = std::get<Form>(value.data);
  EXPECT_EQ(text_of(form.slots[0].where), "text.guf:3:3");
  EXPECT_EQ(text_of(form.slots[0].value.where), "text.guf:3:6");
  EXPECT_EQ(text_of(form.slots[1].where), "text.guf:4:2");
}

TEST(GufText, CountsACharacterOfSeveralBytesAsOneColumn) {
  const auto arguments = parsed("\"\xC3\xA4\xE2\x82\xAC\" 1");
  EXPECT_EQ(text_of(arguments[1].where), "text.guf:1:6");
}

TEST(GufText, SkipsCommentsOfBothKindsAndAByteOrderMark) {
  EXPECT_EQ(value_as<double>("\xEF\xBB\xBF; one\n// two\n7 ; three"), 7.0);
  EXPECT_THAT(parsed("; nothing else"), IsEmpty());
}

TEST(GufText, AcceptsLineEndsWithCarriageReturn) {
  const auto arguments = parsed("1\r\n2\r\n");
  ASSERT_EQ(arguments.size(), 2U);
  EXPECT_EQ(text_of(arguments[1].where), "text.guf:2:1");
}

std::vector<std::string> warnings_of(const std::string& text) {
  const auto tree = parse_text(text, "text.guf");
  EXPECT_TRUE(tree) << tree.error().message();
  return tree ? tree->warnings : std::vector<std::string>{};
}

TEST(GufOldSpellings, BracesAreAListAndTheWarningShowsTheModernSpelling) {
  EXPECT_THAT(numbers("{ 100, 50, 25 }"), ElementsAre(100, 50, 25));
  EXPECT_THAT(warnings_of("{ 100 50 25 }"), ElementsAre(HasSubstr("text.guf:1:1: { }")));
  EXPECT_THAT(warnings_of("{ 100 50 25 }")[0], HasSubstr("write `( 100 50 25 )"));
}

TEST(GufOldSpellings, CommasWarnOncePerFile) {
  EXPECT_THAT(warnings_of("`( 1, 2, 3 )"), ElementsAre("text.guf:1:5: a comma is the spelling of 1996; write a space"));
}

TEST(GufOldSpellings, ATrailingColonNamesASlotAndTheWarningShowsTheModernSpelling) {
  const Form form = value_as<Form>("( Window width: 480 )");
  EXPECT_EQ(form.slots[0].name, "width");
  EXPECT_THAT(warnings_of("( Window width: 480 )"),
              ElementsAre("text.guf:1:10: width: is the spelling of 1996; write :width"));
}

TEST(GufOldSpellings, ModernTextHasNoWarning) {
  EXPECT_THAT(warnings_of("( Window :width 480 )"), IsEmpty());
}

TEST(GufWriter, NumbersReadBackEqual) {
  for (const double number : {0.0, -60.0, 0.1, 4.0 / 3.0, 100'000.0, 1e-7, 1.7976931348623157e308, 5e-1}) {
    EXPECT_EQ(value_as<double>(number_text(number)), number) << number_text(number);
  }
  EXPECT_EQ(number_text(100'000.0), "100000");
}

TEST(GufWriter, StringsReadBackEqual) {
  const std::string text = "tab\t, quote \", backslash \\, line\n, \xC3\xA4";
  EXPECT_EQ(value_as<std::string>(quoted_text(text)), text);
  // Printed with escapes: what would control a terminal, and what is no UTF-8.
  const std::string controls = "\x1b[31m, \xE2\x80\xAE, \xE2\x80\x8B, \x7f, \xff\xfe, \r";
  EXPECT_EQ(value_as<std::string>(quoted_text(controls)), controls);
  EXPECT_EQ(quoted_text("\x1b"), R"("\x1b")");
}

}  // namespace
}  // namespace yars::config
