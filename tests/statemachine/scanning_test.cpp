// Range, window, scan width and antenna elevation. Source: docs/pilots_manual.md#rule-1, #rule-2, #rule-4.
#include <gtest/gtest.h>

#include "tests/statemachine/pilot.hpp"

namespace yars::statemachine::testing {
namespace {

class Scanning : public ::testing::Test {
 protected:
  Scanning() { pilot.press("power opr"); }
  Pilot pilot;
};

// Rule 1: the range at power-up and at a mode change follows from the height above the ground.
struct HeightCase {
  double altimeter_ft;
  double range_nm;
};

TEST(RangeByHeight, FollowsTheRadarAltimeter) {
  for (const auto& [altimeter_ft, range_nm] :
       {HeightCase{0, 10}, HeightCase{500, 10}, HeightCase{501, 20}, HeightCase{1000, 20}, HeightCase{1001, 40}}) {
    Pilot pilot;
    pilot.around.ownship.radar_altitude_m = altimeter_ft * 0.3048;
    pilot.press("power opr");
    EXPECT_EQ(pilot.state.range_nm, range_nm) << altimeter_ft << " ft";
  }
}

// The aircraft is 900 ft above the nearest point, which lies at 1,000 m: 20 NM. Its altitude above sea level would give
// 40 NM.
TEST(RangeByHeight, WithoutAltimeterUsesTheHeightAboveTheNearestSequencePoint) {
  Pilot pilot;
  pilot.configuration.route = {route_point("1", radar::PointKind::steer, position(0.0, 30.0), 0.0),
                               route_point("2", radar::PointKind::steer, position(180.0, 5.0), 1000.0),
                               route_point("3", radar::PointKind::steer, position(90.0, 10.0), 0.0)};
  pilot.state = initial_state(pilot.configuration);
  pilot.around.ownship.altitude_msl_m = 1000.0 + 900.0 * 0.3048;
  pilot.around.ownship.radar_altitude_m = kNaN;
  pilot.press("power opr");
  EXPECT_EQ(pilot.state.range_nm, 20.0);
}

TEST(RangeByHeight, WithoutAltimeterDataUsesTheHeightAboveTerrainWithinTheAltimetersLimit) {
  Pilot pilot;
  pilot.around.ownship.radar_altitude_m = kNaN;
  pilot.around.height_above_ground_m = 290.0;  // 951 ft above terrain at 14,049 ft
  pilot.press("power opr");
  EXPECT_EQ(pilot.state.range_nm, 20.0);
  pilot.press("altimeter fail");
  pilot.press("pb 6");
  EXPECT_EQ(pilot.state.range_nm, 40.0) << "a failed altimeter gives no height";
  pilot.press("altimeter ok");
  pilot.around.height_above_ground_m = 2000.0;
  pilot.around.ownship.altitude_msl_m = 250.0;
  for (auto& point : pilot.configuration.route) point.elevation_m = kNaN;
  pilot.press("pb 6");
  EXPECT_EQ(pilot.state.range_nm, 20.0) << "above its limit the altimeter gives no height";
}

TEST(RangeByHeight, AFailedAltimeterIsNotUsed) {
  Pilot pilot;
  pilot.around.ownship.radar_altitude_m = 100.0;
  pilot.press("power opr");
  EXPECT_EQ(pilot.state.range_nm, 10.0);
  pilot.press("altimeter fail");
  pilot.press("pb 6");
  EXPECT_EQ(pilot.state.range_nm, 40.0);
  pilot.press("altimeter ok");
  pilot.press("pb 6");
  EXPECT_EQ(pilot.state.range_nm, 10.0);
}

TEST(RangeByHeight, WithoutAltimeterAndPointElevationUsesTheAltitudeAboveSeaLevel) {
  Pilot pilot;
  pilot.around.ownship.radar_altitude_m = kNaN;
  pilot.around.ownship.altitude_msl_m = 300.0;  // 984 ft
  for (auto& point : pilot.configuration.route) point.elevation_m = kNaN;
  pilot.press("power opr");
  EXPECT_EQ(pilot.state.range_nm, 20.0);

  Pilot without_route;
  without_route.around = pilot.around;
  without_route.configuration.route.clear();
  without_route.state = initial_state(without_route.configuration);
  without_route.press("power opr");
  EXPECT_EQ(without_route.state.range_nm, 20.0);
}

TEST(RangeByHeight, IsSetWithTheFirstOwnshipUnlessThePilotHasSelectedARange) {
  Pilot pilot;
  pilot.around.ownship_valid = false;
  pilot.press("power opr");
  EXPECT_EQ(pilot.state.range_nm, 40.0);
  Pilot chooser = pilot;
  pilot.around.ownship_valid = true;
  pilot.wait();
  EXPECT_EQ(pilot.state.range_nm, 20.0);

  chooser.press("pb 13");
  chooser.around.ownship_valid = true;
  chooser.wait();
  EXPECT_EQ(chooser.state.range_nm, 80.0);
}

TEST_F(Scanning, RangesStopAtBothEnds) {
  for (const double range_nm : {40.0, 80.0, 160.0}) {
    EXPECT_TRUE(pilot.press("pb 13"));
    EXPECT_EQ(pilot.state.range_nm, range_nm);
  }
  EXPECT_FALSE(pilot.press("pb 13"));
  for (const double range_nm : {80.0, 40.0, 20.0, 10.0, 4.7}) {
    EXPECT_TRUE(pilot.press("pb 14"));
    EXPECT_EQ(pilot.state.range_nm, range_nm);
  }
  EXPECT_FALSE(pilot.press("pb 14"));
}

TEST_F(Scanning, RangeIsDeadInCursorFunctionsOtherThanMap) {
  for (const char* mode : {"rbm", "hrm", "bcn"}) {
    pilot.press(std::string("radar ") + mode);
    for (const char* function : {"UPDT", "CUE", "TGT", "MARK"}) {
      pilot.press("pb 7");
      ASSERT_EQ(fields_of(pilot).at("cursor_function"), function);
      EXPECT_FALSE(pilot.press("pb 13")) << mode << function;
      EXPECT_FALSE(pilot.press("pb 14")) << mode << function;
    }
    pilot.press("pb 7");
    EXPECT_TRUE(pilot.press("pb 13")) << mode;
  }
}

TEST_F(Scanning, ScanCyclesThroughFullHalfAndQuarterWidth) {
  const std::vector<std::pair<std::string, double>> widths{{"HALF", 50.0}, {"QTR", 25.0}, {"FULL", 100.0}};
  for (const auto& [name, width_deg] : widths) {
    pilot.press("pb 9");
    EXPECT_EQ(pilot.legend(9), name);
    EXPECT_EQ(pilot.state.scan_width_deg, width_deg);
  }
}

TEST_F(Scanning, ElevationStopsAtSixtyDegrees) {
  pilot.press("elevation 59.8");
  pilot.press("elevation up");
  EXPECT_EQ(pilot.state.antenna_elevation_deg, 60.0);
  EXPECT_FALSE(pilot.press("elevation up"));
  pilot.press("elevation -60");
  EXPECT_FALSE(pilot.press("elevation down 10"));
  EXPECT_EQ(pilot.state.antenna_elevation_deg, -60.0);
}

TEST_F(Scanning, TheWindowStepsUpToTheRangeAndDownToBlank) {
  pilot.press("pb 13");  // 40 NM
  for (const double window_nm : {10.0, 20.0, 40.0}) {
    EXPECT_TRUE(pilot.press("acq fwd"));
    EXPECT_EQ(pilot.state.window_nm, window_nm);
  }
  EXPECT_FALSE(pilot.press("acq fwd"));
  for (const double window_nm : {20.0, 10.0, 4.7, 3.3, 1.3, 0.67, 0.0}) {
    EXPECT_TRUE(pilot.press("acq aft"));
    EXPECT_EQ(pilot.state.window_nm, window_nm);
  }
  EXPECT_FALSE(pilot.press("acq aft"));
  EXPECT_TRUE(pilot.press("acq fwd"));
  EXPECT_EQ(pilot.state.window_nm, 0.67);
}

TEST_F(Scanning, TheLargestWindowAtRange160NmIs80Nm) {
  for (int press = 0; press < 3; ++press) pilot.press("pb 13");
  for (int press = 0; press < 4; ++press) EXPECT_TRUE(pilot.press("acq fwd"));
  EXPECT_EQ(pilot.state.window_nm, 80.0);
  EXPECT_FALSE(pilot.press("acq fwd"));
}

TEST_F(Scanning, AWindowLargerThanTheRangeShrinksToTheLargestThatFits) {
  pilot.press("acq fwd");
  pilot.press("acq fwd");
  ASSERT_EQ(pilot.state.window_nm, 20.0);
  pilot.press("pb 14");
  EXPECT_EQ(pilot.state.window_nm, 10.0);
  pilot.press("pb 14");
  EXPECT_EQ(pilot.state.window_nm, 4.7);
  pilot.press("pb 13");
  EXPECT_EQ(pilot.state.window_nm, 4.7);
}

TEST_F(Scanning, ABlankWindowStaysBlankWhenTheRangeChanges) {
  for (int press = 0; press < 4; ++press) pilot.press("acq aft");
  ASSERT_EQ(pilot.state.window_nm, 0.0);
  pilot.press("pb 14");
  EXPECT_EQ(pilot.state.window_nm, 0.0);
}

TEST_F(Scanning, TheAcquisitionSwitchStepsTheWindowOnlyInCursorFunctionMap) {
  pilot.press("pb 7");
  EXPECT_FALSE(pilot.press("acq fwd"));
}

TEST_F(Scanning, TheScanRestartsOnlyForEventsThatChangeIt) {
  for (const char* event : {"pb 9", "pb 13", "pb 14", "pb 6", "radar rbm", "mode aa", "mode ag", "power stby",
                            "power opr", "power off", "power opr"}) {
    const auto before = pilot.state.scan_restart;
    ASSERT_TRUE(pilot.press(event)) << event;
    EXPECT_GT(pilot.state.scan_restart, before) << event;
  }
  // PB 6 closes the menu that PB 11 has opened.
  for (const char* event : {"pb 17", "acq aft", "pb 2", "pb 3", "pb 4", "pb 7", "pb 11", "pb 6", "freeze", "pb 16",
                            "pb 18", "pb 19", "pb 20", "elevation -5", "contrast up", "nav ins", "tdc 1 0"}) {
    const auto before = pilot.state.scan_restart;
    ASSERT_TRUE(pilot.press(event)) << event;
    EXPECT_EQ(pilot.state.scan_restart, before) << event;
  }
}

}  // namespace
}  // namespace yars::statemachine::testing
