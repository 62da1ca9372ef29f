// Tests of libyars-display by its header: the same picture as display/host, presses of buttons, errors as text.
#include <epoxy/gl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yars/yars_display.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "databuffer/session/session.hpp"
#include "display/gl/context.hpp"
#include "display/host/display.hpp"
#include "tests/databuffer/session/session_name.hpp"
#include "tests/display/host/host_context.hpp"

namespace yars::display {
namespace {

using databuffer::Session;
using ::testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

// Leaves the session when it goes out of scope.
using Attached = std::unique_ptr<yars_display, decltype(&yars_display_detach)>;

class LibraryDisplay : public databuffer::testing::SessionTest {
 protected:
  void SetUp() override {
    auto context = gl::open_headless();
    if (!context) GTEST_SKIP() << "no OpenGL without a display: " << context.error().message();
    context_ = std::move(*context);
    session_.emplace(*Session::open(name_, "tester"));
  }

  Attached attach() const { return {yars_display_attach(name_.c_str(), nullptr, "cockpit"), yars_display_detach}; }

  std::unique_ptr<gl::Context> context_;
  std::optional<Session> session_;
};

std::string described(const yars_display* d, int button) {
  std::array<char, 128> text{};
  EXPECT_EQ(yars_display_describe(d, button, text.data(), text.size()), 0) << yars_display_error();
  return text.data();
}

TEST_F(LibraryDisplay, DrawsThePictureOfTheDisplayWithinTheTree) {
  auto within = host::Display::attach({name_, "", "within"});
  ASSERT_TRUE(within) << within.error().message();
  within->update();
  within->paint(500);
  const Bytes expected = within->read().pixels;
  EXPECT_GT(std::ranges::count_if(expected, [](std::uint8_t value) { return value > 60; }), 500);
  const Attached d = attach();
  ASSERT_TRUE(d) << yars_display_error();
  const host::Canvas canvas(800, 600);
  canvas.bind();
  canvas.fill();
  const Bytes before = canvas.read();
  EXPECT_EQ(yars_display_update(d.get()), 0);
  EXPECT_EQ(yars_display_draw(d.get(), {100, 50, 600, 500}), 1);
  const Bytes after = canvas.read();
  EXPECT_TRUE(canvas.square(after, 150, 50, 500) == expected);
  EXPECT_EQ(canvas.changed_outside(before, after, 150, 50, 500), 0);
  EXPECT_EQ(yars_display_draw(d.get(), {100, 50, 600, 500}), 0) << "nothing is new";
  EXPECT_EQ(yars_display_draw(d.get(), {0, 0, 0, 500}), 0) << "an empty viewport";
  EXPECT_EQ(yars_display_note_shown(d.get()), 0);
}

TEST_F(LibraryDisplay, APanelIsDrawnWhenSomethingInItChanges) {
  const Attached d = attach();
  ASSERT_TRUE(d) << yars_display_error();
  const host::Canvas canvas(592, 592);
  canvas.bind();
  yars_display_update(d.get());
  yars_panel panel{};
  panel.bezel = 1;
  EXPECT_EQ(yars_display_draw_panel(d.get(), &panel, {0, 0, 592, 592}), 1);
  EXPECT_EQ(yars_display_draw_panel(d.get(), &panel, {0, 0, 592, 592}), 0);
  for (const auto change : {+[](yars_panel& it) { it.lit = 4; }, +[](yars_panel& it) { it.tooltip = 4; },
                            +[](yars_panel& it) { it.notice = "COCKPIT"; }, +[](yars_panel& it) { it.bezel = 0; }}) {
    const Bytes before = canvas.read();
    change(panel);
    EXPECT_EQ(yars_display_draw_panel(d.get(), &panel, {0, 0, 592, 592}), 1);
    EXPECT_FALSE(canvas.read() == before);
  }
  EXPECT_EQ(yars_display_show_help(d.get(), 1), 0);
  EXPECT_EQ(yars_display_draw_panel(d.get(), nullptr, {0, 0, 592, 592}), 1) << "without a panel, with the help";
  EXPECT_EQ(yars_display_show_help(d.get(), 0), 0);
  EXPECT_EQ(yars_display_show_hints(d.get(), 1), 0);
  EXPECT_EQ(yars_display_draw(d.get(), {0, 0, 592, 592}), 1);
}

TEST_F(LibraryDisplay, ButtonsArePressedFoundAndDescribed) {
  const Attached d = attach();
  ASSERT_TRUE(d) << yars_display_error();
  EXPECT_EQ(yars_display_click(d.get(), 470.0 / 480.0, 160.0 / 480.0), 1) << "the legend of PB 14";
  EXPECT_EQ(yars_display_click(d.get(), 0.5, 0.5), 0);
  EXPECT_EQ(yars_display_press(d.get(), 7), 0);
  EXPECT_EQ(yars_display_press(d.get(), 21), -1);
  EXPECT_THAT(yars_display_error(), HasSubstr("a button 1 to 20"));
  databuffer::InputEvent event{};
  for (const int button : {14, 7}) {
    ASSERT_TRUE(session_->layout().input.pop(0, event));
    EXPECT_EQ(event.argument, button);
  }
  EXPECT_FALSE(session_->layout().input.pop(0, event));
  EXPECT_EQ(yars_display_button_at(0, 470.0 / 480.0, 160.0 / 480.0), 14);
  EXPECT_EQ(yars_display_button_at(1, 526.0 / 592.0, 216.0 / 592.0), 14);
  EXPECT_EQ(yars_display_button_at(1, 0.5, 0.5), 0);

  // No state-machine runs: each button is dead, and says so.
  yars_display_update(d.get());
  EXPECT_THAT(described(d.get(), 13), HasSubstr("state-machine"));
  std::array<char, 7> small{};
  EXPECT_EQ(yars_display_describe(d.get(), 13, small.data(), small.size()), 0);
  EXPECT_EQ(small.data(), described(d.get(), 13).substr(0, 6));
  EXPECT_EQ(yars_display_describe(d.get(), 0, small.data(), small.size()), -1);
  EXPECT_EQ(yars_display_describe(d.get(), 13, small.data(), 0), -1);
  EXPECT_THAT(yars_display_error(), HasSubstr("room for a text"));
}

TEST_F(LibraryDisplay, AConfigurationThatCameWithYarsIsFoundByItsName) {
  const Attached d{yars_display_attach(name_.c_str(), "apg68.guf", nullptr), yars_display_detach};
  EXPECT_TRUE(d) << yars_display_error();
}

TEST_F(LibraryDisplay, ErrorsAreTextAndNeverEndTheHost) {
  EXPECT_EQ(yars_display_attach("../x", nullptr, nullptr), nullptr);
  EXPECT_THAT(yars_display_error(), HasSubstr("../x"));
  EXPECT_EQ(yars_display_attach(name_.c_str(), "absent.guf", nullptr), nullptr);
  EXPECT_THAT(yars_display_error(), HasSubstr("absent.guf"));
  EXPECT_EQ(yars_display_update(nullptr), -1);
  EXPECT_THAT(yars_display_error(), HasSubstr("found NULL"));
  EXPECT_EQ(yars_display_describe(nullptr, 1, nullptr, 0), -1);
  yars_display_detach(nullptr);
  context_.reset();
  EXPECT_FALSE(attach());
  EXPECT_THAT(yars_display_error(), HasSubstr("OpenGL 3.3"));
}

}  // namespace
}  // namespace yars::display
