// Messages of errors, Expected with a value or an error, and YARS_REQUIRE, which prints both values when it fails.
#include "lib/error/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace yars::error {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Error, TheMessageIsOneLineWithPlaceExpectedFoundAndAdvice) {
  const Error error{"route.csv:3", "a latitude", "\"north\"", "give degrees"};
  const std::string message = error.message();
  for (const char* part : {"route.csv:3", "a latitude", "\"north\"", "give degrees"})
    EXPECT_THAT(message, HasSubstr(part));
  EXPECT_THAT(message, Not(HasSubstr("\n")));
}

Expected<int> positive(int value) {
  if (value <= 0) return fail("value", "above 0", std::to_string(value));
  return value;
}

TEST(Expected, CarriesAValueOrAnError) {
  EXPECT_EQ(positive(3).value(), 3);
  ASSERT_FALSE(positive(-4));
  EXPECT_EQ(positive(-4).error().found, "-4");
}

TEST(Require, DoesNothingWhenTheConditionHolds) {
  YARS_REQUIRE(1 + 1, ==, 2);
}

TEST(RequireDeathTest, EndsTheProcessWithBothValues) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_DEATH(YARS_REQUIRE(40 + 1, ==, 42), "41 and 42");
}

}  // namespace
}  // namespace yars::error
