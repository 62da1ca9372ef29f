// Tests of symbols at ground positions: the cursor, and sequence points with their names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "display/symbology/ground_symbols.hpp"
#include "tests/display/symbology/overlap.hpp"
#include "tests/display/symbology/symbology_checks.hpp"

namespace yars::display {
namespace {

using radar::Mode;
using testing::bounds_of;
using ::testing::Contains;
using testing::drawn;
using testing::expect_no_overlap;
using testing::middle_of;
using testing::more_strokes;
using testing::strokes;
using testing::symbol_strokes;
using testing::words;

TEST(Markers, TheCursorIsAnOpenPlusOnItsGroundPoint) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  const DrawList unknown = drawn(input);
  input.state.flags |= databuffer::kCursorValid;
  const geo::GeoPoint position = testing::at(30.0, 20.0);
  input.state.cursor_latitude_deg = position.latitude_deg;
  input.state.cursor_longitude_deg = position.longitude_deg;
  const DrawList here = drawn(input);
  EXPECT_EQ(here.content(Layer::steered).strokes.size(), 4U);
  EXPECT_EQ(unknown.content(Layer::steered).strokes.size(), 0U);
  const Rect plus = bounds_of(here.content(Layer::steered).strokes);
  EXPECT_NEAR((plus.left + plus.right) / 2.0F, 240.0F, 0.2F);
  EXPECT_NEAR((plus.top + plus.bottom) / 2.0F, 240.0F, 0.2F);
  for (const Segment& segment : symbol_strokes(here)) {
    const bool at_middle = std::abs(segment.from.x - 240.0F) < 4.0F && std::abs(segment.from.y - 240.0F) < 4.0F;
    EXPECT_FALSE(at_middle) << "the plus is open";
  }
}

TEST(Markers, AReadoutStepsAsideFromTheCursor) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  const auto window = [](const DrawList& list) {
    return std::ranges::find(list.occupied(), "4.7", &OccupiedBox::name)->rect;
  };
  const Rect before = window(drawn(input));
  testing::put_cursor(input, 210.0, 1.2);  // 12 units below the apex, at the readout of the window size
  const DrawList list = drawn(input);
  EXPECT_EQ(list.content(Layer::steered).strokes.size(), 4U) << "the whole cursor";
  EXPECT_GT(window(list).left, 258.0F) << "beyond the cursor";
  EXPECT_EQ(window(list).top, before.top) << "in its row";
}

TEST(Markers, TheCursorEndsBeforeALegend) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  testing::set_text(input.state.legends[8], "STAB");
  testing::put_cursor(input, 210.0, 2.8);  // at the legend of PB 8
  const DrawList list = drawn(input);
  EXPECT_THAT(words(list), Contains("STAB"));
  for (const Segment& line : list.content(Layer::steered).strokes) EXPECT_NE(line.from.y, line.to.y) << "upright arms";
  expect_no_overlap(list, "the cursor at a legend");
}

TEST(Markers, AMessageRisesClearOfTheCursor) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  testing::set_text(input.state.message, "BLIND ZONE");
  const auto message = [](const DrawList& list) {
    return std::ranges::find(list.occupied(), "BLIND ZONE", &OccupiedBox::name)->rect;
  };
  EXPECT_NEAR(message(drawn(input)).top, 408.0F, 0.2F);
  testing::put_cursor(input, 30.0, 3.0);  // 30 units above the apex, at the message
  const DrawList list = drawn(input);
  EXPECT_EQ(list.content(Layer::steered).strokes.size(), 4U) << "the whole cursor";
  EXPECT_LT(message(list).bottom, 410.0F - 16.0F);
  EXPECT_GT(message(list).bottom, 410.0F - 30.0F) << "near its place";
}

// Neither a point nor a text or a solid scale could be read if one were drawn over the other.
TEST(Markers, APointUnderATextOrAScaleIsLeftOutWithItsName) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  const DrawList without = drawn(input);
  testing::add_point(input, "7", radar::PointKind::steer,
                     testing::at(210.0, 1.2));  // behind the aircraft, at the window size
  EXPECT_EQ(drawn(input), without);
  // On the gray scale, which is at (427, 380).
  DisplayInput on_gray = testing::operating(Mode::rbm, 40.0);
  const double right_nm = (427.0 - 240.0) / 10.0, ahead_nm = (440.0 - 380.0) / 10.0;
  testing::add_point(
      on_gray, "7", radar::PointKind::steer,
      testing::at(30.0 + std::atan2(right_nm, ahead_nm) / geo::kRadiansPerDegree, std::hypot(right_nm, ahead_nm)));
  EXPECT_THAT(words(on_gray), ::testing::Not(Contains("7")));
}

TEST(Markers, TheSelectedPointIsDrawnUnderATextToo) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  const DrawList without = drawn(input);
  testing::add_point(input, "7", radar::PointKind::steer,
                     testing::at(210.0, 1.2));  // behind the aircraft, at the window size
  input.state.points[0].selected = 1;
  const DrawList with = drawn(input);
  EXPECT_EQ(with.content(Layer::points).strokes.size(), without.content(Layer::points).strokes.size() + 24);
  EXPECT_THAT(words(with), Contains("4.7"));
  EXPECT_GT(with.content(Layer::symbols).plates.size(), without.content(Layer::symbols).plates.size())
      << "the text has a black background";
  expect_no_overlap(with, "the selected point under the window size");
}

TEST(Markers, PointsAreDrawnAtTheirPositionsAndOnlyOnTheDisplay) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  const DrawList without = drawn(input);
  testing::add_point(input, "3.", radar::PointKind::target, testing::at(30.0, 30.0));
  const DrawList with = drawn(input);
  const auto& boxes = with.occupied();
  const auto symbol = std::ranges::find(boxes, "point", &OccupiedBox::name);
  ASSERT_NE(symbol, boxes.end());
  EXPECT_NEAR((symbol->rect.left + symbol->rect.right) / 2.0F, 240.0F, 0.2F);
  EXPECT_NEAR((symbol->rect.top + symbol->rect.bottom) / 2.0F, 140.0F, 0.2F);
  EXPECT_THAT(words(with), Contains("3."));
  input.state.points_drawn = 0;
  testing::add_point(input, "4", radar::PointKind::steer, testing::at(30.0, -30.0));
  EXPECT_EQ(drawn(input), without);
}

// Number of strokes of the point's symbol, without those of its name.
std::size_t strokes_of_point(radar::PointKind kind, const std::string& name, bool of_initial_point = false) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  const std::size_t before = strokes(drawn(input));
  testing::add_point(input, name, kind, testing::at(30.0, 30.0));
  input.state.points[0].of_initial_point = of_initial_point ? 1 : 0;
  const std::size_t with_name = strokes(drawn(input)) - before;
  // The name has as many strokes as the same text as a message.
  testing::set_text(input.state.message, name);
  return with_name - (strokes(drawn(input)) - before - with_name);
}

TEST(Markers, SteerIsACircleInitialASquareTargetATriangleAndOffsetsAreDashed) {
  using radar::PointKind;
  EXPECT_EQ(strokes_of_point(PointKind::steer, "1"), 24U);
  EXPECT_EQ(strokes_of_point(PointKind::initial, "2"), 4U);
  EXPECT_EQ(strokes_of_point(PointKind::target, "3."), 3U);
  const std::size_t steer_offset = strokes_of_point(PointKind::steer_offset, "1.1");
  const std::size_t initial_offset = strokes_of_point(PointKind::steer_offset, "2.1", true);
  const std::size_t target_offset = strokes_of_point(PointKind::target_offset, "3.01");
  EXPECT_NE(steer_offset, initial_offset) << "the offset of an initial point is a square";
  EXPECT_GT(initial_offset, 4U);
  EXPECT_GT(target_offset, 3U);
}

TEST(Markers, NamesKeepClearOfLegendsAndOfEachOther) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  input.state.flags |= databuffer::kFreeze;
  for (int i = 0; i < 5; ++i) {
    testing::add_point(input, "2.0" + std::to_string(i + 1), radar::PointKind::target_offset,
                       testing::at(30.0 + 6.0 * i, 20.0));
  }
  expect_no_overlap(drawn(input), "five points in a row");
}

TEST(Markers, NamesKeepClearOfTheCursor) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  testing::put_cursor(input, 30.0, 20.0);
  // The points are near the cursor, so that the first position for a name is on an arm of the cursor.
  for (int i = 0; i < 5; ++i) {
    input.state.points_drawn = 0;
    testing::add_point(input, "2.0" + std::to_string(i + 1), radar::PointKind::target_offset,
                       testing::at(24.0 + 1.5 * i, 18.6 + 0.5 * i));
    const DrawList list = drawn(input);
    const auto& boxes = list.occupied();
    const auto name = std::ranges::find(boxes, "2.0" + std::to_string(i + 1), &OccupiedBox::name);
    ASSERT_NE(name, boxes.end());
    EXPECT_FALSE(intersect(name->rect, {224.0F, 239.0F, 256.0F, 241.0F})) << i;
    EXPECT_FALSE(intersect(name->rect, {239.0F, 224.0F, 241.0F, 256.0F})) << i;
  }
}

}  // namespace
}  // namespace yars::display
