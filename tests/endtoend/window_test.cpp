// Windows of radar-display and input-monitor under the X server Xvfb. Clicks on the bezel and keys change the state.
#include <gtest/gtest.h>

#include <cstdlib>

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
  // PB 14 (range down) is the fourth button from below on the right side, which has PB 11 to 15.
  to_window("YARS APG-70", {"mousemove", "--window", "%1", "470", "160", "click", "1"});
  EXPECT_TRUE(becomes("range_nm", 20.0)) << set_.watch().dump();
  to_window("YARS APG-70", {"key", "9"});
  EXPECT_TRUE(becomes("scan", "HALF")) << set_.watch().dump();
  EXPECT_TRUE(set_.runs("radar-display")) << set_.log_of("radar-display");
}

TEST_F(Windows, KeysInTheKeyboardWindowSendEventsAndEscapeEndsIt) {
  set_.start("input-monitor", {"input-monitor", "--source", "window"});
  ASSERT_TRUE(becomes("power", "OFF"));
  ASSERT_EQ(set_.yars({"inject", "power opr"}).code, 0);
  to_window("YARS", {"key", "3"});
  EXPECT_TRUE(becomes("gain", 2)) << set_.watch().dump();
  to_window("YARS", {"key", "space"});
  EXPECT_TRUE(becomes("freeze", true)) << set_.watch().dump();
  // Only keydown: the window closes before the key is released.
  to_window("YARS", {"keydown", "Escape"});
  EXPECT_EQ(set_.wait("input-monitor", 20.0), 0) << set_.log_of("input-monitor");
}

}  // namespace
}  // namespace yars::endtoend
