// Legends, readouts and notices of the display in each power state and mode.
#include "display/symbology/symbology.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "tests/display/symbology/symbology_checks.hpp"

namespace yars::display {
namespace {

using radar::Mode;
using ::testing::Contains;
using testing::crowded;
using testing::drawn;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;
using testing::strokes;
using testing::words;

constexpr std::array kModes{Mode::rbm, Mode::hrm,        Mode::patch,   Mode::beacon,
                            Mode::pvu, Mode::air_to_air, Mode::ranging, Mode::menu};

TEST(Symbology, OffShowsNothingButHowToSwitchOn) {
  DisplayInput input = crowded(Mode::rbm, 40.0);
  input.state_machine_alive = true;
  input.state.power = static_cast<std::uint8_t>(radar::Power::off);
  input.hints = false;
  const DrawList list = drawn(input);
  EXPECT_EQ(strokes(list), 0U);
  EXPECT_THAT(list.video_steps(), IsEmpty());
  input.hints = true;
  EXPECT_GT(strokes(drawn(input)), 0U);
}

TEST(Symbology, AMissingStateMachineIsShownEvenWhenTheRadarIsOff) {
  DisplayInput input;
  input.state_machine_alive = false;
  EXPECT_THAT(words(input), ::testing::ElementsAre("NO STATE MACHINE", "START STATE-MACHINE; YARS STATUS SAYS MORE"));
}

TEST(Symbology, StandbyShowsLegendsAndStbyAndNoScales) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  input.state.power = static_cast<std::uint8_t>(radar::Power::standby);
  EXPECT_THAT(words(input), IsSupersetOf({"RBM", "DCL", "GAIN 3", "STBY"}));
  EXPECT_THAT(words(input), Not(Contains("azimuth scale")));
  EXPECT_THAT(drawn(input).video_steps(), IsEmpty());
  EXPECT_FALSE(shows_video(input.state));
}

// The modes are those of the column "in" of the table docs/pilots_manual.md#symbology.
TEST(Symbology, EachModeShowsTheElementsOfItsColumn) {
  struct Column {
    Mode mode;
    bool arcs, scales, gray_scale, video;
  };
  for (const Column& column :
       {Column{Mode::rbm, true, true, true, true}, Column{Mode::hrm, true, true, true, true},
        Column{Mode::patch, false, true, false, false}, Column{Mode::beacon, true, true, false, true},
        Column{Mode::pvu, false, true, false, false}, Column{Mode::air_to_air, false, false, false, false},
        Column{Mode::ranging, false, false, false, false}, Column{Mode::menu, false, false, false, false}}) {
    const DisplayInput input = testing::operating(column.mode, 40.0);
    const DrawList list = drawn(input);
    const auto shown = words(list);
    const auto has = [&](const char* word) { return std::ranges::count(shown, word) == 1; };
    const std::string mode(radar::name_of(column.mode));
    EXPECT_EQ(!list.content(Layer::grid).strokes.empty(), column.arcs) << mode;
    EXPECT_EQ(has("azimuth scale"), column.scales) << mode;
    EXPECT_EQ(has("elevation scale"), column.scales) << mode;
    EXPECT_EQ(list.video_steps().size(), column.gray_scale ? 8U : 0U) << mode;
    EXPECT_EQ(shows_video(input.state), column.video) << mode;
  }
}

TEST(Symbology, EveryLegendOfTheStateIsShown) {
  for (const Mode mode : kModes) {
    const auto shown = words(testing::operating(mode, 40.0));
    for (const auto& [button, legend] : testing::legends_of(mode)) {
      EXPECT_THAT(shown, Contains(legend)) << radar::name_of(mode) << " button " << button;
    }
  }
}

TEST(Symbology, ABoxedLegendHasFourStrokesMore) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  const std::size_t plain = strokes(drawn(input));
  input.state.boxed = 1U << 18U;
  EXPECT_EQ(strokes(drawn(input)), plain + 4);
}

TEST(Symbology, TheCursorReadoutHasMagneticBearingAndTenthsOfMiles) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  input.state.flags |= databuffer::kVariationKnown;
  EXPECT_THAT(words(input), Not(Contains("022\u00b0")));
  testing::put_cursor(input, 22.4, 23.44);
  EXPECT_THAT(words(input), IsSupersetOf({"022\u00b0", "MAG", "23.4NM"}));
  input.state.cursor_bearing_deg = 359.6;
  EXPECT_THAT(words(input), IsSupersetOf({"000\u00b0", "MAG"}));
  input.state.flags &= ~databuffer::kVariationKnown;
  EXPECT_THAT(words(input), IsSupersetOf({"000\u00b0", "TRUE"})) << "no variation is known";
}

TEST(Symbology, RangeWindowBrightnessAndTimerAreShown) {
  DisplayInput input = testing::operating(Mode::rbm, 4.7);
  input.state.window_nm = 0.67;
  input.state.brightness = 11;
  input.model.map_timer_s = 11.2;
  EXPECT_THAT(words(input), IsSupersetOf({"4.7", ".67", "11", "12 SEC"}));
  input.state.window_nm = 0.0;
  input.model.map_timer_s = testing::kNone;
  EXPECT_THAT(words(input), Not(Contains(".67")));
  EXPECT_THAT(words(input), Not(Contains("12 SEC")));
}

TEST(Symbology, TheWindowIsShownInEveryModeThatCanStepIt) {
  for (const Mode mode : {Mode::rbm, Mode::hrm, Mode::patch, Mode::beacon, Mode::pvu}) {
    DisplayInput input = testing::operating(mode, 40.0);
    input.state.window_nm = 3.3;
    EXPECT_THAT(words(input), Contains("3.3")) << radar::name_of(mode);
  }
}

TEST(Symbology, PvuShowsTheTimeAndProgressOfAFormingMap) {
  DisplayInput input = testing::operating(Mode::pvu, 40.0);
  input.state.resume_mode = static_cast<std::uint8_t>(Mode::pvu);
  input.model.map_timer_s = 11.2;
  EXPECT_THAT(words(input), Not(Contains("MAP")));
  EXPECT_THAT(words(input), Not(Contains("12 SEC"))) << "PVU has no cursor, and no map forms";
  testing::put_forming_map(input, 40.0, 20.0, 4.7);
  input.model.map_progress = 0.425;
  EXPECT_THAT(words(input), IsSupersetOf({"MAP", "42 %", "12 SEC", "ALONG"}));
}

TEST(Symbology, RangingShowsTheSlantRangeToTheTargetWithAndWithoutAMap) {
  for (const bool with_map : {false, true}) {
    DisplayInput input = testing::operating(Mode::ranging, 40.0);
    if (with_map) testing::put_map(input, 40.0, 20.0, 4.7);
    EXPECT_THAT(words(input), Contains("NO TARGET"));
    testing::put_target(input, testing::at(40.0, 20.0), 40.0, databuffer::SteeringLine::line_of_sight);
    EXPECT_THAT(words(input), Contains("NO RANGE TO 4.")) << "the elevation of the target is not known yet";
    input.slant_range_m = geo::Length::nautical_miles(20.17).metres();
    EXPECT_THAT(words(input), Contains("20.2NM TO 4."));
    input.state.mode = static_cast<std::uint8_t>(Mode::air_to_air);
    EXPECT_THAT(words(input), Not(Contains("20.2NM TO 4.")));
  }
}

TEST(Symbology, AirToAirAndRangingShowTheirNameWithAndWithoutAMap) {
  for (const auto& [mode, name] : {std::pair{Mode::air_to_air, "A/A"}, std::pair{Mode::ranging, "A/G RANGING"}}) {
    DisplayInput input = testing::operating(mode, 40.0);
    EXPECT_THAT(words(input), Contains(name));
    testing::put_map(input, 40.0, 20.0, 4.7);
    EXPECT_THAT(words(input), Contains(name));
    input.state.power = static_cast<std::uint8_t>(radar::Power::standby);
    EXPECT_THAT(words(input), Contains(name)) << "also in STBY";
  }
  EXPECT_THAT(words(testing::operating(Mode::rbm, 40.0)), Not(Contains("A/A")));
}

TEST(Symbology, FreezeIsShownAsSoonAsItIsCommanded) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  EXPECT_THAT(words(input), Not(Contains("FREEZE")));
  input.state.flags |= databuffer::kFreeze;
  EXPECT_THAT(words(input), Contains("FREEZE"));
}

TEST(Symbology, ASilentModelOrOwnshipSourceIsShown) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  input.model_alive = false;
  EXPECT_THAT(words(input), Contains("NO MODEL"));
  EXPECT_THAT(words(input), Not(Contains("NO OWNSHIP")));
  input.ownship_fresh = false;
  EXPECT_THAT(words(input), Contains("NO OWNSHIP"));
}

TEST(Symbology, ATextWithoutTerminatorEndsAtTheEndOfItsField) {
  DisplayInput input = testing::operating(Mode::rbm, 40.0);
  std::ranges::fill(input.state.legends[6], 'X');
  std::ranges::fill(input.state.message, 'Y');
  EXPECT_THAT(words(input), IsSupersetOf({std::string(8, 'X'), std::string(32, 'Y')}));
}

TEST(Symbology, AnInvisibleMotionLeavesTheListEqual) {
  DisplayInput input = testing::operating(Mode::rbm, 160.0);
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
