// CUE, TGT and MARK, and the pattern steering line (PSL) to the designated target.
// Source: docs/pilots_manual.md#rule-14, #rule-15.
#include <gtest/gtest.h>

#include "statemachine/machine.hpp"
#include "tests/statemachine/pilot.hpp"

namespace yars::statemachine::testing {
namespace {

class Designating : public ::testing::Test {
 protected:
  Designating() { pilot.press("power opr"); }

  void select_function(radar::CursorFunction function) {
    while (pilot.state.cursor_function != static_cast<std::uint8_t>(function)) pilot.press("pb 7");
  }
  void put_cursor_on(geo::GeoPoint where) {
    pilot.state.cursor_latitude_deg = where.latitude_deg;
    pilot.state.cursor_longitude_deg = where.longitude_deg;
    pilot.ground = [](geo::GeoPoint) { return 120.0; };
    pilot.wait(2);
  }
  void designate(geo::GeoPoint where) {
    select_function(radar::CursorFunction::target);
    put_cursor_on(where);
    ASSERT_TRUE(pilot.press("tdc release"));
  }
  databuffer::Outputs outputs() const { return outputs_of(pilot.state, pilot.around); }
  // The PSL: LOS, SLEW or FIXED; "-": none.
  std::string steering_line() const { return fields_of(pilot).at("psl"); }
  std::vector<std::string> points_drawn() const {
    std::vector<std::string> names;
    for (int point = 0; point < pilot.state.points_drawn; ++point) names.emplace_back(pilot.state.points[point].name);
    return names;
  }
  // Sets the ground track; the ground speed is 200 m/s.
  void fly(double heading_deg) {
    pilot.around.ownship.velocity_north_mps = 200.0 * std::cos(heading_deg * geo::kRadiansPerDegree);
    pilot.around.ownship.velocity_east_mps = 200.0 * std::sin(heading_deg * geo::kRadiansPerDegree);
  }

  Pilot pilot;
};

TEST_F(Designating, CuePublishesThePointInTheNavigatorsCoordinates) {
  pilot.press("nav error mn 2500 0");
  select_function(radar::CursorFunction::cue);
  pilot.press("sp 1");
  ASSERT_TRUE(pilot.press("tdc release"));
  EXPECT_EQ(outputs().cue_count, 1U);
  EXPECT_NEAR(outputs().cue_latitude_deg, pilot.configuration.route[0].position.latitude_deg, 1e-9);
  EXPECT_NEAR(outputs().cue_longitude_deg, pilot.configuration.route[0].position.longitude_deg, 1e-9);
  EXPECT_TRUE(pilot.press("tdc release")) << "the same point may be cued again";
  EXPECT_EQ(outputs().cue_count, 2U);
}

TEST_F(Designating, AfterAJumpInTheSameTickAReleaseMarksTheNewPoint) {
  pilot.press("nav error mn 2500 0");
  select_function(radar::CursorFunction::mark);
  pilot.send("sp 3.");
  ASSERT_TRUE(pilot.send("tdc release"));
  EXPECT_NEAR(outputs().marks[0].latitude_deg, pilot.configuration.route[4].position.latitude_deg, 1e-9);
  EXPECT_NEAR(outputs().marks[0].longitude_deg, pilot.configuration.route[4].position.longitude_deg, 1e-9);
}

TEST_F(Designating, ACueStaysPublishedAfterPowerOff) {
  select_function(radar::CursorFunction::cue);
  put_cursor_on(position(10.0, 12.0));
  ASSERT_TRUE(pilot.press("tdc release"));
  const databuffer::Outputs before = outputs();
  pilot.press("power off");
  EXPECT_EQ(outputs().cue_count, before.cue_count);
  EXPECT_EQ(outputs().cue_latitude_deg, before.cue_latitude_deg);
  EXPECT_EQ(outputs().cue_elevation_m, before.cue_elevation_m);
}

TEST_F(Designating, NeitherCueNorTargetStopsTheScan) {
  for (const auto function : {radar::CursorFunction::cue, radar::CursorFunction::target}) {
    const std::uint32_t restart = pilot.state.scan_restart;
    select_function(function);
    pilot.press("tdc release");
    EXPECT_EQ(pilot.state.scan_restart, restart);
    EXPECT_FALSE(pilot.is(databuffer::kFreeze));
  }
}

TEST_F(Designating, MarksHavePositionElevationAndTimeAndRemainAfterPowerOff) {
  select_function(radar::CursorFunction::mark);
  put_cursor_on(position(10.0, 12.0));
  pilot.around.sim_time_ns = 77'000'000;
  ASSERT_TRUE(pilot.press("tdc release"));
  pilot.press("power off");
  const databuffer::Mark& mark = outputs().marks[0];
  EXPECT_NEAR(mark.latitude_deg, position(10.0, 12.0).latitude_deg, 1e-12);
  EXPECT_EQ(mark.elevation_m, 120.0);
  EXPECT_EQ(mark.sim_time_ns, 77'000'000);
}

TEST_F(Designating, ARoutePointUnderTheCursorBecomesTheTargetAndIsDrawnOnce) {
  select_function(radar::CursorFunction::target);
  for (const char* name : {"3.", "2.01", "1", "1.1", "2"}) {
    pilot.press(std::string("sp ") + name);
    ASSERT_TRUE(pilot.press("tdc release"));
    EXPECT_STREQ(pilot.state.target_name, name);
    EXPECT_STREQ(pilot.state.sequence_point, name);
    const auto names = points_drawn();
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
    EXPECT_EQ(outputs().target_elevation_m, 100.0) << "the elevation of the route";
    for (int a = 0; a < pilot.state.points_drawn; ++a)
      for (int b = 0; b < a; ++b)
        EXPECT_GT(geo::geodesic_inverse({pilot.state.points[a].latitude_deg, pilot.state.points[a].longitude_deg},
                                        {pilot.state.points[b].latitude_deg, pilot.state.points[b].longitude_deg})
                      .distance.metres(),
                  1.0)
            << "two symbols at one position";
  }
}

// The cursor stays on its ground while drift moves the symbols.
TEST_F(Designating, APointIsTheTargetAlthoughItsSymbolHasDriftedOffTheCursor) {
  pilot.press("nav drift mn 3 0");
  select_function(radar::CursorFunction::target);
  pilot.press("sp 1");
  for (const int seconds : {3, 20}) {
    pilot.wait(200 * seconds);
    ASSERT_TRUE(pilot.press("tdc release"));
    EXPECT_STREQ(pilot.state.target_name, "1") << seconds;
    EXPECT_EQ(outputs().target_latitude_deg, pilot.configuration.route[0].position.latitude_deg);
    EXPECT_EQ(outputs().target_elevation_m, 100.0) << "the elevation of the route";
    EXPECT_EQ(outputs().cue_longitude_deg, pilot.configuration.route[0].position.longitude_deg);
  }
}

TEST_F(Designating, CueAndMarkTakeTheGroundUnderTheCursorInTheNavigatorsCoordinates) {
  pilot.press("nav drift mn 3 0");
  pilot.press("sp 1");
  pilot.wait(2000);
  const auto off_m = [&](double latitude_deg, double longitude_deg) {
    return geo::geodesic_inverse(pilot.configuration.route[0].position, {latitude_deg, longitude_deg})
        .distance.metres();
  };
  for (const auto function : {radar::CursorFunction::cue, radar::CursorFunction::mark}) {
    select_function(function);
    ASSERT_TRUE(pilot.send("tdc release"));
  }
  EXPECT_NEAR(off_m(outputs().cue_latitude_deg, outputs().cue_longitude_deg), 9.1, 0.5);
  EXPECT_NEAR(off_m(outputs().marks[0].latitude_deg, outputs().marks[0].longitude_deg), 9.1, 0.5);
}

// At a range of 20 NM, two display units are 0.1 NM.
TEST_F(Designating, ASymbolIsUnderTheCursorWithinTwoDisplayUnits) {
  ASSERT_EQ(pilot.state.range_nm, 20.0);
  const geo::GeoPoint point = pilot.configuration.route[0].position;
  const auto beside = [&](double distance_nm) {
    return geo::geodesic_direct(point, geo::Bearing::degrees(200.0), geo::Length::nautical_miles(distance_nm));
  };
  designate(beside(0.099));
  EXPECT_STREQ(pilot.state.target_name, "1");
  designate(beside(0.101));
  EXPECT_STREQ(pilot.state.target_name, "4.");
  pilot.press("nav error mn -304 0");  // displaces the symbol to the north by 0.05 NM
  designate(geo::geodesic_direct(point, geo::Bearing::degrees(0.0), geo::Length::nautical_miles(0.14)));
  EXPECT_STREQ(pilot.state.target_name, "1");
}

TEST_F(Designating, OfTwoSymbolsUnderTheCursorTheSelectedPointElseTheNearestIsTheTarget) {
  const geo::GeoPoint near = geo::geodesic_direct(pilot.configuration.route[0].position, geo::Bearing::degrees(90.0),
                                                  geo::Length::nautical_miles(0.05));
  pilot.configuration.route.push_back(route_point("7", radar::PointKind::steer, near));
  pilot.press("sp 1");
  designate(near);
  EXPECT_STREQ(pilot.state.target_name, "1");
  pilot.press("sp 3.");
  designate(near);
  EXPECT_STREQ(pilot.state.target_name, "7");
}

TEST_F(Designating, AHiddenPointIsNotTheTarget) {
  pilot.press("sp 3.");
  pilot.press("pb 2");
  designate(pilot.configuration.route[0].position);
  EXPECT_STREQ(pilot.state.target_name, "3.01");
}

TEST_F(Designating, OnAMapTheWindowSetsTheDistanceThatTheDisplayShows) {
  const geo::GeoPoint point = pilot.configuration.route[0].position;
  while (pilot.state.window_nm > 0.7) pilot.press("acq aft");
  put_cursor_on(point);
  pilot.make_map();
  const auto beside = [&](double distance_m) {
    return geo::geodesic_direct(point, geo::Bearing::degrees(45.0), geo::Length::metres(distance_m));
  };
  designate(beside(5.0));  // two display units are 5.2 m
  EXPECT_STREQ(pilot.state.target_name, "1");
  designate(beside(5.4));
  EXPECT_STREQ(pilot.state.target_name, "4.");
}

TEST_F(Designating, ARoutePointIsATriangleOnlyWhileItIsTheTarget) {
  select_function(radar::CursorFunction::target);
  pilot.press("sp 1");
  ASSERT_TRUE(pilot.press("tdc release"));
  const auto kind_of = [&](const std::string& name) {
    for (int point = 0; point < pilot.state.points_drawn; ++point)
      if (name == pilot.state.points[point].name) return static_cast<radar::PointKind>(pilot.state.points[point].kind);
    return radar::PointKind::initial;
  };
  EXPECT_EQ(kind_of("1"), radar::PointKind::target);
  put_cursor_on(position(40.0, 20.0));
  ASSERT_TRUE(pilot.press("tdc release"));
  EXPECT_STREQ(pilot.state.sequence_point, "1") << "the selected point stays the route point";
  EXPECT_EQ(kind_of("1"), radar::PointKind::steer);
  EXPECT_STREQ(pilot.state.target_name, "4.");
}

TEST_F(Designating, AnUpdateSelectedAndAcceptedInOneTickUsesTheOffsetOfThatTick) {
  pilot.press("nav error mn 2500 0");
  put_cursor_on(pilot.configuration.route[0].position);
  ASSERT_FALSE(pilot.is(databuffer::kUpdateShown));
  pilot.send("pb 7");
  ASSERT_TRUE(pilot.send("tdc release"));
  EXPECT_LT(std::hypot(pilot.state.mission.north_m, pilot.state.mission.east_m), 0.1);
}

TEST_F(Designating, TheEleventhMarkReplacesTheOldest) {
  select_function(radar::CursorFunction::mark);
  for (int n = 1; n <= 11; ++n) {
    pilot.around.sim_time_ns = n;
    ASSERT_TRUE(pilot.press("tdc release"));
  }
  EXPECT_EQ(pilot.state.mark_count, databuffer::kMarks);
  EXPECT_EQ(outputs().marks[0].sim_time_ns, 2);
  EXPECT_EQ(outputs().marks[databuffer::kMarks - 1].sim_time_ns, 11);
}

TEST_F(Designating, ATargetTakesTheNextFreeNumber) {
  designate(position(0.0, 20.0));
  EXPECT_STREQ(pilot.state.target_name, "4.");
  EXPECT_EQ(outputs().target_count, 1U);
  EXPECT_EQ(outputs().cue_count, 1U) << "the targeting sensor is cued";
  const auto names = points_drawn();
  EXPECT_NE(std::find(names.begin(), names.end(), "4."), names.end()) << "the target is drawn";
  designate(position(5.0, 25.0));
  EXPECT_STREQ(pilot.state.target_name, "4.") << "the new target replaces the previous one and takes its name";
  EXPECT_EQ(outputs().target_count, 2U);
}

TEST_F(Designating, WithATargetSelectedTheNewTargetIsItsNextFreeOffset) {
  pilot.press("sp 3.");
  designate(position(15.0, 29.0));
  EXPECT_STREQ(pilot.state.target_name, "3.01");
  pilot.press("sp 2.01");
  designate(position(-10.0, 22.5));
  EXPECT_STREQ(pilot.state.target_name, "2.02");
}

TEST_F(Designating, TheDesignatedTargetCanBeSelectedAndStaysSelectedWhenItMoves) {
  designate(position(0.0, 20.0));
  ASSERT_TRUE(pilot.press("sp 4."));
  EXPECT_STREQ(pilot.state.sequence_point, "4.");
  designate(position(0.0, 22.0));
  EXPECT_STREQ(pilot.state.sequence_point, "4.");
}

TEST_F(Designating, WithAllNumbersTakenTgtShowsNoFreeNumber) {
  pilot.configuration.route.clear();
  for (int n = 1; n <= 100; ++n)
    pilot.configuration.route.push_back(
        route_point(std::to_string(n), radar::PointKind::steer, position(1.0 * n, 20.0)));
  select_function(radar::CursorFunction::target);
  pilot.press("tdc release");
  EXPECT_STREQ(pilot.state.message, "NO FREE NUMBER");
  EXPECT_EQ(pilot.state.target_count, 0U);
}

TEST_F(Designating, RangingHasSlantRangeBearingAndDepression) {
  designate(position(30.0, 10.0));
  // The target is 18,520 m away and 4,452 m below the aircraft. Over that distance the earth curves down by 27 m.
  const double level_m = 18'520.0;
  const double down_m = 4572.0 - 120.0 + level_m * level_m / (2.0 * 6.37e6);
  EXPECT_NEAR(outputs().slant_range_m, std::hypot(level_m, down_m), 15.0);
  EXPECT_NEAR(outputs().bearing_deg, 30.0, 0.05);
  EXPECT_NEAR(outputs().depression_deg, std::atan2(down_m, level_m) / geo::kRadiansPerDegree, 0.05);
}

TEST_F(Designating, WithoutATargetThereIsNoRangingAndNoSteering) {
  EXPECT_TRUE(std::isnan(outputs().slant_range_m));
  EXPECT_EQ(outputs().steering, 0);
  EXPECT_EQ(steering_line(), "-");
}

TEST_F(Designating, PowerOffForgetsTheTarget) {
  designate(position(0.0, 20.0));
  pilot.press("power off");
  pilot.press("power opr");
  EXPECT_FALSE(pilot.is(databuffer::kTargetDesignated));
  EXPECT_EQ(steering_line(), "-");
  EXPECT_EQ(outputs().target_count, 1U) << "counts that other programs compare continue";
}

TEST_F(Designating, TheSteeringLineFollowsTheLineOfSight) {
  designate(position(20.0, 20.0));
  EXPECT_EQ(steering_line(), "LOS");
  EXPECT_NEAR(pilot.state.steering_line_deg, 20.0, 1e-9);
  const geo::GeoPoint elsewhere =
      geo::geodesic_direct(position(20.0, 20.0), geo::Bearing::degrees(270.0), geo::Length::nautical_miles(10.0));
  pilot.around.ownship.latitude_deg = elsewhere.latitude_deg;
  pilot.around.ownship.longitude_deg = elsewhere.longitude_deg;
  pilot.wait();
  EXPECT_NEAR(pilot.state.steering_line_deg, 90.0, 0.2);
}

TEST_F(Designating, AcqAftSlewsTheLineReleaseFixesItAndAcqFwdCancels) {
  designate(position(20.0, 20.0));
  const geo::GeoPoint before{pilot.state.cursor_latitude_deg, pilot.state.cursor_longitude_deg};
  ASSERT_TRUE(pilot.press("acq aft"));
  EXPECT_EQ(steering_line(), "SLEW");
  pilot.send("tdc 1 0");
  pilot.wait(200);
  EXPECT_NEAR(pilot.state.steering_line_deg, 65.0, 0.3) << "1 s at 45 deg/s to the right";
  EXPECT_EQ(pilot.state.cursor_latitude_deg, before.latitude_deg) << "the TDC turns the line, not the cursor";
  pilot.send("tdc 0 0");
  ASSERT_TRUE(pilot.press("tdc release"));
  EXPECT_EQ(steering_line(), "FIXED");
  EXPECT_EQ(outputs().target_count, 1U) << "the release fixed the line and designated nothing";
  pilot.around.ownship.latitude_deg += 0.1;
  pilot.wait();
  EXPECT_NEAR(pilot.state.steering_line_deg, 65.0, 0.3) << "the line is fixed";
  ASSERT_TRUE(pilot.press("acq fwd"));
  EXPECT_EQ(steering_line(), "LOS");
  EXPECT_FALSE(pilot.press("acq fwd"));
  ASSERT_TRUE(pilot.press("tdc release"));
  EXPECT_EQ(outputs().target_count, 2U) << "after acq fwd the release designates again";
}

TEST_F(Designating, LeavingTgtEndsSlewingOfTheLine) {
  designate(position(20.0, 20.0));
  pilot.press("acq aft");
  pilot.press("pb 7");
  EXPECT_EQ(steering_line(), "LOS");
  pilot.press("tdc 1 0");
  const double before_deg = pilot.state.cursor_longitude_deg;
  pilot.wait(50);
  EXPECT_GT(pilot.state.cursor_longitude_deg, before_deg) << "the TDC moves the cursor again";
}

TEST_F(Designating, AzimuthSteeringIsTheBearingOfTheTargetRelativeToTheTrack) {
  fly(15.0);
  designate(position(20.0, 20.0));
  EXPECT_EQ(outputs().steering, static_cast<std::uint8_t>(databuffer::SteeringCommand::azimuth));
  EXPECT_NEAR(outputs().steering_deg, 5.0, 1e-9);
  EXPECT_NEAR(outputs().approach_deg, 20.0, 1e-9);
}

TEST_F(Designating, BankSteeringTurnsTowardsTheFixedLine) {
  designate(position(0.0, 20.0));
  pilot.press("acq aft");
  pilot.press("tdc release");
  const auto bank_deg = [&](double heading_deg, double right_nm) {
    fly(heading_deg);
    const geo::GeoPoint at =
        geo::geodesic_direct(kAircraftPosition, geo::Bearing::degrees(90.0), geo::Length::nautical_miles(right_nm));
    pilot.around.ownship.latitude_deg = at.latitude_deg;
    pilot.around.ownship.longitude_deg = at.longitude_deg;
    return outputs().steering_deg;
  };
  EXPECT_EQ(outputs().steering, static_cast<std::uint8_t>(databuffer::SteeringCommand::bank));
  EXPECT_NEAR(bank_deg(0.0, 0.0), 0.0, 0.1) << "on the line, track along it";
  EXPECT_LT(bank_deg(0.0, 1.0), -10.0) << "right of the line: bank left";
  EXPECT_GT(bank_deg(0.0, -1.0), 10.0);
  EXPECT_GT(bank_deg(-30.0, 0.0), 10.0) << "on the line, track 30 deg to the left: bank right";
  EXPECT_GE(bank_deg(179.0, 3.0), -60.0);
  EXPECT_LE(bank_deg(-179.0, -3.0), 60.0);
}

// An aircraft that follows the bank command for 120 s at 200 m/s flies along the line towards the target.
TEST_F(Designating, FollowingTheBankCommandEndsOnTheLine) {
  designate(position(0.0, 20.0));
  pilot.press("acq aft");
  pilot.press("tdc release");
  double heading_rad = -0.6;
  geo::GeoPoint at =
      geo::geodesic_direct(kAircraftPosition, geo::Bearing::degrees(90.0), geo::Length::nautical_miles(3.0));
  constexpr double step_s = 0.25;
  for (int step = 0; step < 480; ++step) {
    pilot.around.ownship.latitude_deg = at.latitude_deg;
    pilot.around.ownship.longitude_deg = at.longitude_deg;
    fly(heading_rad / geo::kRadiansPerDegree);
    const double bank_rad = outputs().steering_deg * geo::kRadiansPerDegree;
    heading_rad += 9.80665 * std::tan(bank_rad) / 200.0 * step_s;
    at = geo::geodesic_direct(at, geo::Bearing::radians(heading_rad), geo::Length::metres(200.0 * step_s));
  }
  const auto line = geo::geodesic_inverse(at, position(0.0, 20.0));
  const double off_m = line.distance.metres() * std::sin(line.azimuth_at_start.radians());
  EXPECT_LT(std::abs(off_m), 30.0);
}

}  // namespace
}  // namespace yars::statemachine::testing
