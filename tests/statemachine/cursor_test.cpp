// The cursor: its ground point, slewing by the TDC, its limits on the display. The sequence points that are drawn.
#include <gtest/gtest.h>

#include "lib/radar/mission.hpp"
#include "tests/statemachine/pilot.hpp"

namespace yars::statemachine::testing {
namespace {

class CursorOnDisplay : public ::testing::Test {
 protected:
  CursorOnDisplay() { pilot.press("power opr"); }

  // Position of the cursor on a display with ground track up, in fractions of the range: x to the right, y along the
  // track. Computed independently of the code under test.
  struct DisplayPosition {
    double x, y;
  };
  DisplayPosition cursor(double apex_latitude_deg, double apex_longitude_deg, double track_deg) const {
    const auto inverse = geo::geodesic_inverse({apex_latitude_deg, apex_longitude_deg},
                                               {pilot.state.cursor_latitude_deg, pilot.state.cursor_longitude_deg});
    const double angle_rad = (inverse.azimuth_at_start.degrees() - track_deg) * geo::kRadiansPerDegree;
    const double radius = inverse.distance.nautical_miles() / pilot.state.range_nm;
    return {radius * std::sin(angle_rad), radius * std::cos(angle_rad)};
  }
  DisplayPosition cursor() const {
    return cursor(pilot.around.ownship.latitude_deg, pilot.around.ownship.longitude_deg, 0.0);
  }
  void fly_to(geo::GeoPoint where) {
    pilot.around.ownship.latitude_deg = where.latitude_deg;
    pilot.around.ownship.longitude_deg = where.longitude_deg;
  }
  std::vector<std::string> points_drawn() const {
    std::vector<std::string> names;
    for (int point = 0; point < pilot.state.points_drawn; ++point) names.emplace_back(pilot.state.points[point].name);
    return names;
  }
  void take_route(std::vector<radar::RoutePoint> route) {
    pilot.configuration.route = std::move(route);
    pilot.state = initial_state(pilot.configuration);
    pilot.press("power opr");
    pilot.press("pb 13");
  }

  Pilot pilot;
};

TEST_F(CursorOnDisplay, FullTdcDeflectionCrossesTheDisplayInTwoSeconds) {
  // From the left edge to the right edge: 400 ticks of 5 ms.
  pilot.send("tdc -1 0");
  pilot.wait(500);
  ASSERT_NEAR(cursor().x, -0.6, 1e-9);
  pilot.send("tdc 1 0");
  pilot.wait(399);
  EXPECT_LT(cursor().x, 0.6 - 0.002);
  pilot.wait(1);
  EXPECT_NEAR(cursor().x, 0.6, 1e-6);
}

TEST_F(CursorOnDisplay, SlewingUpMovesAlongTheGroundTrackInProportionToTheDeflection) {
  const DisplayPosition before = cursor();
  pilot.send("tdc 0 0.5");
  pilot.wait(100);
  EXPECT_NEAR(cursor().x, before.x, 1e-6);
  EXPECT_NEAR(cursor().y, before.y + 0.15, 1e-6);
  pilot.send("tdc 0 0");
  pilot.wait(100);
  EXPECT_NEAR(cursor().y, before.y + 0.15, 1e-6) << "without deflection the cursor stops";
}

TEST_F(CursorOnDisplay, TheCursorStopsAtEveryEdgeOfTheDisplay) {
  struct Edge {
    const char* event;
    double x, y;
  };
  for (const Edge& edge : {Edge{"tdc 1 1", 0.6, 1.1}, Edge{"tdc 0 -1", 0.6, -0.1}, Edge{"tdc -1 0", -0.6, -0.1}}) {
    pilot.send(edge.event);
    pilot.wait(500);
    EXPECT_NEAR(cursor().x, edge.x, 1e-9) << edge.event;
    EXPECT_NEAR(cursor().y, edge.y, 1e-9) << edge.event;
  }
}

TEST_F(CursorOnDisplay, TheCursorStaysOnItsGroundPointWhileTheAircraftFlies) {
  const double latitude_deg = pilot.state.cursor_latitude_deg;
  const double longitude_deg = pilot.state.cursor_longitude_deg;
  const double range_nm = pilot.state.cursor_range_nm;
  fly_to(position(10.0, 5.0));
  pilot.wait(10);
  EXPECT_EQ(pilot.state.cursor_latitude_deg, latitude_deg);
  EXPECT_EQ(pilot.state.cursor_longitude_deg, longitude_deg);
  // Point 1, under the cursor, is 12 NM away at a bearing of 10 degrees. The aircraft flies 5 NM towards it.
  EXPECT_NEAR(range_nm, 12.0, 1e-9);
  EXPECT_NEAR(pilot.state.cursor_range_nm, 7.0, 1e-9);
}

TEST_F(CursorOnDisplay, BearingUsesTheNavigatorsMagneticVariationElseTheConfigured) {
  EXPECT_NEAR(pilot.state.cursor_bearing_deg, 10.0, 1e-9);
  pilot.configuration.magnetic_variation_deg = 13.0;
  pilot.wait();
  EXPECT_NEAR(pilot.state.cursor_bearing_deg, 357.0, 1e-9);
  pilot.around.nav.magnetic_variation_deg = -4.0;
  pilot.wait();
  EXPECT_NEAR(pilot.state.cursor_bearing_deg, 14.0, 1e-9);
}

TEST_F(CursorOnDisplay, TheCursorTakesItsElevationFromTheModel) {
  pilot.ground = [](geo::GeoPoint) { return 321.0; };
  pilot.wait(2);
  EXPECT_EQ(pilot.state.cursor_elevation_m, 321.0);
  pilot.send("sp 3.");
  EXPECT_TRUE(std::isnan(pilot.state.cursor_elevation_m)) << "the elevation of the previous position is not kept";
  pilot.wait(2);
  EXPECT_EQ(pilot.state.cursor_elevation_m, 321.0);
}

TEST_F(CursorOnDisplay, ACursorOutsideTheDisplayReturnsToTheEdgeWhenSlewed) {
  fly_to(position(0.0, 60.0));
  pilot.wait();
  ASSERT_LT(cursor().y, -0.1);
  pilot.send("tdc 0 -0.1");
  pilot.wait();
  EXPECT_NEAR(cursor().y, -0.1, 1e-9);
}

TEST_F(CursorOnDisplay, OnAFrozenPictureTheCursorIsSlewedInTheFrameOfTheLastSweep) {
  pilot.send("freeze");
  pilot.around.model.flags = databuffer::kModelFrozen;
  pilot.wait();
  // The aircraft turns east and flies on. The frozen picture keeps its apex and its ground track.
  pilot.around.ownship.velocity_north_mps = 0.0;
  pilot.around.ownship.velocity_east_mps = 200.0;
  fly_to(position(90.0, 3.0));
  const DisplayPosition before = cursor(kAircraftPosition.latitude_deg, kAircraftPosition.longitude_deg, 0.0);
  pilot.send("tdc 0 1");
  pilot.wait(10);
  const DisplayPosition after = cursor(kAircraftPosition.latitude_deg, kAircraftPosition.longitude_deg, 0.0);
  EXPECT_NEAR(after.x, before.x, 1e-6);
  EXPECT_NEAR(after.y, before.y + 10 * 1.2 / 400, 1e-6);
}

TEST_F(CursorOnDisplay, AfterFreezeTheFrameFollowsTheAircraftUntilTheScanEnds) {
  pilot.send("freeze");
  pilot.around.model.flags = databuffer::kModelScanning;
  fly_to(position(90.0, 3.0));
  pilot.wait();
  EXPECT_EQ(pilot.state.frame_longitude_deg, pilot.around.ownship.longitude_deg);
}

TEST_F(CursorOnDisplay, InPvuAndAirToAirTheTdcDoesNotSlewTheCursor) {
  for (const char* event : {"radar pvu", "mode aa"}) {
    pilot.press(event);
    pilot.send("tdc 1 0");
    const double longitude_deg = pilot.state.cursor_longitude_deg;
    pilot.wait(100);
    EXPECT_EQ(pilot.state.cursor_longitude_deg, longitude_deg) << event;
    pilot.send("tdc 0 0");
  }
  pilot.send("mode ag");
  pilot.send("radar rbm");
  const double longitude_deg = pilot.state.cursor_longitude_deg;
  pilot.wait(100);
  EXPECT_EQ(pilot.state.cursor_longitude_deg, longitude_deg);
}

TEST_F(CursorOnDisplay, AtPowerUpTheCursorIsAtHalfRangeAheadIfTheFirstPointIsOffTheDisplay) {
  take_route({route_point("1", radar::PointKind::steer, position(180.0, 50.0))});
  EXPECT_NEAR(cursor().x, 0.0, 1e-6);
  EXPECT_NEAR(pilot.state.cursor_range_nm, 10.0, 1e-6);
}

TEST_F(CursorOnDisplay, WithoutGroundSpeedTheFrameHasTheHeadingUp) {
  pilot.around.ownship.velocity_north_mps = 0.0;
  pilot.around.ownship.heading_deg = 90.0;
  pilot.wait();
  EXPECT_EQ(pilot.state.frame_track_deg, 90.0);
}

TEST_F(CursorOnDisplay, SteppingCyclesThroughTheDrawnPointsEachBeforeItsOffsets) {
  pilot.press("pb 13");
  ASSERT_EQ(points_drawn(), (std::vector<std::string>{"1", "1.1", "2", "2.01", "3."}));
  for (const char* name : {"1.1", "2", "2.01", "3.", "1"}) {
    pilot.press("coolie up");
    EXPECT_STREQ(pilot.state.sequence_point, name);
    EXPECT_EQ(pilot.legend(17), name);
    EXPECT_EQ(point_under_cursor(pilot), name);
  }
}

TEST_F(CursorOnDisplay, SteppingOntoTheOnlyPointBringsTheCursorBackToIt) {
  take_route({route_point("7", radar::PointKind::steer, position(0.0, 10.0))});
  pilot.send("tdc 1 0");
  pilot.wait(10);
  pilot.send("tdc 0 0");
  ASSERT_EQ(point_under_cursor(pilot), "-");
  EXPECT_TRUE(pilot.press("pb 17"));
  EXPECT_EQ(point_under_cursor(pilot), "7");
}

TEST_F(CursorOnDisplay, PointsBeyondTheRangeAreNotDrawnButTheSelectedOneIs) {
  EXPECT_EQ(points_drawn(), (std::vector<std::string>{"1", "1.1", "2"}));
  pilot.press("sp 3.");
  EXPECT_EQ(points_drawn(), (std::vector<std::string>{"1", "1.1", "2", "3."}));
  EXPECT_EQ(pilot.state.points[3].selected, 1);
  EXPECT_EQ(pilot.state.points[0].selected, 0);
}

TEST_F(CursorOnDisplay, AtMostFivePointsAreDrawnTheNearestAndTheSelectedOne) {
  std::vector<radar::RoutePoint> route;
  for (int number = 1; number <= 8; ++number)
    route.push_back(route_point(std::to_string(number), radar::PointKind::steer, position(0.0, 2.0 * number)));
  take_route(route);
  EXPECT_EQ(points_drawn(), (std::vector<std::string>{"1", "2", "3", "4", "5"}));
  pilot.press("sp 8");
  EXPECT_EQ(points_drawn(), (std::vector<std::string>{"1", "2", "3", "4", "8"}));
  // Farther along the route, other points are the nearest. The selection changes without an event.
  fly_to(position(0.0, 14.0));
  pilot.wait(40);
  EXPECT_EQ(points_drawn(), (std::vector<std::string>{"4", "5", "6", "7", "8"}));
}

TEST_F(CursorOnDisplay, DeclutterKeepsTargetsTheirOffsetsAndTheSelectedPoint) {
  pilot.press("pb 13");
  pilot.press("pb 2");
  EXPECT_EQ(points_drawn(), (std::vector<std::string>{"1", "2.01", "3."}));
  pilot.press("pb 17");
  EXPECT_EQ(points_drawn(), (std::vector<std::string>{"2.01", "3."}));
  pilot.press("pb 2");
  EXPECT_EQ(points_drawn().size(), 5U);
}

TEST_F(CursorOnDisplay, ADrawnPointHasPositionElevationAndKindOfTheRoutePoint) {
  const databuffer::DrawnPoint& point = pilot.state.points[0];
  EXPECT_EQ(point.latitude_deg, pilot.configuration.route[0].position.latitude_deg);
  EXPECT_EQ(point.longitude_deg, pilot.configuration.route[0].position.longitude_deg);
  EXPECT_EQ(point.elevation_m, 100.0);
  EXPECT_EQ(point.kind, static_cast<std::uint8_t>(radar::PointKind::steer));
}

TEST_F(CursorOnDisplay, WithoutARouteSteppingIsDead) {
  take_route({});
  EXPECT_FALSE(pilot.press("pb 17"));
  EXPECT_EQ(pilot.legend(17), "");
  EXPECT_EQ(pilot.state.points_drawn, 0);
}

}  // namespace
}  // namespace yars::statemachine::testing
