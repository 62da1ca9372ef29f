// Patch maps: commands, rejections, re-maps, cancelled maps, and the maps kept in memory.
// Source: docs/pilots_manual.md#rule-3, #rule-4, #rule-5, #rule-6, #rule-7, #rule-8.
#include <gtest/gtest.h>

#include <string_view>

#include "lib/text/plain_text.hpp"
#include "tests/statemachine/pilot.hpp"

namespace yars::statemachine::testing {
namespace {

using databuffer::kFreeze;
using databuffer::kMapping;
using text::put_text;

class Maps : public ::testing::Test {
 protected:
  Maps() {
    pilot.press("power opr");
    pilot.press("pb 13");  // 40 NM
  }
  void put_cursor_on(geo::GeoPoint where) {
    pilot.state.cursor_latitude_deg = where.latitude_deg;
    pilot.state.cursor_longitude_deg = where.longitude_deg;
    pilot.wait();
  }
  Effect effect_of(const std::string& text) {
    return apply(pilot.state, *databuffer::event_from_text(text), pilot.around, pilot.configuration);
  }
  std::string field(const std::string& name) const { return fields_of(pilot).at(name); }
  Pilot pilot;
};

TEST_F(Maps, ACommandRequestsTheCursorsPositionAndTheSelectedWindowAndThePictureStays) {
  const databuffer::RadarState before = pilot.state;
  ASSERT_TRUE(pilot.press("tdc release"));
  EXPECT_EQ(pilot.state.map_request, before.map_request + 1);
  EXPECT_EQ(pilot.state.map_latitude_deg, before.cursor_latitude_deg);
  EXPECT_EQ(pilot.state.map_longitude_deg, before.cursor_longitude_deg);
  EXPECT_EQ(pilot.state.map_window_nm, 4.7);
  EXPECT_EQ(field("mode"), "RBM");
  EXPECT_EQ(field("shown"), "0");
  EXPECT_EQ(pilot.state.scan_restart, before.scan_restart);
  pilot.send("tdc 1 1");
  pilot.wait(50);
  EXPECT_EQ(pilot.state.map_latitude_deg, before.cursor_latitude_deg) << "slewing does not move the commanded map";
}

TEST_F(Maps, ARejectedCommandShowsTheReasonAndChangesNothingElse) {
  pilot.configuration.high_resolution.blind_zone_deg = 8.0;
  struct Case {
    double bearing_deg, range_nm;
    const char* why;
  };
  // The window is 4.7 NM. The aircraft flies north.
  for (const Case& one : {Case{7.9, 20.0, "BLIND ZONE"}, Case{-7.9, 20.0, "BLIND ZONE"}, Case{61.0, 20.0, "GIMBAL"},
                          Case{30.0, 4.6, "MIN RANGE"}, Case{30.0, 80.1, "MAX RANGE"}}) {
    put_cursor_on(position(one.bearing_deg, one.range_nm));
    Fields expected = fields_of(pilot);
    expected["message"] = one.why;
    EXPECT_EQ(effect_of("tdc release"), Effect::refused);
    EXPECT_EQ(fields_of(pilot), expected);
    EXPECT_EQ(pilot.state.map_request, 0U);
  }
}

// The target is 10 NM away.
TEST_F(Maps, ATargetBelowTheAntennasLimitIsRejectedOnceItsElevationIsKnown) {
  const auto effect_at = [&](double altitude_ft, double ground_m, double pitch_deg) {
    pilot.around.ownship.altitude_msl_m = geo::Length::feet(altitude_ft).metres();
    pilot.around.ownship.pitch_deg = pitch_deg;
    pilot.ground = [ground_m](geo::GeoPoint) { return ground_m; };
    put_cursor_on(position(30.0 + 1e-3 * ground_m, 10.0));
    pilot.wait(2);
    return effect_of("tdc release");
  };
  // From 105,000 ft the target is 59.9 degrees below the horizon, from 107,000 ft 60.4.
  EXPECT_EQ(effect_at(105'000.0, 0.0, 0.0), Effect::done);
  EXPECT_EQ(effect_at(107'000.0, 0.0, 0.0), Effect::refused);
  EXPECT_STREQ(pilot.state.message, "GIMBAL");
  EXPECT_EQ(effect_at(107'000.0, 1000.0, 0.0), Effect::done) << "high ground lies less far below";
  EXPECT_EQ(effect_at(105'000.0, 0.0, 20.0), Effect::refused) << "80 degrees below the wing plane";
  EXPECT_STREQ(pilot.state.message, "GIMBAL");
}

TEST_F(Maps, TheModelsReasonForMakingNoCommandedMapIsShown) {
  ASSERT_TRUE(pilot.press("tdc release"));
  put_text(pilot.around.model.map_stopped, "GIMBAL");
  pilot.around.model.map_done_request = pilot.state.map_request;
  pilot.wait();
  EXPECT_STREQ(pilot.state.message, "GIMBAL");
  EXPECT_FALSE(pilot.is(kMapping));
  pilot.wait(600);
  EXPECT_STREQ(pilot.state.message, "") << "in RBM nothing is mapped again";
}

// ModelStatus::mappable belongs to the cursor of the previous tick.
TEST_F(Maps, AfterAJumpInTheSameTickACommandIsCheckedAtTheNewCursor) {
  pilot.configuration.high_resolution.blind_zone_deg = 8.0;
  put_cursor_on(position(30.0, 20.0));
  pilot.send("sp 2");  // straight ahead
  EXPECT_EQ(effect_of("tdc release"), Effect::refused);
  EXPECT_STREQ(pilot.state.message, "BLIND ZONE");
  pilot.around.model.mappable = 0;
  pilot.send("sp 3.");
  EXPECT_EQ(effect_of("tdc release"), Effect::done);
}

TEST_F(Maps, AfterAWindowStepInTheSameTickACommandIsCheckedWithTheNewWindow) {
  put_cursor_on(position(30.0, 30.0));
  while (pilot.state.window_nm > 1.4) pilot.press("acq aft");
  pilot.send("acq aft");
  EXPECT_EQ(effect_of("tdc release"), Effect::refused) << "the window of .67 NM is limited to 20 NM";
  EXPECT_STREQ(pilot.state.message, "MAX RANGE");
}

TEST_F(Maps, TheReasonWhyReMappingStopsIsShownUntilItResumes) {
  pilot.make_map();
  for (const char* why : {"BLIND ZONE", "MIN RANGE", "MAX RANGE", "GIMBAL"}) {
    put_text(pilot.around.model.map_stopped, why);
    pilot.wait(2000);
    EXPECT_STREQ(pilot.state.message, why);
  }
  EXPECT_EQ(field("shown"), "1") << "the last map stays";
  pilot.press("pb 12");
  EXPECT_STREQ(pilot.state.message, "NO RECORDER") << "a message caused by the pilot comes first";
  pilot.wait(600);
  EXPECT_STREQ(pilot.state.message, "GIMBAL");
  put_text(pilot.around.model.map_stopped, "");
  pilot.wait();
  EXPECT_STREQ(pilot.state.message, "");
}

TEST_F(Maps, NoReasonIsShownWhereNoReMapWouldBeMade) {
  pilot.make_map();
  put_text(pilot.around.model.map_stopped, "GIMBAL");
  pilot.wait();
  ASSERT_STREQ(pilot.state.message, "GIMBAL");
  for (const char* event : {"freeze", "pb 14", "mode aa", "power stby", "power off", "tdc release"}) {
    Pilot other = pilot;
    other.press(event);
    EXPECT_STREQ(other.state.message, "") << event;
  }
}

TEST_F(Maps, AReasonWithControlCharactersIsNotShownAndALongOneIsCut) {
  pilot.make_map();
  put_text(pilot.around.model.map_stopped, "\x1b[2J");
  pilot.wait();
  EXPECT_STREQ(pilot.state.message, "");
  auto& field = pilot.around.model.map_stopped;
  std::string_view("WITHOUT A ZERO AT ITS END").copy(field, sizeof field);
  pilot.wait();
  EXPECT_STREQ(pilot.state.message, "WITHOUT A ZERO A");
}

TEST_F(Maps, AMapOfABlankWindowSetsAFlagUntilAnotherMapIsCommanded) {
  while (pilot.press("acq aft")) {
  }
  put_cursor_on(position(30.0, 20.0));
  pilot.make_map();
  EXPECT_TRUE(pilot.is(databuffer::kMapWindowBlank));
  pilot.press("acq fwd");
  put_cursor_on(position(30.0, 10.0));
  pilot.press("tdc release");
  EXPECT_FALSE(pilot.is(databuffer::kMapWindowBlank));
}

TEST_F(Maps, ACommandAnsweredWithoutAMapIsCancelledAndTheDisplayShowsNoMap) {
  ASSERT_TRUE(pilot.press("tdc release"));
  pilot.around.model.map_request = pilot.around.model.map_done_request = pilot.state.map_request;
  pilot.wait(1);
  EXPECT_EQ(pilot.state.flags & kMapping, 0U);
  EXPECT_EQ(field("mode"), "RBM");
  EXPECT_STREQ(pilot.state.message, "NO MAP");
}

TEST_F(Maps, ABlankWindowSelectsAWindowByTheCursorsRange) {
  struct Case {
    double range_nm, window_nm;
  };
  for (int press = 0; press < 4; ++press) pilot.press("acq aft");
  ASSERT_EQ(pilot.state.window_nm, 0.0);
  for (const auto& [range_nm, window_nm] :
       {Case{2.8, 3.3}, Case{49.9, 3.3}, Case{50.1, 4.7}, Case{79.9, 4.7}, Case{80.1, 10.0}, Case{149.9, 10.0}}) {
    const geo::GeoPoint where = position(30.0, range_nm);
    pilot.state.cursor_latitude_deg = where.latitude_deg;
    pilot.state.cursor_longitude_deg = where.longitude_deg;
    pilot.wait();
    ASSERT_TRUE(pilot.press("tdc release"));
    EXPECT_EQ(pilot.state.map_window_nm, window_nm) << range_nm;
  }
  for (const double range_nm : {2.6, 150.1}) {
    const geo::GeoPoint where = position(30.0, range_nm);
    pilot.state.cursor_latitude_deg = where.latitude_deg;
    pilot.state.cursor_longitude_deg = where.longitude_deg;
    pilot.wait();
    const auto request = pilot.state.map_request;
    pilot.press("tdc release");
    EXPECT_STREQ(pilot.state.message, "NO WINDOW");
    EXPECT_EQ(pilot.state.map_request, request);
  }
}

TEST_F(Maps, NoMapIsCommandedWithoutTransmissionOrWhereModeOrFunctionExcludesIt) {
  for (const char* event : {"radar bcn", "mode aa", "power stby", "pb 18", "pb 7"}) {
    Pilot elsewhere = pilot;
    elsewhere.press(event);
    EXPECT_FALSE(elsewhere.press("tdc release")) << event;
  }
  pilot.around.ownship_valid = false;
  const auto request = pilot.state.map_request;
  pilot.press("tdc release");
  EXPECT_STREQ(pilot.state.message, "NO OWNSHIP");
  EXPECT_EQ(pilot.state.map_request, request);
}

TEST_F(Maps, TheCommandedMapSwitchesTheDisplayToPatchWhenItIsComplete) {
  for (const char* mode : {"rbm", "hrm", "pvu"}) {
    Pilot one = pilot;
    one.press(std::string("radar ") + mode);
    const double range_nm = one.state.range_nm;
    const auto id = one.make_map();
    EXPECT_EQ(fields_of(one).at("mode"), "PATCH") << mode;
    EXPECT_EQ(fields_of(one).at("mapping"), "false");
    EXPECT_EQ(one.state.map_newest, id);
    EXPECT_EQ(one.state.map_shown, id);
    EXPECT_EQ(one.state.range_nm, range_nm) << "rule 1: the range is not set on a patch";
    EXPECT_EQ(one.legend(14), "PPI");
  }
}

TEST_F(Maps, UnderTheMenuAMapIsCompletedAndShownAfterTheMenu) {
  pilot.press("pb 11");
  pilot.make_map();
  EXPECT_EQ(field("mode"), "MENU");
  EXPECT_EQ(field("running"), "PATCH");
  pilot.press("pb 6");
  EXPECT_EQ(field("mode"), "PATCH");
}

TEST_F(Maps, ANewCommandMovesNewToOldAndAReMapReplacesNewOnly) {
  pilot.make_map();
  EXPECT_EQ(field("maps"), "1/0/0");
  pilot.complete_map();
  EXPECT_EQ(field("maps"), "2/0/0");
  pilot.make_map();
  EXPECT_EQ(field("maps"), "3/2/0");
  pilot.complete_map();
  pilot.complete_map();
  EXPECT_EQ(field("maps"), "5/2/0");
  EXPECT_EQ(field("shown"), "5");
}

TEST_F(Maps, ASecondCommandBeforeTheFirstMapIsCompleteReplacesTheFirst) {
  pilot.press("tdc release");
  const auto first = pilot.state.map_request;
  pilot.press("pb 17");
  pilot.press("tdc release");
  pilot.around.model.map_done_request = first;
  pilot.around.maps[0].id = pilot.around.model.map_newest = 1;
  pilot.wait();
  EXPECT_EQ(field("mode"), "RBM") << "the map of the first command is not shown";
  pilot.complete_map();
  EXPECT_EQ(field("mode"), "PATCH");
  EXPECT_EQ(field("maps"), "2/0/0");
}

// A map that is completed after its cancellation changes nothing.
TEST_F(Maps, LeavingTheModeWhileAMapFormsCancelsTheMap) {
  for (const char* event : {"pb 6", "radar pvu", "power stby", "power off", "mode aa", "mode agr", "pb 18"}) {
    Pilot leaving = pilot;
    leaving.press("tdc release");
    const auto request = leaving.state.map_request;
    leaving.press(event);
    EXPECT_FALSE(leaving.is(kMapping)) << event;
    const Fields expected = fields_of(leaving);
    leaving.around.model.map_done_request = request;
    leaving.around.maps[0].id = leaving.around.model.map_newest = 1;
    leaving.wait();
    EXPECT_EQ(fields_of(leaving), expected) << event;
  }
}

TEST_F(Maps, ANewEpochCancelsTheMapInProgress) {
  pilot.press("tdc release");
  ++pilot.around.epoch;
  pilot.complete_map();
  EXPECT_FALSE(pilot.is(kMapping));
  EXPECT_EQ(field("maps"), "0/0/0");
}

TEST_F(Maps, LeavingThePatchForThePpiCancelsTheNextMapAndKeepsTheLast) {
  pilot.make_map();
  pilot.press("tdc release");
  pilot.press("pb 14");
  EXPECT_EQ(field("mode"), "HRM");
  EXPECT_FALSE(pilot.is(kMapping));
  EXPECT_EQ(field("maps"), "1/0/0");
}

// Re-maps continue at the position of the newest map, not at the position of the cancelled one.
TEST_F(Maps, AfterACancelledCommandThePatchReMapsItsNewestMap) {
  pilot.make_map();
  const double latitude_deg = pilot.state.map_latitude_deg;
  pilot.press("sp 3.");
  pilot.press("acq aft");
  pilot.press("tdc release");
  ASSERT_NE(pilot.state.map_latitude_deg, latitude_deg);
  const auto cancelled = pilot.state.map_request;
  pilot.press("mode aa");
  pilot.press("mode ag");
  ASSERT_EQ(field("mode"), "PATCH");
  EXPECT_EQ(pilot.state.map_latitude_deg, latitude_deg);
  EXPECT_EQ(pilot.state.map_window_nm, 4.7);
  EXPECT_GT(pilot.state.map_request, cancelled);
  pilot.complete_map();
  EXPECT_EQ(field("maps"), "2/0/0") << "NEW is replaced by a re-map";
}

TEST_F(Maps, AMapWithoutARecordOfItsPositionIsNotShown) {
  pilot.press("tdc release");
  pilot.around.model.map_done_request = pilot.state.map_request;
  pilot.around.model.map_newest = 1;
  pilot.wait(10);
  EXPECT_EQ(field("mode"), "RBM");
  EXPECT_TRUE(pilot.is(kMapping));
}

TEST_F(Maps, RequestNumbersContinueAboveThoseOfTheModel) {
  pilot.around.model.map_request = 40;
  pilot.around.model.map_done_request = 1;
  pilot.around.maps[0].id = pilot.around.model.map_newest = 17;
  pilot.press("tdc release");
  EXPECT_EQ(pilot.state.map_request, 41U);
  EXPECT_TRUE(pilot.is(kMapping)) << "after a restart of state-machine, a map made before does not answer the request";
}

// A damaged status may leave the greatest 64-bit number as the id of the newest map; no later id would be greater.
TEST_F(Maps, AMapWithAnImpossibleIdIsReplacedByTheNextMap) {
  pilot.make_map();
  pilot.state.map_newest = ~std::uint64_t{0};
  pilot.make_map();
  EXPECT_EQ(pilot.state.map_newest, pilot.around.model.map_newest);
}

TEST_F(Maps, PowerOffForgetsTheMapsAndAnOldMapDoesNotAnswerANewCommand) {
  pilot.make_map();
  pilot.make_map();
  pilot.press("power off");
  pilot.press("power opr");
  EXPECT_EQ(field("maps"), "0/0/0");
  pilot.press("tdc release");
  pilot.wait(10);
  EXPECT_TRUE(pilot.is(kMapping));
  EXPECT_EQ(field("mode"), "RBM");
}

TEST_F(Maps, StandbyKeepsTheMapAndOperateResumesThePatch) {
  pilot.make_map();
  const Fields expected = fields_of(pilot);
  pilot.press("power stby");
  pilot.press("power opr");
  EXPECT_EQ(fields_of(pilot), expected);
}

TEST_F(Maps, ACommandOnAFrozenRealBeamMapMakesOneMapAndFreezesIt) {
  pilot.press("freeze");
  pilot.make_map();
  EXPECT_EQ(field("mode"), "PATCH");
  EXPECT_TRUE(pilot.is(kFreeze));
  EXPECT_EQ(field("recall"), "NEW");
}

TEST_F(Maps, AReMapInProgressAtFreezeIsStillCompletedAndShown) {
  pilot.make_map();
  pilot.press("freeze");
  pilot.complete_map();
  EXPECT_EQ(field("maps"), "2/0/0");
  EXPECT_EQ(field("shown"), "2");
}

TEST_F(Maps, ARestartedStateMachineContinuesWithTheMapInProgressAndRecall) {
  pilot.make_map();
  for (const char* event : {"pb 17", "freeze", "pb 15", "tdc 0.2 0.1", "tdc release"}) pilot.press(event);
  Pilot successor;
  successor.around = pilot.around;
  successor.state = pilot.state;
  pilot.complete_map();
  successor.complete_map();
  EXPECT_EQ(std::memcmp(&pilot.state, &successor.state, sizeof pilot.state), 0);
  EXPECT_EQ(fields_of(successor).at("maps"), "2/1/1");
}

}  // namespace
}  // namespace yars::statemachine::testing
