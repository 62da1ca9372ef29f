#include "display/symbology.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "display/scales.hpp"
#include "tests/display/symbology_checks.hpp"

namespace yars::display {
namespace {

using radar::Mode;
using ::testing::Contains;
using testing::crowded;
using testing::drawn;
using testing::expect_no_overlap;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;
using testing::strokes;
using testing::words;

constexpr std::array kModes{Mode::rbm, Mode::hrm,        Mode::patch,   Mode::beacon,
                            Mode::pvu, Mode::air_to_air, Mode::ranging, Mode::menu};
constexpr std::array kRanges{4.7, 10.0, 20.0, 40.0, 80.0, 160.0};

TEST(Symbology, NothingOverlapsInAnyModeAtAnyRangeWithEverythingLit) {
  for (const Mode mode : kModes) {
    for (const double range_nm : kRanges) {
      const std::string what = std::string(radar::name_of(mode)) + " at " + std::to_string(range_nm);
      expect_no_overlap(drawn(crowded(mode, range_nm)), what);
    }
  }
}

TEST(Symbology, NothingOverlapsInStandby) {
  for (const Mode mode : kModes) {
    GlassInput input = crowded(mode, 160.0);
    input.state.power = static_cast<std::uint8_t>(radar::Power::standby);
    expect_no_overlap(drawn(input), "standby");
  }
}

TEST(Symbology, OffShowsNothing) {
  GlassInput input = crowded(Mode::rbm, 40.0);
  input.state_machine_alive = true;
  input.state.power = static_cast<std::uint8_t>(radar::Power::off);
  const DrawList list = drawn(input);
  EXPECT_EQ(strokes(list), 0U);
  EXPECT_THAT(list.video_steps(), IsEmpty());
}

TEST(Symbology, ASetWithoutAStateMachineSaysSoEvenWhenTheRadarIsOff) {
  GlassInput input;
  input.state_machine_alive = false;
  EXPECT_THAT(words(input), ::testing::ElementsAre("NO STATE MACHINE"));
}

TEST(Symbology, StandbyShowsLegendsAndStbyAndNoScales) {
  GlassInput input = testing::operating(Mode::rbm, 40.0);
  input.state.power = static_cast<std::uint8_t>(radar::Power::standby);
  EXPECT_THAT(words(input), IsSupersetOf({"RBM", "DCL", "GAIN 3", "STBY"}));
  EXPECT_THAT(words(input), Not(Contains("azimuth scale")));
  EXPECT_THAT(drawn(input).video_steps(), IsEmpty());
  EXPECT_FALSE(shows_video(input.state));
}

TEST(Symbology, EachModeHasTheRowsOfItsColumn) {
  struct Column {
    Mode mode;
    bool arcs, scales, gray_scale, video;
  };
  for (const Column& column :
       {Column{Mode::rbm, true, true, true, true}, Column{Mode::hrm, true, true, true, true},
        Column{Mode::patch, false, true, false, false}, Column{Mode::beacon, true, true, false, true},
        Column{Mode::pvu, false, true, false, false}, Column{Mode::air_to_air, false, false, false, false},
        Column{Mode::ranging, false, false, false, false}, Column{Mode::menu, false, false, false, false}}) {
    const GlassInput input = testing::operating(column.mode, 40.0);
    const DrawList list = drawn(input);
    const auto said = words(list);
    const auto has = [&](const char* word) { return std::ranges::count(said, word) == 1; };
    const std::string mode(radar::name_of(column.mode));
    EXPECT_EQ(!list.content(Layer::grid).strokes.empty(), column.arcs) << mode;
    EXPECT_EQ(has("azimuth scale"), column.scales) << mode;
    EXPECT_EQ(has("elevation scale"), column.scales) << mode;
    EXPECT_EQ(list.video_steps().size(), column.gray_scale ? 8U : 0U) << mode;
    EXPECT_EQ(shows_video(input.state), column.video) << mode;
  }
}

TEST(RangeArcs, StandAtQuartersUnlessTheConfigurationSpacesThem) {
  const std::vector<double> spacing_nm{5, 10, 0.1};
  EXPECT_EQ(arc_spacing(40.0, 3, {}), 0.25);
  EXPECT_EQ(arc_spacing(20.0, 0, spacing_nm), 0.25);
  EXPECT_EQ(arc_spacing(20.0, 1, spacing_nm), 0.5);
  EXPECT_NEAR(arc_spacing(160.0, 9, spacing_nm), 0.08, 1e-9) << "doubled until the arcs stand apart";
}

TEST(RangeArcs, EndAtTheRange) {
  const GlassView view{radar::ViewConfiguration{}};
  const auto strokes_of = [&](double spacing) {
    DrawList list;
    draw_range_arcs(view, spacing, list);
    return strokes(list);
  };
  const std::size_t one = strokes_of(5.0);  // beyond the range: the range alone
  EXPECT_GT(one, 0U);
  EXPECT_GT(strokes_of(0.5), one);
  EXPECT_GT(strokes_of(0.4), strokes_of(0.5)) << "at 0.4, 0.8 and 1";
  EXPECT_EQ(strokes_of(0.1), strokes_of(0.1 + 1e-13)) << "no arc beside that of the range";
}

TEST(Symbology, EveryLegendStandsInWordsAsTheStateHasIt) {
  for (const Mode mode : kModes) {
    const auto said = words(testing::operating(mode, 40.0));
    for (const auto& [button, legend] : testing::legends_of(mode)) {
      EXPECT_THAT(said, Contains(legend)) << radar::name_of(mode) << " button " << button;
    }
  }
}

TEST(Symbology, ABoxedLegendHasFourStrokesMore) {
  GlassInput input = testing::operating(Mode::rbm, 40.0);
  const std::size_t plain = strokes(drawn(input));
  input.state.boxed = 1U << 18U;
  EXPECT_EQ(strokes(drawn(input)), plain + 4);
}

TEST(Symbology, TheCursorReadsMagneticBearingAndTenthsOfMiles) {
  GlassInput input = testing::operating(Mode::rbm, 40.0);
  EXPECT_THAT(words(input), Not(Contains("022\u00b0")));
  testing::put_cursor(input, 22.4, 23.44);
  EXPECT_THAT(words(input), IsSupersetOf({"022\u00b0", "23.4NM"}));
  input.state.cursor_bearing_deg = 359.6;
  EXPECT_THAT(words(input), Contains("000\u00b0"));
}

TEST(Symbology, RangeWindowBrightnessAndTimerAreRead) {
  GlassInput input = testing::operating(Mode::rbm, 4.7);
  input.state.window_nm = 0.67;
  input.state.brightness = 11;
  input.model.map_timer_s = 11.2;
  EXPECT_THAT(words(input), IsSupersetOf({"4.7", ".67", "11", "12 SEC"}));
  input.state.window_nm = 0.0;
  input.model.map_timer_s = testing::kNone;
  EXPECT_THAT(words(input), Not(Contains(".67")));
  EXPECT_THAT(words(input), Not(Contains("12 SEC")));
}

TEST(Symbology, FreezeIsShownFromTheCommandOn) {
  GlassInput input = testing::operating(Mode::rbm, 40.0);
  EXPECT_THAT(words(input), Not(Contains("FREEZE")));
  input.state.flags |= databuffer::kFreeze;
  EXPECT_THAT(words(input), Contains("FREEZE"));
}

TEST(Symbology, WhatHasGoneSilentIsNamed) {
  GlassInput input = testing::operating(Mode::rbm, 40.0);
  input.model_alive = false;
  EXPECT_THAT(words(input), Contains("NO MODEL"));
  EXPECT_THAT(words(input), Not(Contains("NO OWNSHIP")));
  input.ownship_fresh = false;
  EXPECT_THAT(words(input), Contains("NO OWNSHIP"));
}

// Middle of what differs between two lists' symbols.
Rect changed(const DrawList& with, const DrawList& without) {
  Rect bounds{kGlassUnits, kGlassUnits, 0.0F, 0.0F};
  const auto& base = without.content(Layer::symbols).strokes;
  for (const Segment& segment : with.content(Layer::symbols).strokes) {
    if (std::ranges::find(base, segment) != base.end()) continue;
    for (const Point& point : {segment.from, segment.to}) {
      bounds = {std::min(bounds.left, point.x), std::min(bounds.top, point.y), std::max(bounds.right, point.x),
                std::max(bounds.bottom, point.y)};
    }
  }
  return bounds;
}

TEST(Symbology, TheCursorIsAnOpenPlusOnItsGroundPoint) {
  GlassInput input = testing::operating(Mode::rbm, 40.0);
  input.state.flags |= databuffer::kCursorValid;
  const geo::GeoPoint place = testing::at(30.0, 20.0);
  input.state.cursor_latitude_deg = testing::at(30.0, -30.0).latitude_deg;
  input.state.cursor_longitude_deg = testing::at(30.0, -30.0).longitude_deg;
  const DrawList away = drawn(input);
  input.state.cursor_latitude_deg = place.latitude_deg;
  input.state.cursor_longitude_deg = place.longitude_deg;
  const DrawList here = drawn(input);
  EXPECT_EQ(strokes(here), strokes(away) + 4);
  const Rect plus = changed(here, away);
  EXPECT_NEAR((plus.left + plus.right) / 2.0F, 240.0F, 0.2F);
  EXPECT_NEAR((plus.top + plus.bottom) / 2.0F, 240.0F, 0.2F);
  for (const Segment& segment : here.content(Layer::symbols).strokes) {
    const bool at_middle = std::abs(segment.from.x - 240.0F) < 4.0F && std::abs(segment.from.y - 240.0F) < 4.0F;
    EXPECT_FALSE(at_middle) << "the plus is open";
  }
}

TEST(Symbology, PointsStandAtTheirPlacesAndOffTheGlassAtNone) {
  GlassInput input = testing::operating(Mode::rbm, 40.0);
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

std::size_t strokes_of_point(radar::PointKind kind, const std::string& name, const radar::RadarConfiguration& with) {
  GlassInput input = testing::operating(Mode::rbm, 40.0);
  const std::size_t before = strokes(drawn(input, with));
  testing::add_point(input, name, kind, testing::at(30.0, 30.0));
  const std::size_t named = strokes(drawn(input, with)) - before;
  // The name's strokes are those of the same text as a message.
  testing::set_text(input.state.message, name);
  return named - (strokes(drawn(input, with)) - before - named);
}

TEST(Symbology, SteerIsACircleInitialASquareTargetATriangleAndOffsetsAreDashed) {
  using radar::PointKind;
  radar::RadarConfiguration configuration;
  configuration.route.push_back({"2", PointKind::initial, {}, 0.0});
  EXPECT_EQ(strokes_of_point(PointKind::steer, "1", configuration), 24U);
  EXPECT_EQ(strokes_of_point(PointKind::initial, "2", configuration), 4U);
  EXPECT_EQ(strokes_of_point(PointKind::target, "3.", configuration), 3U);
  const std::size_t steer_offset = strokes_of_point(PointKind::steer_offset, "1.1", configuration);
  const std::size_t initial_offset = strokes_of_point(PointKind::steer_offset, "2.1", configuration);
  const std::size_t target_offset = strokes_of_point(PointKind::target_offset, "3.01", configuration);
  EXPECT_NE(steer_offset, initial_offset) << "the offset of an initial point is a square";
  EXPECT_GT(initial_offset, 4U);
  EXPECT_GT(target_offset, 3U);
}

TEST(Symbology, NamesKeepClearOfLegendsAndOfEachOther) {
  GlassInput input = testing::operating(Mode::rbm, 40.0);
  input.state.flags |= databuffer::kFreeze;
  for (int i = 0; i < 5; ++i) {
    testing::add_point(input, "2.0" + std::to_string(i + 1), radar::PointKind::target_offset,
                       testing::at(30.0 + 6.0 * i, 20.0));
  }
  expect_no_overlap(drawn(input), "five points in a row");
}

TEST(Symbology, NamesKeepClearOfTheCursor) {
  GlassInput input = testing::operating(Mode::rbm, 40.0);
  testing::put_cursor(input, 30.0, 20.0);
  // About the cursor in the middle of the glass, so that the first place for a name is on one of its arms.
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

TEST(Symbology, TheAntennaCaretPointsAtTheAzimuthAgainstTheGroundTrack) {
  GlassInput straight = testing::operating(Mode::rbm, 40.0);  // 4 deg of drift to the right
  straight.model.antenna_azimuth_deg = 4.0;
  GlassInput right = straight;
  right.model.antenna_azimuth_deg = 34.0;
  const Rect middle = changed(drawn(straight), drawn(right));
  const Rect turned = changed(drawn(right), drawn(straight));
  EXPECT_NEAR((middle.left + middle.right) / 2.0F, 240.0F, 0.2F);
  EXPECT_NEAR((turned.left + turned.right) / 2.0F, 300.0F, 0.2F);
}

TEST(Symbology, AnAntennaThatTellsNothingHasNoCaretAndTheGlassStandsStill) {
  GlassInput input = testing::operating(Mode::rbm, 40.0);
  const std::size_t with_carets = strokes(drawn(input));
  input.model.antenna_azimuth_deg = input.model.antenna_elevation_deg = testing::kNone;
  EXPECT_EQ(strokes(drawn(input)), with_carets - 4);
  EXPECT_EQ(drawn(input), drawn(input));
}

TEST(Symbology, ThePitchBallStandsAgainstTheHorizonAndStopsAtTheEdge) {
  const auto ball_of = [](double pitch_deg) {
    GlassInput input = testing::operating(Mode::rbm, 40.0);
    GlassInput other = input;
    input.ownship.pitch_deg = pitch_deg;
    other.ownship.pitch_deg = -8.0;
    const Rect ball = changed(drawn(input), drawn(other));
    return (ball.top + ball.bottom) / 2.0F;
  };
  EXPECT_NEAR(ball_of(0.0), 240.0F, 0.2F);
  EXPECT_NEAR(ball_of(5.0), 200.0F, 0.2F);
  EXPECT_GT(ball_of(80.0), 30.0F);
  EXPECT_FLOAT_EQ(ball_of(80.0), ball_of(60.0));
}

TEST(Symbology, ThePitchBallIsRoundSquareOrCrossedOut) {
  GlassInput input = testing::operating(Mode::rbm, 40.0);
  const std::size_t round = strokes(drawn(input));
  input.nav.flags = databuffer::kNavAttitudeFromAhrs;
  EXPECT_EQ(strokes(drawn(input)), round - 24 + 4);
  input.nav.flags = databuffer::kNavAttitudeInvalid;
  EXPECT_EQ(strokes(drawn(input)), round - 2 + 2) << "a cross of two in the place of two wings";
  GlassInput valid = input;
  valid.nav.flags = 0;
  EXPECT_NE(drawn(input), drawn(valid));
}

TEST(Symbology, TheRangeArcsAreAtQuartersOfTheRange) {
  const DrawList list = drawn(testing::operating(Mode::rbm, 40.0));
  for (const Segment& segment : list.content(Layer::grid).strokes) {
    if (segment.from.x == 240.0F && segment.to.x == 240.0F) continue;  // the zero azimuth line
    const double radius = std::hypot(segment.from.x - 240.0, segment.from.y - 440.0);
    EXPECT_NEAR(radius, std::round(radius / 100.0) * 100.0, 0.15);
  }
}

TEST(Symbology, AnUnterminatedTextEndsWithItsField) {
  GlassInput input = testing::operating(Mode::rbm, 40.0);
  std::ranges::fill(input.state.legends[6], 'X');
  std::ranges::fill(input.state.message, 'Y');
  EXPECT_THAT(words(input), IsSupersetOf({std::string(8, 'X'), std::string(32, 'Y')}));
}

TEST(Symbology, AMotionThatNobodySeesLeavesTheListEqual) {
  GlassInput input = testing::operating(Mode::rbm, 160.0);
  testing::put_cursor(input, 30.0, 80.0);
  const DrawList before = drawn(input);
  input.ownship.latitude_deg += 1e-7;
  input.nav.mission_latitude_deg += 1e-7;
  EXPECT_EQ(drawn(input), before);
  input.ownship.latitude_deg += 1e-1;
  input.nav.mission_latitude_deg += 1e-1;
  EXPECT_NE(drawn(input), before);
}

}  // namespace
}  // namespace yars::display
