// Tests of the symbols of HRM: positions on a patch map, azimuth limit balls, and the outline of a commanded window.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/display/symbology/symbology_checks.hpp"

namespace yars::display {
namespace {

using radar::Mode;

using testing::bounds_of;
using testing::drawn;
using testing::middle_of;
using testing::words;

std::vector<Segment> more_strokes(const DisplayInput& with, const DisplayInput& without) {
  return testing::more_strokes(drawn(with), drawn(without));
}

// Input with a patch map: window 4.7 NM, its centre 20 NM from the aircraft on the bearing 060.
DisplayInput patch() {
  DisplayInput input = testing::operating(Mode::patch, 40.0);
  testing::put_map(input, 60.0, 20.0, 4.7);
  return input;
}

// Position at these distances from the aircraft: along the map's line of sight, and to the right of it.
geo::GeoPoint on_map(const DisplayInput& input, double forward_nm, double right_nm) {
  const double bearing_deg = input.map.up_deg + std::atan2(right_nm, forward_nm) / geo::kRadiansPerDegree;
  return testing::at(bearing_deg, std::hypot(forward_nm, right_nm));
}

void put_cursor(DisplayInput& input, geo::GeoPoint position) {
  input.state.flags |= databuffer::kCursorValid;
  input.state.cursor_latitude_deg = position.latitude_deg;
  input.state.cursor_longitude_deg = position.longitude_deg;
}

TEST(MapSymbology, TheWindowFillsTheDisplayWithTheLineOfSightUp) {
  struct Case {
    double forward_nm, right_nm;
    float x, y;
  };
  for (const Case& one : {Case{20.0, 0.0, 240.0F, 240.0F}, Case{20.0 + 4.7 / 4, 0.0, 240.0F, 120.0F},
                          Case{20.0, 4.7 / 4, 360.0F, 240.0F}, Case{20.0 - 4.7 / 4, -4.7 / 4, 120.0F, 360.0F}}) {
    DisplayInput with = patch();
    DisplayInput without = with;
    put_cursor(with, on_map(with, one.forward_nm, one.right_nm));
    put_cursor(without, on_map(with, 60.0, 0.0));
    const Point at = middle_of(bounds_of(more_strokes(with, without)));
    EXPECT_NEAR(at.x, one.x, 0.2F);
    EXPECT_NEAR(at.y, one.y, 0.2F);
  }
}

TEST(MapSymbology, TheFrameOfAMapStaysWhileTheAircraftFliesOn) {
  DisplayInput input = patch();
  put_cursor(input, on_map(input, 21.0, 0.5));
  DisplayInput later = input;
  later.ownship.latitude_deg += 0.05;
  later.nav.mission_latitude_deg += 0.05;
  EXPECT_EQ(more_strokes(input, later).size(), more_strokes(later, input).size());
  const auto plus_at = [](const DisplayInput& shown) {
    DisplayInput bare = shown;
    bare.state.cursor_latitude_deg = -30.0;
    return middle_of(bounds_of(more_strokes(shown, bare)));
  };
  EXPECT_NEAR(plus_at(input).x, plus_at(later).x, 0.2F);
  EXPECT_NEAR(plus_at(input).y, plus_at(later).y, 0.2F);
}

TEST(MapSymbology, OnlySequencePointsOnTheMapAreDrawn) {
  DisplayInput input = patch();
  testing::add_point(input, "3.", radar::PointKind::target, on_map(input, 20.5, 0.3));
  testing::add_point(input, "4", radar::PointKind::steer, on_map(input, 30.0, 0.0));
  const auto texts = words(input);
  EXPECT_THAT(texts, ::testing::Contains("3."));
  EXPECT_THAT(texts, ::testing::Not(::testing::Contains("4")));
}

TEST(MapSymbology, AMapIsShownInItsFormatInAirToAirRangingAndHrm) {
  for (const Mode mode : {Mode::air_to_air, Mode::ranging, Mode::hrm}) {
    DisplayInput input = testing::operating(mode, 40.0);
    const auto without = words(input);
    testing::put_map(input, 60.0, 20.0, 4.7);
    EXPECT_TRUE(shows_map(input)) << radar::name_of(mode);
    EXPECT_FALSE(shows_video(input.state)) << radar::name_of(mode);
    EXPECT_THAT(words(input), ::testing::Contains("azimuth scale"));
    EXPECT_THAT(drawn(input).video_steps(), ::testing::IsEmpty());
  }
}

TEST(MapSymbology, AMapSaysItsOwnWidthAlsoWhileAnotherWindowIsSelected) {
  DisplayInput input = patch();
  input.state.window_nm = 0.67;
  EXPECT_THAT(words(input), ::testing::IsSupersetOf({"WIDTH", "4.7NM", ".67"}));
  input.map = {};
  EXPECT_THAT(words(input), ::testing::Not(::testing::Contains("WIDTH"))) << "the map could not be read";
  EXPECT_THAT(words(testing::operating(Mode::rbm, 40.0)), ::testing::Not(::testing::Contains("WIDTH")));
}

TEST(MapSymbology, ACursorOffTheDisplayIsNamedBelowItsReadout) {
  DisplayInput input = patch();
  EXPECT_THAT(words(input), ::testing::Not(::testing::Contains("OFF THE"))) << "no cursor is known";
  put_cursor(input, on_map(input, 20.5, 0.0));
  EXPECT_THAT(words(input), ::testing::Not(::testing::Contains("OFF THE")));
  put_cursor(input, on_map(input, 23.0, 0.0));
  EXPECT_THAT(words(input), ::testing::IsSupersetOf({"OFF THE", "DISPLAY"}));
  DisplayInput scan = testing::operating(Mode::rbm, 10.0);
  testing::put_cursor(scan, 30.0, 12.0);
  EXPECT_THAT(words(scan), ::testing::IsSupersetOf({"OFF THE", "DISPLAY"}));
  scan.state.range_nm = 20.0;
  EXPECT_THAT(words(scan), ::testing::Not(::testing::Contains("OFF THE")));
}

TEST(MapSymbology, InStandbyNoMapIsShown) {
  DisplayInput input = patch();
  EXPECT_TRUE(shows_map(input));
  input.state.power = static_cast<std::uint8_t>(radar::Power::standby);
  EXPECT_FALSE(shows_map(input));
}

TEST(MapSymbology, WithoutTheMapThatTheStateNamesNoGroundSymbolIsDrawn) {
  DisplayInput input = patch();
  input.map = {};
  put_cursor(input, testing::at(60.0, 20.0));
  DisplayInput without = input;
  without.state.flags = 0;
  EXPECT_FALSE(shows_map(input));
  for (const Segment& segment : more_strokes(input, without))
    EXPECT_LT(segment.from.y, 40.0F) << "only the cursor readout";
}

// x of the centres of the two azimuth limit balls, left and right. The azimuth scale has 2 units a degree; 240 is the
// ground track.
std::array<float, 2> balls(DisplayInput input) {
  std::vector<float> x;
  const DrawList list = drawn(input);
  for (const Segment& segment : list.content(Layer::symbols).strokes) {
    const Point middle{(segment.from.x + segment.to.x) / 2.0F, (segment.from.y + segment.to.y) / 2.0F};
    const bool short_side = std::hypot(segment.from.x - segment.to.x, segment.from.y - segment.to.y) < 1.5F;
    if (short_side && std::abs(middle.y - 441.5F) < 3.5F) x.push_back(middle.x);
  }
  std::ranges::sort(x);
  EXPECT_EQ(x.size(), 48U) << "two circles of 24 sides";
  const auto mean = [&](std::size_t from, std::size_t to) {
    float sum = 0.0F;
    for (std::size_t i = from; i < to; ++i) sum += x[i];
    return sum / static_cast<float>(to - from);
  };
  return {mean(0, x.size() / 2), mean(x.size() / 2, x.size())};
}

TEST(LimitBalls, OnTheHrmPpiAreAtTheEdgesOfTheScan) {
  DisplayInput input = testing::operating(Mode::hrm, 40.0);
  input.model.scan_centre_deg = 30.0 + 37.5;  // the track is 030
  input.model.scan_width_deg = 25.0;
  EXPECT_NEAR(balls(input)[0], 240.0F + 2.0F * 25.0F, 0.2F);
  EXPECT_NEAR(balls(input)[1], 240.0F + 2.0F * 50.0F, 0.2F);
}

TEST(LimitBalls, OnAPatchMapAreAtTheSidesOfTheMapAsSeenFromTheAircraft) {
  const double half_deg = std::atan2(4.7 / 2.0, 20.0) / geo::kRadiansPerDegree;
  const auto at = balls(patch());
  EXPECT_NEAR(at[0], 240.0 + 2.0 * (30.0 - half_deg), 0.2);
  EXPECT_NEAR(at[1], 240.0 + 2.0 * (30.0 + half_deg), 0.2);
}

TEST(LimitBalls, PassSixtyDegreesAndStopAtTheEdgeOfTheDisplay) {
  DisplayInput input = patch();
  const auto fly_on = [&input](double distance_nm) {
    const geo::GeoPoint position = testing::at(30.0, distance_nm);
    input.ownship.latitude_deg = position.latitude_deg;
    input.ownship.longitude_deg = position.longitude_deg;
  };
  fly_on(14.0);
  EXPECT_GT(balls(input)[1], 240.0F + 2.0F * 60.0F);
  fly_on(60.0);
  EXPECT_NEAR(balls(input)[1], 470.0F, 0.2F) << "at the right edge";
  EXPECT_NEAR(balls(input)[0], 458.0F, 0.2F) << "beside it";
}

// A map of 0.67 NM at 20 NM is 1.9 deg wide, 4 units. The balls have a diameter of 6 units.
TEST(LimitBalls, OfANarrowMapStandSideBySideClearOfTheCaret) {
  DisplayInput input = testing::operating(Mode::patch, 20.0);
  testing::put_map(input, 60.0, 20.0, 0.67);
  const auto at = balls(input);
  EXPECT_NEAR((at[0] + at[1]) / 2.0F, 240.0F + 2.0F * 30.0F, 0.2F);
  EXPECT_NEAR(at[1] - at[0], 12.0F, 0.2F);
  DisplayInput pointing = input;
  pointing.model.antenna_azimuth_deg = 34.0;  // to the map
  const Rect caret = testing::bounds_of(testing::more_strokes(drawn(pointing), drawn(input)));
  const auto list = drawn(pointing);
  for (const OccupiedBox& box : list.occupied()) {
    if (box.name != "limit ball") continue;
    EXPECT_LT(caret.bottom + 0.675F, box.rect.top);
  }
}

TEST(LimitBalls, FollowTheMapInFormation) {
  DisplayInput input = patch();
  testing::put_forming_map(input, 10.0, 20.0, 4.7);
  EXPECT_LT(balls(input)[1], 240.0F);
}

TEST(LimitBalls, AreDrawnInHrmOnly) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  DisplayInput other = input;
  other.model.scan_centre_deg = 70.0;
  other.model.scan_width_deg = 25.0;
  EXPECT_EQ(drawn(input), drawn(other));
}

TEST(WindowOutline, IsASquareOfTheWindowAlongTheLineOfSight) {
  for (const Mode mode : {Mode::rbm, Mode::hrm}) {
    DisplayInput without = testing::operating(mode, 40.0);
    without.model.map_window_nm = 10.0;
    DisplayInput with = without;
    testing::put_forming_map(with, 60.0, 20.0, 10.0);
    without.model.map_latitude_deg = with.model.map_latitude_deg;
    without.model.map_longitude_deg = with.model.map_longitude_deg;
    const auto square = more_strokes(with, without);
    ASSERT_EQ(square.size(), 4U);
    for (const Segment& side : square) {
      // The range of 40 NM is 400 units long, so the window of 10 NM is 100.
      EXPECT_NEAR(std::hypot(side.to.x - side.from.x, side.to.y - side.from.y), 100.0F, 0.2F);
      // The track is 030: the line of sight leans 30 deg to the right.
      const double lean_deg = std::atan2(side.to.x - side.from.x, side.from.y - side.to.y) / geo::kRadiansPerDegree;
      EXPECT_NEAR(std::fmod(lean_deg + 360.0, 90.0), 30.0, 0.2);
    }
    const Point middle = middle_of(bounds_of(square));
    EXPECT_NEAR(middle.x, 240.0 + 200.0 * 0.5, 0.3);
    EXPECT_NEAR(middle.y, 440.0 - 200.0 * std::sqrt(0.75), 0.3);
  }
}

TEST(WindowOutline, OnAPatchMapIsInTheFrameOfTheMap) {
  DisplayInput without = patch();
  without.model.map_window_nm = 4.7 / 2;
  DisplayInput with = without;
  testing::put_forming_map(with, 60.0, 20.0, 4.7 / 2);
  without.model.map_latitude_deg = with.model.map_latitude_deg;
  without.model.map_longitude_deg = with.model.map_longitude_deg;
  const Rect square = bounds_of(more_strokes(with, without));
  EXPECT_NEAR(square.left, 120.0F, 0.3F);
  EXPECT_NEAR(square.top, 120.0F, 0.3F);
  EXPECT_NEAR(square.right, 360.0F, 0.3F);
  EXPECT_NEAR(square.bottom, 360.0F, 0.3F);
}

TEST(WindowOutline, IsAbsentForAReMapAndBeforeTheModelHasLatchedTheCommand) {
  DisplayInput input = patch();
  testing::put_forming_map(input, 60.0, 20.0, 2.0);
  DisplayInput re_map = input;
  re_map.state.flags = 0;
  EXPECT_EQ(more_strokes(input, re_map).size(), 4U);
  DisplayInput not_yet = input;
  not_yet.state.map_request += 1;
  EXPECT_EQ(more_strokes(input, not_yet).size(), 4U);
}

TEST(MapTimerReadout, RoundsUpAndFollowsRule6) {
  DisplayInput input = testing::operating(Mode::hrm, 40.0);
  input.model.map_timer_s = 11.2;
  EXPECT_THAT(words(input), ::testing::Contains("12 SEC"));
  input.state.cursor_function = static_cast<std::uint8_t>(radar::CursorFunction::update);
  EXPECT_THAT(words(input), ::testing::Not(::testing::Contains("12 SEC")));
}

}  // namespace
}  // namespace yars::display
