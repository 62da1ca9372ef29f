// Tests of the positions of labels: next to the symbol, farther out with a leader line, or none. Also tests the
// priority between labels, and their stability from picture to picture.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "display/symbology/text_layout.hpp"
#include "lib/radar/configuration.hpp"
#include "tests/display/symbology/overlap.hpp"
#include "tests/display/symbology/random_input.hpp"
#include "tests/display/symbology/symbology_checks.hpp"

namespace yars::display {
namespace {

constexpr Point kMiddle{240.0F, 240.0F};

Label name(const std::string& words, Point anchor = kMiddle) {
  return label_of(LabelRole::name, words, anchor);
}

void add_symbol(DrawList& list, Point at) {
  list.occupy("point", grown({at.x, at.y, at.x, at.y}, 7.0F), BoxKind::point);
}

// Draw list with a symbol in the middle, and with `blocks` as occupied boxes.
DrawList list_with(const std::vector<Rect>& blocks) {
  DrawList list;
  add_symbol(list, kMiddle);
  for (const Rect& block : blocks) list.occupy("block", block, BoxKind::scale);
  return list;
}

std::optional<Rect> box_of(const std::string& words, const DrawList& list) {
  const auto box = std::ranges::find_if(
      list.occupied(), [&](const OccupiedBox& one) { return one.kind == BoxKind::label && one.name == words; });
  return box == list.occupied().end() ? std::nullopt : std::optional(box->rect);
}

// Box of the name of the symbol in the middle, among `blocks`; nullopt: the name is left out.
std::optional<Rect> placed(const std::vector<Rect>& blocks, LabelMemory& memory) {
  DrawList list = list_with(blocks);
  place_labels(std::array{name("12")}, memory, list);
  return box_of("12", list);
}

std::optional<Rect> placed(const std::vector<Rect>& blocks) {
  LabelMemory memory;
  return placed(blocks, memory);
}

constexpr Rect kUpperRight{242.0F, 200.0F, 300.0F, 238.0F};
constexpr Rect kAllAround{200.0F, 200.0F, 280.0F, 280.0F};

TEST(LabelLayout, ANameIsAtTheUpperRightOfItsSymbol) {
  const auto box = placed({});
  ASSERT_TRUE(box);
  EXPECT_FLOAT_EQ(box->left, 250.0F);
  EXPECT_LT(box->bottom, 240.0F);
}

TEST(LabelLayout, ANameGetsTheNextPositionWhereTheFirstIsOccupied) {
  const auto box = placed({kUpperRight});
  ASSERT_TRUE(box);
  EXPECT_FLOAT_EQ(box->left, 250.0F);
  EXPECT_GT(box->top, 240.0F);
}

TEST(LabelLayout, ANameFartherOutHasALeaderLine) {
  LabelMemory memory;
  DrawList list = list_with({kAllAround});
  place_labels(std::array{name("12")}, memory, list);
  const auto box = box_of("12", list);
  ASSERT_TRUE(box);
  EXPECT_FALSE(intersect(*box, kAllAround));
  ASSERT_EQ(list.content(Layer::lines).strokes.size(), 1U);
  const Segment& line = list.content(Layer::lines).strokes[0];
  EXPECT_NEAR(std::hypot(line.from.x - kMiddle.x, line.from.y - kMiddle.y), 8.0F, 0.2F);
  EXPECT_TRUE(crosses(grown(*box, 4.0F), line.from, line.to));
  EXPECT_FALSE(crosses(*box, line.from, line.to));
}

TEST(LabelLayout, ANameWithoutAPositionIsLeftOut) {
  EXPECT_FALSE(placed({{0.0F, 0.0F, kDisplayUnits, kDisplayUnits}}));
}

// The blocks leave room for one name, to the right of the symbol.
TEST(LabelLayout, OfTwoNamesTheFirstGetsTheOnlyFreePosition) {
  const std::vector<Rect> blocks{{0.0F, 0.0F, 248.0F, 480.0F},
                                 {300.0F, 0.0F, 480.0F, 480.0F},
                                 {248.0F, 0.0F, 300.0F, 230.0F},
                                 {248.0F, 250.0F, 300.0F, 480.0F}};
  for (const auto& [first, second] : {std::pair{"11", "22"}, std::pair{"22", "11"}}) {
    LabelMemory memory;
    DrawList list = list_with(blocks);
    place_labels(std::array{name(first), name(second)}, memory, list);
    EXPECT_TRUE(box_of(first, list));
    EXPECT_FALSE(box_of(second, list));
  }
}

TEST(LabelLayout, ANameKeepsItsPositionWhileThatIsFree) {
  LabelMemory memory;
  const auto moved = placed({kUpperRight}, memory);
  EXPECT_EQ(placed({}, memory), moved) << "the upper right is free again, but the name stays";
  EXPECT_NE(placed({}), moved);
}

TEST(LabelLayout, ANameReturnsToItsSymbolWhenAPositionThereIsFree) {
  LabelMemory memory;
  const auto far = placed({kAllAround}, memory);
  EXPECT_EQ(placed({{200.0F, 200.0F, 249.0F, 249.0F}}, memory), placed({{200.0F, 200.0F, 249.0F, 249.0F}}));
  EXPECT_NE(placed({}, memory), far);
}

TEST(LabelLayout, ASecondLayoutOfTheSameInputMovesNothing) {
  testing::RandomDisplayInput states(20261123);
  const PlanView view{radar::ViewConfiguration{}};
  for (int i = 0; i < 500; ++i) {
    const DisplayInput input = states.next();
    LabelMemory memory;
    DrawList first, second;
    draw_symbology(input, radar::RadarConfiguration(), view, present_frame(input, nullptr), memory, first);
    draw_symbology(input, radar::RadarConfiguration(), view, present_frame(input, nullptr), memory, second);
    ASSERT_EQ(first, second) << "state " << i;
  }
}

// Boxes of the labels, by their text.
std::map<std::string, Rect> labels_of(const DrawList& list) {
  std::map<std::string, Rect> found;
  for (const OccupiedBox& box : list.occupied())
    if (box.kind == BoxKind::label) found[box.name] = box.rect;
  return found;
}

// Number of times that a label moves by more than 3 units while the picture turns to and fro by 0.05 deg.
int jumps_while_turning(DisplayInput input, bool with_memory) {
  const PlanView view{radar::ViewConfiguration{}};
  LabelMemory memory;
  std::map<std::string, Rect> before;
  int jumps = 0;
  for (int i = 0; i < 12; ++i) {
    const double turn_deg = i % 2 == 0 ? 0.0 : 0.05;
    input.ownship.velocity_north_mps = 231.5 * std::cos((30.0 + turn_deg) * geo::kRadiansPerDegree);
    input.ownship.velocity_east_mps = 231.5 * std::sin((30.0 + turn_deg) * geo::kRadiansPerDegree);
    DrawList list;
    if (!with_memory) memory.clear();
    draw_symbology(input, radar::RadarConfiguration(), view, present_frame(input, nullptr), memory, list);
    const auto now = labels_of(list);
    if (i > 1) {
      for (const auto& [words, box] : now) {
        const auto was = before.find(words);
        jumps += was == before.end() || std::abs(was->second.left - box.left) > 3.0F ||
                         std::abs(was->second.top - box.top) > 3.0F
                     ? 1
                     : 0;
      }
    }
    before = now;
  }
  return jumps;
}

TEST(LabelLayout, NoLabelJumpsWhileThePictureJitters) {
  testing::RandomDisplayInput states(20261124);
  int jumps = 0, without_memory = 0;
  for (int i = 0; i < 200; ++i) {
    const DisplayInput input = states.next();
    jumps += jumps_while_turning(input, true);
    without_memory += jumps_while_turning(input, false);
  }
  EXPECT_EQ(jumps, 0);
  EXPECT_GT(without_memory, 0) << "without memory, labels of these inputs jump";
}

TEST(LabelLayout, TheSelectedPointsNameIsShownWhereItsSymbolIsShown) {
  testing::RandomDisplayInput states(20261125);
  int seen = 0;
  for (int i = 0; i < 3000; ++i) {
    DisplayInput input = states.next();
    const std::span points(input.state.points, input.state.points_drawn);
    const auto selected = std::ranges::find(points, 1, &databuffer::DrawnPoint::selected);
    if (selected == points.end()) continue;
    const std::string words = databuffer::DrawnPoint(*selected).name;
    const DrawList crowd = testing::drawn(input);
    std::swap(*selected, points[0]);
    input.state.points_drawn = 1;
    const DrawList alone = testing::drawn(input);
    const auto symbol = std::ranges::find(alone.occupied(), BoxKind::point, &OccupiedBox::kind);
    if (symbol == alone.occupied().end()) continue;
    // Within 40 units of the edge, legends and the cursor may leave no room for the name.
    const Rect inside{40.0F, 40.0F, 440.0F, 440.0F};
    if (!intersect(symbol->rect, inside)) continue;
    ++seen;
    EXPECT_TRUE(box_of(words, crowd)) << words << " in state " << i;
  }
  EXPECT_GT(seen, 300);
}

}  // namespace
}  // namespace yars::display
