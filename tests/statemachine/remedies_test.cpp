// Remedies of messages: what the pilot is told to do makes the map possible.
// Source: docs/pilots_manual.md#remedies.
#include "statemachine/remedies.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/statemachine/pilot.hpp"

namespace yars::statemachine::testing {
namespace {

using ::testing::HasSubstr;

// Pilot in RBM at 40 NM and 15,000 ft, flying north, with the cursor at a bearing and distance and a blind zone of 8
// deg.
struct AtCursor : Pilot {
  AtCursor(double bearing_deg, double distance_nm) {
    configuration.high_resolution.blind_zone_deg = 8.0;
    configuration.route.push_back(route_point("9", radar::PointKind::steer, position(bearing_deg, distance_nm)));
    press("power opr");
    press("pb 13");
    press("sp 9");
    wait(3);
  }
  std::string refused() {
    press("tdc release");
    return std::string(state.message) + ": " + remedy_of_message(state, around, configuration);
  }
  void turn(double by_deg) {
    around.ownship.heading_deg = geo::Bearing::degrees(around.ownship.heading_deg + by_deg).degrees();
    const double heading_rad = around.ownship.heading_deg * geo::kRadiansPerDegree;
    around.ownship.velocity_north_mps = 200.0 * std::cos(heading_rad);
    around.ownship.velocity_east_mps = 200.0 * std::sin(heading_rad);
  }
};

TEST(Remedies, TheBlindZoneNamesSideAndAngleAndTheTurnMakesTheMapPossible) {
  AtCursor pilot(3.0, 20.0);
  EXPECT_EQ(pilot.refused(), "BLIND ZONE: turn 5 deg or more left, or move the cursor 1.8 NM right");
  pilot.turn(-4.0);
  EXPECT_EQ(pilot.refused(), "BLIND ZONE: turn 1 deg or more left, or move the cursor 0.4 NM right");
  pilot.turn(-1.001);
  EXPECT_TRUE(pilot.press("tdc release"));
  EXPECT_TRUE(pilot.is(databuffer::kMapping));
  AtCursor other(358.0, 20.0);
  EXPECT_EQ(other.refused(), "BLIND ZONE: turn 6 deg or more right, or move the cursor 2.2 NM left");
}

// `yars inject` has the words of the tick of the refusal, the display those of a later tick. Meanwhile the aircraft
// weaves.
TEST(Remedies, WithTheCursorOnTheTrackLineEveryTickAdvisesTheSameSide) {
  AtCursor pilot(0.0, 20.0);
  const std::string first = pilot.refused();
  EXPECT_EQ(first, "BLIND ZONE: turn 8 deg or more left, or move the cursor 2.9 NM right");
  for (const double weave_deg : {0.001, -0.002, 0.5, -0.8, 0.3}) {
    pilot.turn(weave_deg);
    EXPECT_THAT(pilot.refused(), HasSubstr("left, or move the cursor")) << weave_deg;
  }
  pilot.turn(0.501);  // the cursor lies 0.5 deg left of the track; so the turn to the left is more than 8 deg
  EXPECT_EQ(pilot.refused(), "BLIND ZONE: turn 9 deg or more left, or move the cursor 3.0 NM right");
  pilot.turn(-8.5001);
  EXPECT_TRUE(pilot.press("tdc release")) << "the advice makes the map possible";
}

TEST(Remedies, AsternTheAircraftMustTurnTowardTheCursor) {
  EXPECT_EQ(AtCursor(175.0, 20.0).refused(), "BLIND ZONE: turn 115 deg or more right, toward the cursor");
}

TEST(Remedies, TheGimbalNamesTheTurnTowardTheCursorAndTheTurnMakesTheMapPossible) {
  AtCursor pilot(280.0, 20.0);
  EXPECT_EQ(pilot.refused(), "GIMBAL: turn 20 deg or more left, toward the cursor");
  pilot.turn(-20.5);
  pilot.press("tdc release");
  EXPECT_TRUE(pilot.is(databuffer::kMapping)) << pilot.state.message;
}

TEST(Remedies, ADepressionBeyondTheGimbalNamesTheDistance) {
  AtCursor pilot(30.0, 5.0);
  pilot.around.ownship.altitude_msl_m = 20'000.0;
  EXPECT_EQ(pilot.refused(), "GIMBAL: descend 13000 ft or more, or move the cursor out to 6.3 NM or more");
  pilot.around.ownship.altitude_msl_m -= 13'000.0 * geo::kMetresPerFoot;
  pilot.press("tdc release");
  EXPECT_TRUE(pilot.is(databuffer::kMapping)) << pilot.state.message;
}

TEST(Remedies, ABankBeyondTheGimbalNamesTheBankAtWhichTheMapIsPossible) {
  AtCursor pilot(59.0, 4.8);
  pilot.around.ownship.roll_deg = -60.0;
  const std::string refused = pilot.refused();
  ASSERT_THAT(refused, ::testing::StartsWith("GIMBAL: level the wings: bank "));
  const double bank_deg = std::stod(refused.substr(std::string("GIMBAL: level the wings: bank ").size()));
  pilot.around.ownship.roll_deg = -bank_deg - 1.0;
  EXPECT_THAT(pilot.refused(), HasSubstr("GIMBAL"));
  pilot.around.ownship.roll_deg = -bank_deg;
  pilot.press("tdc release");
  EXPECT_TRUE(pilot.is(databuffer::kMapping)) << pilot.state.message;
}

TEST(Remedies, ARangeBeyondItsLimitsNamesTheLimitOrAnotherWindow) {
  EXPECT_EQ(AtCursor(30.0, 4.0).refused(), "MIN RANGE: move the cursor out to 4.7 NM or more");
  AtCursor near(30.0, 8.0);
  near.press("acq fwd");
  EXPECT_EQ(near.state.window_nm, 10.0);
  EXPECT_EQ(near.refused(), "MIN RANGE: move the cursor out to 10.0 NM or more, or take window 4.7: acq aft (PgDn)");
  near.press("acq aft");
  near.press("tdc release");
  EXPECT_TRUE(near.is(databuffer::kMapping));
  AtCursor far(30.0, 30.0);
  for (int step = 0; step < 3; ++step) far.press("acq aft");
  EXPECT_EQ(far.state.window_nm, 0.67);
  EXPECT_EQ(far.refused(), "MAX RANGE: move the cursor in to 20.0 NM or less, or take window 1.3: acq fwd (PgUp)");
}

TEST(Remedies, ABlankWindowNamesItsLimits) {
  AtCursor pilot(30.0, 2.0);
  for (int step = 0; step < 4; ++step) pilot.press("acq aft");
  EXPECT_EQ(pilot.state.window_nm, 0.0);
  EXPECT_EQ(pilot.refused(), "NO WINDOW: move the cursor out to 2.7 NM or more");
  AtCursor far(30.0, 155.0);
  for (int step = 0; step < 2; ++step) far.press("pb 13");
  for (int step = 0; step < 4; ++step) far.press("acq aft");
  EXPECT_EQ(far.refused(),
            "NO WINDOW: move the cursor in to 150.0 NM or less, or take window 10: acq fwd (PgUp) 5 times");
  for (int step = 0; step < 5; ++step) far.press("acq fwd");
  EXPECT_EQ(far.state.window_nm, 10.0);
  far.press("tdc release");
  EXPECT_TRUE(far.is(databuffer::kMapping)) << far.state.message;
}

TEST(Remedies, TheStepToTheBlankWindowSaysWhatItIsAndHowToGetBack) {
  AtCursor pilot(30.0, 20.0);
  for (int step = 0; step < 3; ++step) pilot.press("acq aft");
  EXPECT_STREQ(pilot.state.message, "");
  pilot.press("acq aft");
  EXPECT_STREQ(pilot.state.message, "BLANK WINDOW");
  EXPECT_EQ(remedy_of_message(pilot.state, pilot.around, pilot.configuration),
            "by the cursor's range, here 3.3 NM; back to 0.67 NM: acq fwd (PgUp)");
  pilot.wait(kMessageTicks);
  EXPECT_STREQ(pilot.state.message, "");
  EXPECT_FALSE(pilot.press("acq aft")) << "blank is the last";
  EXPECT_STREQ(pilot.state.message, "");
  pilot.state.flags &= ~databuffer::kCursorValid;
  std::string("BLANK WINDOW").copy(pilot.state.message, sizeof pilot.state.message - 1);
  EXPECT_EQ(remedy_of_message(pilot.state, pilot.around, pilot.configuration),
            "by the cursor's range; back to 0.67 NM: acq fwd (PgUp)");
}

TEST(Remedies, AMessageThatNoLongerHoldsSaysThatTheMapIsPossible) {
  AtCursor pilot(3.0, 20.0);
  pilot.press("tdc release");
  pilot.turn(-10.0);
  EXPECT_EQ(remedy_of_message(pilot.state, pilot.around, pilot.configuration),
            "it is possible now: tdc release (Enter)");
}

TEST(Remedies, WhileReMappingStopsTheyCountFromTheMap) {
  AtCursor pilot(20.0, 20.0);
  pilot.make_map();
  pilot.turn(16.0);
  databuffer::ModelStatus& model = pilot.around.model;
  std::string("BLIND ZONE").copy(model.map_stopped, sizeof model.map_stopped - 1);
  pilot.wait();
  ASSERT_STREQ(pilot.state.message, "BLIND ZONE");
  EXPECT_EQ(remedy_of_message(pilot.state, pilot.around, pilot.configuration), "turn 4 deg or more left");
}

TEST(Remedies, WhileReMappingStopsForTheRangeTheyNameTheDistanceToFly) {
  AtCursor pilot(30.0, 5.0);
  pilot.make_map();
  const auto nearer =
      geo::geodesic_direct(kAircraftPosition, geo::Bearing::degrees(30.0), geo::Length::nautical_miles(1.0));
  pilot.around.ownship.latitude_deg = nearer.latitude_deg;
  pilot.around.ownship.longitude_deg = nearer.longitude_deg;
  std::string("MIN RANGE").copy(pilot.around.model.map_stopped, sizeof pilot.around.model.map_stopped - 1);
  pilot.wait();
  ASSERT_STREQ(pilot.state.message, "MIN RANGE");
  EXPECT_EQ(remedy_of_message(pilot.state, pilot.around, pilot.configuration), "fly 0.7 NM away, to 4.7 NM or more");
}

TEST(Remedies, AnUnknownPointNamesThePointsOfTheRoute) {
  Pilot pilot;
  pilot.press("power opr");
  pilot.press("sp 99");
  EXPECT_STREQ(pilot.state.message, "NO POINT 99");
  EXPECT_EQ(remedy_of_message(pilot.state, pilot.around, pilot.configuration), "points: 1 1.1 2 2.01 3.");
}

TEST(Remedies, WithoutOwnshipOrCursorEveryCursorFunctionIsRefusedWithAReason) {
  for (int function = 0; function < 5; ++function) {
    Pilot pilot;
    pilot.press("power opr");
    for (int press = 0; press < function; ++press) pilot.press("pb 7");
    pilot.around.ownship_valid = false;
    EXPECT_TRUE(pilot.press("tdc release"));
    EXPECT_STREQ(pilot.state.message, "NO OWNSHIP") << function;
    EXPECT_THAT(remedy_of_message(pilot.state, pilot.around, pilot.configuration), HasSubstr("flight-model"));
    pilot.around.ownship_valid = true;
    pilot.state.flags &= ~databuffer::kCursorValid;
    EXPECT_TRUE(pilot.send("tdc release"));
    EXPECT_STREQ(pilot.state.message, "NO CURSOR") << function;
  }
}

TEST(Remedies, NoMessageAndAMarkHaveNone) {
  Pilot pilot;
  pilot.press("power opr");
  EXPECT_EQ(remedy_of_message(pilot.state, pilot.around, pilot.configuration), "");
  for (int press = 0; press < 4; ++press) pilot.press("pb 7");
  pilot.press("tdc release");
  EXPECT_STREQ(pilot.state.message, "MARK 1");
  EXPECT_EQ(remedy_of_message(pilot.state, pilot.around, pilot.configuration), "");
}

}  // namespace
}  // namespace yars::statemachine::testing
