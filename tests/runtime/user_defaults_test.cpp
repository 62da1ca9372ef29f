// The user's file of defaults: values, and the error of each kind of bad line.
#include "runtime/user_defaults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace yars::runtime {
namespace {

using ::testing::HasSubstr;

std::string fault_of(const std::string& text) {
  const auto parsed = parse_user_defaults(text, "yars.conf", "/users/pilot");
  return parsed ? "none" : parsed.error().message();
}

TEST(UserDefaults, AreNamesAndValues) {
  const auto parsed = parse_user_defaults(
      "# mine\n\nsession = fly\n terrain=~/dted  # of the coast\nconfig = apg68.guf\nlog-dir = /var/log/yars\nsize = "
      "900\n",
      "yars.conf", "/users/pilot");
  ASSERT_TRUE(parsed) << parsed.error().message();
  ASSERT_EQ(parsed->values.size(), 5U);
  EXPECT_EQ(parsed->values.at("session").value, "fly");
  EXPECT_EQ(parsed->values.at("terrain").value, "/users/pilot/dted");
  EXPECT_EQ(parsed->values.at("terrain").line, 4);
  EXPECT_EQ(parsed->values.at("config").value, "apg68.guf");
  EXPECT_EQ(parsed->values.at("log-dir").value, "/var/log/yars");
  EXPECT_EQ(parsed->values.at("size").value, "900");
}

TEST(UserDefaults, OfAnEmptyFileAreNone) {
  EXPECT_EQ(fault_of(""), "none");
  EXPECT_EQ(fault_of("# only a comment\n\n"), "none");
}

TEST(UserDefaults, FaultNamesFileLineAndWhatIsExpected) {
  EXPECT_THAT(fault_of("size = 900\nsesion = fly\n"),
              HasSubstr("yars.conf:2: expected one of session, config, terrain, log-dir, log-level, size, found "
                        "'sesion'; did you mean 'session'?"));
  EXPECT_EQ(fault_of("session\n"), "yars.conf:1: expected session = VALUE, found 'session'");
  EXPECT_THAT(fault_of("session =\n"), HasSubstr("yars.conf:1: expected a value of session, found none"));
  EXPECT_THAT(fault_of("size = 1\nsize = 2\n"), HasSubstr("yars.conf:2: expected size once, found it twice"));
  EXPECT_THAT(fault_of("[yars]\n"), HasSubstr("found '[yars]'"));
}

TEST(UserDefaults, PathsDoNotDependOnTheCurrentFolder) {
  for (const char* line :
       {"terrain = dted", "terrain = ./dted", "log-dir = logs", "config = ../a.guf", "terrain = ~pilot/x"})
    EXPECT_THAT(fault_of(line), HasSubstr("a path that begins with / or ~/")) << line;
}

class UserDefaultsPath : public ::testing::Test {
 protected:
  void SetUp() override {
    ::unsetenv("YARS_USER_CONFIG");
    ::unsetenv("XDG_CONFIG_HOME");
    ::setenv("HOME", "/users/pilot", 1);
  }
  void TearDown() override { ::setenv("YARS_USER_CONFIG", "", 1); }
};

TEST_F(UserDefaultsPath, FollowsXdgAndTheEnvironment) {
  EXPECT_EQ(user_defaults_path(), "/users/pilot/.config/yars/yars.conf");
  ::setenv("XDG_CONFIG_HOME", "/etc/pilot", 1);
  EXPECT_EQ(user_defaults_path(), "/etc/pilot/yars/yars.conf");
  ::setenv("XDG_CONFIG_HOME", "relative", 1);
  EXPECT_EQ(user_defaults_path(), "/users/pilot/.config/yars/yars.conf");
  ::setenv("YARS_USER_CONFIG", "/tmp/other.conf", 1);
  EXPECT_EQ(user_defaults_path(), "/tmp/other.conf");
  ::setenv("YARS_USER_CONFIG", "", 1);
  EXPECT_EQ(user_defaults_path(), "");
}

TEST_F(UserDefaultsPath, OnlyAFileThatTheEnvironmentNamesHasToExist) {
  ::setenv("XDG_CONFIG_HOME", "/nowhere/at/all", 1);
  const auto none = read_user_defaults();
  ASSERT_TRUE(none) << none.error().message();
  EXPECT_TRUE(none->values.empty());
  ::setenv("YARS_USER_CONFIG", "/nowhere/at/all.conf", 1);
  EXPECT_FALSE(read_user_defaults());
}

}  // namespace
}  // namespace yars::runtime
