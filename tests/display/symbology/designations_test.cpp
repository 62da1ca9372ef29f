// Tests of the symbols of cursor functions and velocity measurement: errors of UPDT, velocity differences, the pattern
// steering line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/display/symbology/overlap.hpp"
#include "tests/display/symbology/symbology_checks.hpp"

namespace yars::display {
namespace {

using databuffer::SteeringLine;
using radar::Mode;
using ::testing::Contains;
using testing::drawn;
using ::testing::IsSupersetOf;
using ::testing::Not;
using testing::strokes;
using testing::words;

// A target 20 NM ahead with its steering line; approach_deg: true heading on which the target is approached.
DisplayInput with_steering_line(SteeringLine line, double approach_deg) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  testing::put_target(input, testing::at(30.0, 20.0), approach_deg, line);
  return input;
}

TEST(Designations, UpdateErrorsAreInFeetTo3000FeetAndInMilesBeyond) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  testing::put_update(input, 1240.4, -330.0, -1);
  EXPECT_THAT(words(input), IsSupersetOf({"N 1240FT", "W 330FT"}));
  testing::put_update(input, -3000.0, 0.0, -1);
  EXPECT_THAT(words(input), IsSupersetOf({"S 3000FT", "E 0FT"}));
  testing::put_update(input, -3000.0, 3000.0, -1);
  EXPECT_THAT(words(input), IsSupersetOf({"S 0.49NM", "E 0.49NM"}));
  input.state.flags &= ~databuffer::kUpdateShown;
  EXPECT_THAT(words(input), Not(Contains("S 0.49NM")));
}

TEST(Designations, AnInsUpdateCountsDownToInv) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  testing::put_update(input, 100.0, 100.0, 17);
  const DrawList list = drawn(input);
  EXPECT_THAT(words(list), IsSupersetOf({"17", "N 100FT"}));
  const auto& boxes = list.occupied();
  const auto counter = std::ranges::find(boxes, "17", &OccupiedBox::name);
  EXPECT_NEAR((counter->rect.left + counter->rect.right) / 2.0F, 160.0F, 0.2F) << "above the legend of PB 7";
  testing::put_update(input, 100.0, 100.0, 0);
  input.state.flags |= databuffer::kUpdateInvalid;
  EXPECT_THAT(words(input), IsSupersetOf({"INV", "0"}));
  EXPECT_THAT(words(input), Not(Contains("N 100FT")));
}

TEST(Designations, VelocityDifferencesAreInFeetPerSecond) {
  DisplayInput input = testing::operating(Mode::hrm, 40.0);
  EXPECT_THAT(words(input), Not(Contains("FT/S")));
  testing::put_velocities(input, 1.24, -0.04, -12.0);
  EXPECT_THAT(words(input), IsSupersetOf({"FT/S", "AL", "+1.2", "AX", "+0.0", "VT", "-12.0"}));
}

TEST(Designations, PvuHasItsOwnFormatWithTheMeasuredBeam) {
  DisplayInput input = testing::operating(Mode::pvu, 40.0);
  EXPECT_THAT(words(input), IsSupersetOf({"ALONG", "ACROSS", "VERTICAL", "--- FT/S", "BEAM", "-"}));
  testing::put_velocities(input, 1.24, -2.0, 0.5);
  input.model.velocity_beam = 2;
  EXPECT_THAT(words(input), IsSupersetOf({"+1.2 FT/S", "-2.0 FT/S", "+0.5 FT/S", "2"}));
  EXPECT_THAT(words(input), Not(Contains("--- FT/S")));
}

// A target near the aircraft: its line of sight leads over the azimuth ticks to the window size and the legends.
TEST(Designations, TheSteeringLineEndsBeforeALegendOrReadout) {
  for (const SteeringLine line : {SteeringLine::line_of_sight, SteeringLine::slewing, SteeringLine::fixed}) {
    for (double bearing_deg = 0.0; bearing_deg < 360.0; bearing_deg += 5.0) {
      for (const double range_nm : {1.0, 2.0, 3.0, 4.0, 6.0}) {
        DisplayInput input = testing::operating(Mode::rbm, 40.0);
        testing::put_target(input, testing::at(bearing_deg, range_nm), bearing_deg, line);
        const DrawList list = drawn(input);
        for (const OccupiedBox& box : list.occupied()) {
          if (box.kind != BoxKind::text) continue;
          for (const Segment& stroke : list.content(Layer::lines).strokes)
            EXPECT_FALSE(stroke.ink == Ink::bright && crosses(box.rect, stroke.from, stroke.to))
                << box.name << " at " << bearing_deg << " deg, " << range_nm << " NM, from " << stroke.from.x << " "
                << stroke.from.y << " to " << stroke.to.x << " " << stroke.to.y;
        }
      }
    }
  }
}

TEST(Designations, TheSteeringLineExtendsBackwardsFromTheTarget) {
  const DrawList without = drawn(testing::operating(Mode::rbm, 40.0));
  struct Case {
    double approach_deg;
    float x, y;  // of the far end
  };
  // Ground track 030 is up, the target at (240, 240). An approach on 030 comes from below, one on 120 from the left.
  for (const Case& one : {Case{30.0, 240.0F, 310.0F}, Case{120.0, 170.0F, 240.0F}, Case{300.0, 310.0F, 240.0F}}) {
    DisplayInput input = with_steering_line(SteeringLine::line_of_sight, one.approach_deg);
    const auto line = testing::more_strokes(drawn(input), without);
    ASSERT_FALSE(line.empty());
    EXPECT_NEAR(line[0].to.x, one.x, 0.3F) << one.approach_deg;
    EXPECT_NEAR(line[0].to.y, one.y, 0.3F) << one.approach_deg;
  }
}

// Box of the magnetic heading beneath the target, which reads `text`. The magnetic variation is 13 deg.
Rect heading_on(double approach_deg, const std::string& text) {
  DisplayInput input = with_steering_line(SteeringLine::line_of_sight, approach_deg);
  input.state.magnetic_variation_deg = 13.0;
  input.state.flags |= databuffer::kVariationKnown;
  const DrawList list = drawn(input);
  const auto heading = std::ranges::find(list.occupied(), text, &OccupiedBox::name);
  EXPECT_NE(heading, list.occupied().end()) << text;
  return heading == list.occupied().end() ? Rect{} : heading->rect;
}

TEST(Designations, TheMagneticHeadingStandsBeneathTheTarget) {
  const Rect heading = heading_on(134.6, "122\u00b0 MAG");
  EXPECT_NEAR((heading.left + heading.right) / 2.0F, 240.0F, 0.2F);
  EXPECT_GT(heading.top, 246.0F);
  EXPECT_LT(heading.bottom, 275.0F);
}

TEST(Designations, WithoutAKnownVariationTheHeadingIsLabelledTrue) {
  const DrawList list = drawn(with_steering_line(SteeringLine::line_of_sight, 134.6));
  EXPECT_NE(std::ranges::find(list.occupied(), "135\u00b0 TRUE", &OccupiedBox::name), list.occupied().end());
}

// Wherever a designated target is on the display, its triangle is drawn. A heading without triangle and name would
// belong to nothing.
TEST(Designations, ADesignatedTargetHasItsTriangleAndNameAnywhereOnTheDisplay) {
  int headings = 0;
  for (const Mode mode : {Mode::rbm, Mode::hrm, Mode::beacon}) {
    for (float x = 0.0F; x <= 480.0F; x += 20.0F) {
      for (float y = 0.0F; y <= 480.0F; y += 20.0F) {
        DisplayInput input = testing::operating(mode, 40.0);
        input.state.flags |= databuffer::kFreeze;
        testing::set_text(input.state.message, "BLIND ZONE");
        testing::put_cursor(input, 30.0, 20.0);
        const geo::GeoPoint position = testing::ground_at(input, {x, y});
        testing::put_target(input, position, 77.0, SteeringLine::line_of_sight);
        testing::add_point(input, "4.", radar::PointKind::target, position);
        const DrawList list = drawn(input);
        const auto is_drawn = [&list](const char* name) {
          return std::ranges::find(list.occupied(), name, &OccupiedBox::name) != list.occupied().end();
        };
        const auto what = ::testing::PrintToString(x) + ", " + ::testing::PrintToString(y);
        ASSERT_TRUE(is_drawn("designated target")) << what;
        ASSERT_TRUE(is_drawn("4.")) << what;
        headings += is_drawn("077\u00b0 TRUE") ? 1 : 0;
        testing::expect_no_overlap(list, what);
      }
    }
  }
  EXPECT_GT(headings, 3 * 25 * 25 * 95 / 100) << "the heading has a place, too";
}

TEST(Designations, TheMagneticHeadingStandsBesideALineThatComesFromBeneath) {
  const Rect heading = heading_on(44.6, "032\u00b0 MAG");
  EXPECT_GT(heading.left, 240.0F) << "the line goes down to the left";
  EXPECT_GT(heading.top, 246.0F);
  EXPECT_LT(heading.bottom, 275.0F);
}

TEST(Designations, TheSteeringLineEndsInAnArrowheadWhileItSlewsAndInACircleOnceFixed) {
  const auto strokes_with = [](SteeringLine line) { return strokes(drawn(with_steering_line(line, 60.0))); };
  const std::size_t without_end = strokes_with(SteeringLine::line_of_sight);
  EXPECT_EQ(strokes_with(SteeringLine::slewing), without_end + 2);
  EXPECT_EQ(strokes_with(SteeringLine::fixed), without_end + 24);
}

TEST(Designations, WithoutATargetOnTheDisplayThereIsNoSteeringLine) {
  DisplayInput input = with_steering_line(SteeringLine::fixed, 60.0);
  const DrawList no_line = drawn(testing::operating(Mode::rbm, 40.0));
  input.state.flags &= ~databuffer::kTargetDesignated;
  EXPECT_EQ(drawn(input), no_line);
  testing::put_target(input, testing::at(210.0, 30.0), 60.0, SteeringLine::fixed);
  EXPECT_EQ(drawn(input), no_line);
}

}  // namespace
}  // namespace yars::display
