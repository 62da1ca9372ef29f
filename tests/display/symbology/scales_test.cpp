// Range arcs, scales with their carets, and the pitch ball.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "display/symbology/symbology.hpp"
#include "tests/display/symbology/symbology_checks.hpp"

namespace yars::display {
namespace {

using radar::Mode;
using testing::bounds_of;
using testing::drawn;
using testing::middle_of;
using testing::more_strokes;
using testing::strokes;

TEST(RangeArcs, AreAtQuartersUnlessTheirSpacingIsConfigured) {
  const std::vector<double> spacing_nm{5, 10, 0.1};
  EXPECT_EQ(arc_spacing(40.0, 3, {}), 0.25);
  EXPECT_EQ(arc_spacing(20.0, 0, spacing_nm), 0.25);
  EXPECT_EQ(arc_spacing(20.0, 1, spacing_nm), 0.5);
  EXPECT_NEAR(arc_spacing(160.0, 9, spacing_nm), 0.08, 1e-9) << "doubled until at least 0.05 of the range";
}

TEST(RangeArcs, EndAtTheRange) {
  const PlanView view{radar::ViewConfiguration{}};
  const auto strokes_of = [&](double spacing) {
    DrawList list;
    draw_range_arcs(view, spacing, list);
    return strokes(list);
  };
  const std::size_t one = strokes_of(5.0);  // spacing beyond the range: only the arc at the range
  EXPECT_GT(one, 0U);
  EXPECT_GT(strokes_of(0.5), one);
  EXPECT_GT(strokes_of(0.4), strokes_of(0.5)) << "arcs at 0.4, 0.8 and 1";
  EXPECT_EQ(strokes_of(0.1), strokes_of(0.1 + 1e-13)) << "no second arc at the range";
}

TEST(Scales, TheAntennaCaretShowsTheAzimuthFromTheGroundTrack) {
  DisplayInput straight = testing::operating(Mode::rbm, 40.0);  // 4 deg of drift to the right
  straight.model.antenna_azimuth_deg = 4.0;
  DisplayInput right = straight;
  right.model.antenna_azimuth_deg = 34.0;
  const Rect middle = bounds_of(more_strokes(drawn(straight), drawn(right)));
  const Rect turned = bounds_of(more_strokes(drawn(right), drawn(straight)));
  EXPECT_NEAR((middle.left + middle.right) / 2.0F, 240.0F, 0.2F);
  EXPECT_NEAR((turned.left + turned.right) / 2.0F, 300.0F, 0.2F);
}

TEST(Scales, UnknownAntennaAnglesDrawNoCaretsAndLeaveListsComparable) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  const std::size_t with_carets = strokes(drawn(input));
  input.model.antenna_azimuth_deg = input.model.antenna_elevation_deg = testing::kNone;
  EXPECT_EQ(strokes(drawn(input)), with_carets - 4);  // two carets of two strokes
  EXPECT_EQ(drawn(input), drawn(input));
}

TEST(Scales, ThePitchBallShowsPitchAboveTheHorizonAndStopsAtTheEdge) {
  const auto ball_of = [](double pitch_deg) {
    DisplayInput input = testing::operating(Mode::rbm, 40.0);
    DisplayInput other = input;
    input.ownship.pitch_deg = pitch_deg;
    other.ownship.pitch_deg = -8.0;
    const Rect ball = bounds_of(more_strokes(drawn(input), drawn(other)));
    return (ball.top + ball.bottom) / 2.0F;
  };
  EXPECT_NEAR(ball_of(0.0), 240.0F, 0.2F);
  EXPECT_NEAR(ball_of(5.0), 200.0F, 0.2F);
  EXPECT_GT(ball_of(80.0), 30.0F);
  EXPECT_FLOAT_EQ(ball_of(80.0), ball_of(60.0));
}

TEST(Scales, ThePitchBallIsRoundSquareOrCrossedOut) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  const std::size_t round = strokes(drawn(input));
  input.nav.flags = databuffer::kNavAttitudeFromAhrs;
  EXPECT_EQ(strokes(drawn(input)), round - 24 + 4);  // a square of 4 strokes replaces a circle of 24
  input.nav.flags = databuffer::kNavAttitudeInvalid;
  EXPECT_EQ(strokes(drawn(input)), round - 2 + 2) << "a cross of 2 strokes replaces the 2 wings";
  DisplayInput valid = input;
  valid.nav.flags = 0;
  EXPECT_NE(drawn(input), drawn(valid));
}

TEST(Scales, TheRangeArcsAreAtQuartersOfTheRange) {
  const DrawList list = drawn(testing::operating(Mode::rbm, 40.0));
  for (const Segment& segment : list.content(Layer::grid).strokes) {
    if (segment.from.x == 240.0F && segment.to.x == 240.0F) continue;  // the zero azimuth line
    const double radius = std::hypot(segment.from.x - 240.0, segment.from.y - 440.0);
    EXPECT_NEAR(radius, std::round(radius / 100.0) * 100.0, 0.15);
  }
}

}  // namespace
}  // namespace yars::display
