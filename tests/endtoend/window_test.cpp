// Windows of radar-display and input-monitor under the X server Xvfb. Clicks on the bezel and keys change the state.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "tests/endtoend/process_set.hpp"

namespace yars::endtoend {
namespace {

class Windows : public ::testing::Test {
 protected:
  Windows() : set_("windows") {}

  void SetUp() override {
    if (!tool_exists("Xvfb") || !tool_exists("xdotool"))
      GTEST_SKIP() << "needs Xvfb and xdotool (scripts/setup --test)";
    set_.start_tool("xvfb", {"Xvfb", "-displayfd", "1", "-screen", "0", "800x600x24", "-nolisten", "tcp"});
    ASSERT_TRUE(eventually([&] { return set_.output_of("xvfb").ends_with("\n"); }, 20.0)) << set_.log_of("xvfb");
    std::string display = set_.output_of("xvfb");
    display.insert(display.begin(), ':');
    display.pop_back();
    setenv("DISPLAY", display.c_str(), 1);
    set_.start("state-machine", {"state-machine"});
    set_.start("flight-model", {"flight-model", "--source", "fixed:37.5,-123.0,15000,90,480"});
    set_.start("radar-model", {"radar-model"});
  }

  void TearDown() override { unsetenv("DISPLAY"); }

  // Gives the window with this title the keyboard focus, then does the xdotool actions.
  void to_window(const std::string& title, const std::vector<std::string>& actions) {
    std::vector<std::string> command{"xdotool", "search", "--sync", "--onlyvisible", "--name", title, "windowfocus"};
    command.insert(command.end(), actions.begin(), actions.end());
    const auto finished = run_tool(command, 30.0);
    ASSERT_EQ(finished.code, 0) << finished.errors;
  }

  bool becomes(const std::string& field, const nlohmann::json& value) {
    return set_.wait_until([&](const auto& watch) { return watch[field] == value; });
  }

  ProcessSet set_;
};

TEST_F(Windows, AClickOnTheBezelAndAKeyInTheDisplayWindowPressButtons) {
  set_.start("radar-display", {"radar-display", "--size", "480"});
  ASSERT_TRUE(becomes("power", "OFF"));
  ASSERT_EQ(set_.yars({"inject", "power opr"}).code, 0);
  ASSERT_TRUE(becomes("range_nm", 40.0));
  // PB 14 (range down) is the fourth button from below on the right side, which has PB 11 to 15. The bezel is 56 pixels
  // wide; the middle of its buttons lies 28 pixels from the window's edge.
  to_window("YARS APG-70", {"mousemove", "--window", "%1", "564", "216", "click", "1"});
  EXPECT_TRUE(becomes("range_nm", 20.0)) << set_.watch().dump();
  to_window("YARS APG-70", {"key", "9"});
  EXPECT_TRUE(becomes("scan", "HALF")) << set_.watch().dump();
  EXPECT_TRUE(set_.runs("radar-display")) << set_.log_of("radar-display");
}

TEST_F(Windows, AClickOnTheMapMovesTheCursorAndDesignatesAndTheRightButtonMovesItAlone) {
  set_.start("radar-display", {"radar-display", "--size", "480"});
  ASSERT_TRUE(becomes("power", "OFF"));
  to_window("YARS APG-70", {"key", "o"});
  ASSERT_TRUE(becomes("power", "OPR")) << set_.watch().dump();
  ASSERT_EQ(set_.yars({"inject", "pb 7", "pb 7", "pb 7"}).code, 0);
  ASSERT_TRUE(becomes("cursor_function", "TGT"));
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return !watch["cursor"].is_null(); }));
  // At 40 NM a pixel is 0.1 NM. The apex lies at 296, 496 of the window.
  to_window("YARS APG-70", {"mousemove", "--window", "%1", "296", "296", "click", "3"});
  EXPECT_TRUE(set_.wait_until([](const auto& watch) {
    return std::abs(watch["cursor"]["range_nm"].template get<double>() - 20.0) < 0.5;
  })) << set_.watch().dump();
  EXPECT_TRUE(set_.watch()["target"].is_null());
  to_window("YARS APG-70", {"mousemove", "--window", "%1", "396", "296", "click", "1"});
  EXPECT_TRUE(set_.wait_until([](const auto& watch) { return !watch["target"].is_null(); })) << set_.watch().dump();
  EXPECT_NEAR(set_.watch()["cursor"]["range_nm"].get<double>(), 22.4, 0.5);
}

TEST_F(Windows, HelpBezelAndFullScreenKeepTheDisplayRunningAndEscapeDoesNotEndIt) {
  set_.start("radar-display", {"radar-display", "--size", "480"});
  ASSERT_TRUE(becomes("power", "OFF"));
  for (const char* key : {"question", "Escape", "F1", "F1", "F8", "F8", "F11", "Escape", "Escape"})
    to_window("YARS APG-70", {"key", key});
  to_window("YARS APG-70", {"key", "o"});
  EXPECT_TRUE(becomes("power", "OPR")) << set_.watch().dump();
  EXPECT_TRUE(set_.runs("radar-display")) << set_.log_of("radar-display");
}

TEST_F(Windows, TheDisplaysWindowHasItsClass) {
  set_.start("radar-display", {"radar-display", "--size", "480", "--no-bezel"});
  ASSERT_TRUE(becomes("power", "OFF"));
  const auto found =
      run_tool({"xdotool", "search", "--sync", "--onlyvisible", "--class", "^yars-radar-display$"}, 30.0);
  EXPECT_EQ(found.code, 0) << found.errors;
}

TEST_F(Windows, KeysInTheKeyboardWindowSendEventsAndEscapeEndsIt) {
  set_.start("input-monitor", {"input-monitor", "--source", "window"});
  ASSERT_TRUE(becomes("power", "OFF"));
  ASSERT_EQ(set_.yars({"inject", "power opr"}).code, 0);
  to_window("YARS", {"key", "3"});
  EXPECT_TRUE(becomes("gain", 2)) << set_.watch().dump();
  to_window("YARS", {"key", "space"});
  EXPECT_TRUE(becomes("freeze", true)) << set_.watch().dump();
  to_window("YARS", {"key", "6"});
  EXPECT_TRUE(eventually(
      [&] { return set_.log_of("input-monitor").find("pb 6: dead while frozen; end the freeze") != std::string::npos; },
      20.0))
      << set_.log_of("input-monitor");
  to_window("YARS", {"key", "question"});
  EXPECT_TRUE(eventually([&] { return set_.log_of("input-monitor").find("PgUp PgDn") != std::string::npos; }, 20.0))
      << set_.log_of("input-monitor");
  // Only keydown: the window closes before the key is released.
  to_window("YARS", {"keydown", "Escape"});
  EXPECT_EQ(set_.wait("input-monitor", 20.0), 0) << set_.log_of("input-monitor");
  EXPECT_NE(set_.log_of("input-monitor").find("Esc ended the keys of this window"), std::string::npos);
}

}  // namespace
}  // namespace yars::endtoend
