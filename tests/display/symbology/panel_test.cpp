// The bezel around the picture, tooltips, and the mouse. Source: docs/pilots_manual.md#bezel, #mouse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "display/symbology/bezel.hpp"
#include "display/symbology/readouts.hpp"
#include "tests/display/symbology/symbology_checks.hpp"

namespace yars::display {
namespace {

using ::testing::Contains;

constexpr PanelLayout kPanel;
constexpr PanelLayout kBare{0.0F};

// Middle of the drawn button, found by its number.
Point drawn_button(int button) {
  DrawList list;
  draw_bezel(kPanel, 0, list);
  for (const OccupiedBox& box : list.occupied())
    if (box.name == std::to_string(button)) return testing::middle_of(box.rect);
  ADD_FAILURE() << button;
  return {};
}

std::string texts(const std::vector<databuffer::InputEvent>& events) {
  std::string all;
  for (const auto& event : events) all += (all.empty() ? "" : ", ") + databuffer::text_of(event);
  return all;
}

TEST(Bezel, EachDrawnButtonAndEachLegendBesideItIsItsButton) {
  for (int button = 1; button <= 20; ++button) {
    EXPECT_EQ(button_at(kPanel, drawn_button(button)), button);
    const Point legend = legend_position(button).at;
    EXPECT_EQ(button_at(kPanel, {legend.x + kPanel.border, legend.y + kPanel.border}), button);
    EXPECT_EQ(button_at(kBare, legend), button);
  }
  EXPECT_EQ(button_at(kPanel, {kPanel.edge() / 2.0F, kPanel.edge() / 2.0F}), std::nullopt);
  EXPECT_EQ(button_at(kPanel, {5.0F, 5.0F}), std::nullopt) << "a corner of the bezel";
}

TEST(Bezel, ItLiesBesideThePictureAndItsButtonsDoNotOverlap) {
  DrawList list;
  draw_bezel(kPanel, 3, list);
  const Rect picture{kPanel.border, kPanel.border, kPanel.border + kDisplayUnits, kPanel.border + kDisplayUnits};
  for (const Panel& panel : list.panels()) EXPECT_FALSE(intersect(panel.rect, picture));
  std::set<std::string> numbers;
  for (const OccupiedBox& box : list.occupied()) numbers.insert(box.name);
  EXPECT_EQ(numbers.size(), 20U);
  DrawList bare;
  draw_bezel(kBare, 3, bare);
  EXPECT_TRUE(bare.panels().empty());
}

TEST(Tooltip, ItHasNumberKeyLegendAndWordsAndLiesWithinThePicture) {
  for (int button = 1; button <= 20; ++button) {
    DisplayInput input = testing::operating(radar::Mode::rbm, 40.0);
    testing::set_text(input.advice.buttons[button], "dead while frozen; end the freeze: freeze (Space)");
    DrawList list;
    draw_tooltip(kPanel, input, button, list);
    const Rect box = list.content(Layer::cover).plates.front();
    EXPECT_GE(box.left, kPanel.border);
    EXPECT_GE(box.top, kPanel.border);
    EXPECT_LE(box.right, kPanel.border + kDisplayUnits);
    EXPECT_LE(box.bottom, kPanel.border + kDisplayUnits);
    for (const OccupiedBox& text : list.occupied())
      EXPECT_TRUE(text.rect.left >= box.left && text.rect.right <= box.right) << text.name;
    const Point legend = legend_position(button).at;
    const Point at{legend.x + kPanel.border, legend.y + kPanel.border};
    const bool hides_legend = at.x > box.left && at.x < box.right && at.y > box.top && at.y < box.bottom;
    EXPECT_FALSE(hides_legend) << button;
  }
  DisplayInput input = testing::operating(radar::Mode::rbm, 40.0);
  testing::set_text(input.advice.buttons[9], "scan width: HALF");
  DrawList list;
  draw_tooltip(kPanel, input, 9, list);
  EXPECT_THAT(testing::words(list), Contains("PB 9, KEY 9: FULL"));
  EXPECT_THAT(testing::words(list), Contains("SCAN WIDTH: HALF"));
}

TEST(Tooltip, ThatBelowTheWindowSaysWhatABlankWindowIsAndHowToGetBack) {
  DisplayInput input = testing::operating(radar::Mode::rbm, 40.0);
  testing::set_text(input.advice.buttons[8], "dead in RBM; live in patch map");
  const auto joined = [&input] {
    DrawList list;
    draw_tooltip(kPanel, input, 8, list);
    std::string words;
    for (const std::string& line : testing::words(list)) words += line + ' ';
    return words;
  };
  EXPECT_THAT(joined(), ::testing::HasSubstr("WINDOW 4.7 NM: LARGER ACQ FWD (PGUP), SMALLER ACQ AFT (PGDN)"));
  input.state.window_nm = 0.0;
  EXPECT_THAT(joined(), ::testing::HasSubstr(
                            "WINDOW BLANK: THE CURSOR'S RANGE SELECTS IT; BACK TO THE SMALLEST: ACQ FWD (PGUP)"));
}

TEST(Mouse, AClickOnAButtonPressesIt) {
  Mouse mouse;
  EXPECT_EQ(texts(mouse.press(kPanel, MouseButton::left, drawn_button(13), true)), "pb 13");
  EXPECT_EQ(texts(mouse.release(kPanel, MouseButton::left, drawn_button(13))), "");
  EXPECT_EQ(texts(mouse.press(kPanel, MouseButton::right, drawn_button(13), true)), "");
}

constexpr Point kMiddle{56.0F + 240.0F, 56.0F + 240.0F};
constexpr Point kQuarter{56.0F + 120.0F, 56.0F + 360.0F};

TEST(Mouse, AClickOnTheMapPutsTheCursorThereAndReleasesTheSwitch) {
  Mouse mouse;
  EXPECT_EQ(texts(mouse.press(kPanel, MouseButton::left, kMiddle, true)), "cursor 0.5 0.5, tdc press");
  EXPECT_EQ(texts(mouse.release(kPanel, MouseButton::left, kMiddle)), "tdc release");
}

TEST(Mouse, TheCursorFollowsWhileAButtonIsHeldAndOnlyThen) {
  Mouse mouse;
  EXPECT_EQ(texts(mouse.move(kPanel, kMiddle)), "");
  mouse.press(kPanel, MouseButton::left, kMiddle, true);
  EXPECT_EQ(texts(mouse.move(kPanel, kQuarter)), "cursor 0.25 0.75");
  EXPECT_EQ(texts(mouse.move(kPanel, kQuarter)), "") << "the mouse stands still";
  EXPECT_EQ(texts(mouse.release(kPanel, MouseButton::left, kMiddle)), "cursor 0.5 0.5, tdc release");
  EXPECT_EQ(texts(mouse.move(kPanel, kQuarter)), "");
}

TEST(Mouse, TheRightButtonMovesTheCursorAlone) {
  Mouse mouse;
  EXPECT_EQ(texts(mouse.press(kPanel, MouseButton::right, kMiddle, true)), "cursor 0.5 0.5");
  EXPECT_EQ(texts(mouse.release(kPanel, MouseButton::right, kQuarter)), "cursor 0.25 0.75");
}

TEST(Mouse, AReleaseBesideTheMapDesignatesNothing) {
  Mouse mouse;
  mouse.press(kPanel, MouseButton::left, kMiddle, true);
  EXPECT_EQ(texts(mouse.release(kPanel, MouseButton::left, {20.0F, kMiddle.y})), "cursor 0 0.5");
  mouse.press(kPanel, MouseButton::left, kMiddle, true);
  mouse.cancel();
  EXPECT_EQ(texts(mouse.release(kPanel, MouseButton::left, kMiddle)), "");
}

TEST(Mouse, WithoutACursorTheMapTakesNoClick) {
  Mouse mouse;
  EXPECT_EQ(texts(mouse.press(kPanel, MouseButton::left, kMiddle, false)), "");
  EXPECT_EQ(texts(mouse.release(kPanel, MouseButton::left, kMiddle)), "");
}

TEST(Mouse, TheDisplayTakesACursorWhereItShowsOne) {
  EXPECT_TRUE(takes_cursor(testing::operating(radar::Mode::rbm, 40.0)));
  EXPECT_TRUE(takes_cursor(testing::operating(radar::Mode::beacon, 40.0)));
  for (const radar::Mode mode : {radar::Mode::pvu, radar::Mode::menu, radar::Mode::air_to_air, radar::Mode::ranging})
    EXPECT_FALSE(takes_cursor(testing::operating(mode, 40.0)));
  DisplayInput input = testing::operating(radar::Mode::rbm, 40.0);
  input.state.power = static_cast<std::uint8_t>(radar::Power::standby);
  EXPECT_FALSE(takes_cursor(input));
  DisplayInput map = testing::operating(radar::Mode::air_to_air, 40.0);
  testing::put_map(map, 60.0, 20.0, 4.7);
  EXPECT_FALSE(takes_cursor(map)) << "without SET";
  map.state.flags |= databuffer::kSet;
  EXPECT_TRUE(takes_cursor(map));
}

}  // namespace
}  // namespace yars::display
