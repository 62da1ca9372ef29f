// Tests of the push buttons around the display: positions of legends, and the button at a clicked point.
#include <gtest/gtest.h>

#include <set>

#include "display/symbology/readouts.hpp"
#include "lib/radar/modes.hpp"

namespace yars::display {
namespace {

TEST(Bezel, ButtonsRunCounterClockwiseFromTheTopOfTheLeftSide) {
  EXPECT_LT(legend_position(1).at.y, legend_position(5).at.y);
  EXPECT_LT(legend_position(6).at.x, legend_position(10).at.x);
  EXPECT_GT(legend_position(11).at.y, legend_position(15).at.y);
  EXPECT_GT(legend_position(16).at.x, legend_position(20).at.x);
  EXPECT_LT(legend_position(3).at.x, 240.0F);
  EXPECT_GT(legend_position(8).at.y, 240.0F);
  EXPECT_GT(legend_position(13).at.x, 240.0F);
  EXPECT_LT(legend_position(18).at.y, 240.0F);
}

TEST(Bezel, TheButtonAtALegendIsItsOwn) {
  for (int button = 1; button <= radar::kBezelButtons; ++button)
    EXPECT_EQ(button_at(legend_position(button).at), button);
}

TEST(Bezel, EachButtonHasAnAreaAndTheMiddleAndTheCornersHaveNone) {
  std::set<int> found;
  for (float x = 0.0F; x <= kDisplayUnits; x += 4.0F) {
    for (float y = 0.0F; y <= kDisplayUnits; y += 4.0F) {
      if (const auto button = button_at({x, y})) found.insert(*button);
    }
  }
  EXPECT_EQ(found.size(), 20U);
  EXPECT_EQ(button_at({240.0F, 240.0F}), std::nullopt);
  EXPECT_EQ(button_at({2.0F, 2.0F}), std::nullopt);
  EXPECT_EQ(button_at({478.0F, 2.0F}), std::nullopt);
  EXPECT_EQ(button_at({2.0F, 478.0F}), std::nullopt);
  EXPECT_EQ(button_at({-1.0F, 80.0F}), std::nullopt);
  EXPECT_EQ(button_at({80.0F, 481.0F}), std::nullopt);
}

}  // namespace
}  // namespace yars::display
