// The option `--source` of input-monitor.
#include "inputmonitor/source_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace yars::inputmonitor {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(SourceChoice, AMisspelledKindIsAnsweredWithTheNearest) {
  EXPECT_THAT(parse_source("scrpt:a.script").error().message(), HasSubstr("did you mean 'script:'?"));
  EXPECT_THAT(parse_source("windw").error().message(), HasSubstr("did you mean 'window'?"));
  EXPECT_THAT(parse_source("script:").error().message(), Not(HasSubstr("did you mean")));
}

TEST(SourceChoice, EachKindIsParsed) {
  EXPECT_EQ(parse_source("window")->kind, SourceKind::window);
  EXPECT_EQ(parse_source("terminal")->kind, SourceKind::terminal);
  EXPECT_EQ(parse_source("auto")->kind, SourceKind::automatic);
  const auto script = parse_source("script:a:b.script");
  EXPECT_EQ(script->kind, SourceKind::script);
  EXPECT_EQ(script->file, "a:b.script");
  const auto tour = parse_source("tour:a,b.tour");
  EXPECT_EQ(tour->kind, SourceKind::tour);
  EXPECT_EQ(tour->file, "a,b.tour");
  EXPECT_FALSE(tour->for_pilot);
  const auto waiting = parse_source("tour:a,b.tour,pilot");
  EXPECT_EQ(waiting->file, "a,b.tour");
  EXPECT_TRUE(waiting->for_pilot);
}

TEST(SourceChoice, AnExistingPathIsNotSplitAtAComma) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("yars_source_choice_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  for (const char* name : {"take-off,pilot", "stick,left"}) std::ofstream(folder / name) << "any";
  const std::string tour = folder / "take-off,pilot", stick = folder / "stick,left";
  EXPECT_EQ(parse_source("tour:" + tour)->file, tour);
  EXPECT_FALSE(parse_source("tour:" + tour)->for_pilot);
  EXPECT_EQ(parse_source("tour:" + tour + ",pilot")->file, tour);
  EXPECT_TRUE(parse_source("tour:" + tour + ",pilot")->for_pilot);
  EXPECT_EQ(parse_source("evdev:" + stick)->file, stick);
  EXPECT_EQ(parse_source("evdev:" + stick)->map_name, "");
  EXPECT_EQ(parse_source("evdev:" + stick + ",throttle")->file, stick);
  EXPECT_EQ(parse_source("evdev:" + stick + ",throttle")->map_name, "throttle");
  std::filesystem::remove_all(folder);
}

TEST(SourceChoice, AnythingElseIsBadUsage) {
  for (const char* text :
       {"", "script", "script:", "tour:", "tour:,pilot", "keyboard", "evdev", "evdev:", "evdev:,map"}) {
    const auto choice = parse_source(text);
    ASSERT_FALSE(choice) << text;
    EXPECT_TRUE(choice.error().bad_usage());
    EXPECT_THAT(choice.error().message(),
                HasSubstr("window, terminal, script:FILE, tour:FILE[,pilot], evdev:PATH[,MAP] or auto"));
  }
}

TEST(SourceChoice, ADeviceMayBeFollowedByTheNameOfItsMap) {
  const auto plain = parse_source("evdev:/dev/input/event0");
  EXPECT_EQ(plain->kind, SourceKind::device);
  EXPECT_EQ(plain->file, "/dev/input/event0");
  EXPECT_EQ(plain->map_name, "");
  const auto named = parse_source("evdev:/tmp/a,b/panel,mfd-cougar");
  EXPECT_EQ(named->file, "/tmp/a,b/panel");
  EXPECT_EQ(named->map_name, "mfd-cougar");
  EXPECT_EQ(parse_source("evdev:/tmp/a,b/panel")->file, "/tmp/a,b/panel");
}

TEST(SourceChoice, TheErrorNamesAMissingScript) {
  const auto source = open_sources({{SourceKind::script, "/nonexistent/x.script", {}}}, {});
  ASSERT_FALSE(source);
  EXPECT_FALSE(source.error().bad_usage());
  EXPECT_THAT(source.error().message(), HasSubstr("/nonexistent/x.script"));
}

TEST(SourceChoice, AWindowWithoutAnXOrWaylandDisplayIsRefused) {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  const auto source = open_sources({{SourceKind::window, {}, {}}}, {});
  ASSERT_FALSE(source);
  EXPECT_THAT(source.error().message(), HasSubstr("a display"));
}

}  // namespace
}  // namespace yars::inputmonitor
