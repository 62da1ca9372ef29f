#include "inputmonitor/source_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace yars::inputmonitor {
namespace {

using ::testing::HasSubstr;

TEST(SourceChoice, EachKindHasItsWord) {
  EXPECT_EQ(parse_source("window")->kind, SourceKind::window);
  EXPECT_EQ(parse_source("terminal")->kind, SourceKind::terminal);
  EXPECT_EQ(parse_source("auto")->kind, SourceKind::automatic);
  const auto script = parse_source("script:a:b.script");
  EXPECT_EQ(script->kind, SourceKind::script);
  EXPECT_EQ(script->file, "a:b.script");
}

TEST(SourceChoice, AnythingElseIsBadUsage) {
  for (const char* text : {"", "script", "script:", "keyboard", "evdev:/dev/input/event0"}) {
    const auto choice = parse_source(text);
    ASSERT_FALSE(choice) << text;
    EXPECT_TRUE(choice.error().bad_usage);
    EXPECT_THAT(choice.error().message(), HasSubstr("window, terminal, script:FILE or auto"));
  }
  EXPECT_THAT(parse_source("evdev:/dev/input/event0").error().message(), HasSubstr("later release"));
}

TEST(SourceChoice, AMissingScriptIsNamed) {
  const auto source = open_source({SourceKind::script, "/nonexistent/x.script"}, "test");
  ASSERT_FALSE(source);
  EXPECT_FALSE(source.error().bad_usage);
  EXPECT_THAT(source.error().message(), HasSubstr("/nonexistent/x.script"));
}

TEST(SourceChoice, WithoutADisplayThereIsNoWindow) {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  const auto source = open_source({SourceKind::window, {}}, "test");
  ASSERT_FALSE(source);
  EXPECT_THAT(source.error().message(), HasSubstr("a display"));
}

}  // namespace
}  // namespace yars::inputmonitor
