// Errors of the navigators: effect on symbols and cursor, drift and random walk, and correction by UPDT.
// Source: docs/spec/physics.md#navigation-errors, docs/pilots_manual.md#rule-13.
#include <gtest/gtest.h>

#include "databuffer/messages/derived_values.hpp"
#include "lib/radar/mission.hpp"
#include "statemachine/navigation_errors.hpp"
#include "tests/statemachine/pilot.hpp"

namespace yars::statemachine::testing {
namespace {

constexpr int kTicksPerSecond = 200;

class Navigators : public ::testing::Test {
 protected:
  Navigators() { pilot.press("power opr"); }

  // True and estimated position of the aircraft, by the selected navigator.
  databuffer::NavigatorPosition belief() const {
    return databuffer::selected_navigator_position(pilot.around.ownship, pilot.around.nav, pilot.state);
  }
  geo::GeoPoint cursor() const { return {pilot.state.cursor_latitude_deg, pilot.state.cursor_longitude_deg}; }
  geo::GeoPoint believed_cursor() const {
    return {pilot.state.cursor_believed_latitude_deg, pilot.state.cursor_believed_longitude_deg};
  }
  const radar::RoutePoint& point(std::size_t index) const { return pilot.configuration.route[index]; }
  static double metres_between(geo::GeoPoint a, geo::GeoPoint b) {
    return geo::geodesic_inverse(a, b).distance.metres();
  }
  void select_function(radar::CursorFunction function) {
    while (pilot.state.cursor_function != static_cast<std::uint8_t>(function)) pilot.press("pb 7");
  }
  // Moves the cursor to the video of a position, as the TDC would.
  void put_cursor_on(geo::GeoPoint position) {
    pilot.state.cursor_latitude_deg = position.latitude_deg;
    pilot.state.cursor_longitude_deg = position.longitude_deg;
    pilot.state.cursor_moved_tick = pilot.around.tick;
    pilot.wait();
  }
  double offset_ft() const {
    return geo::Length::metres(std::hypot(pilot.state.update_north_m, pilot.state.update_east_m)).feet();
  }

  Pilot pilot;
};

TEST_F(Navigators, WithoutAnErrorTheVideoPositionEqualsTheCoordinatesExactly) {
  const geo::GeoPoint seen = belief().on_video(point(0).position);
  EXPECT_EQ(seen.latitude_deg, point(0).position.latitude_deg);
  EXPECT_EQ(seen.longitude_deg, point(0).position.longitude_deg);
}

TEST_F(Navigators, ANavigator2500FeetTooFarNorthDrawsPoints2500FeetTooFarSouth) {
  pilot.press("nav error mn 2500 0");
  const geo::GeoPoint seen = belief().on_video(point(0).position);
  EXPECT_NEAR(metres_between(seen, point(0).position), geo::Length::feet(2500.0).metres(), 2.0);
  EXPECT_LT(seen.latitude_deg, point(0).position.latitude_deg);
  const geo::GeoPoint back = belief().coordinates_from_video(seen);
  EXPECT_LT(metres_between(back, point(0).position), 1e-6);
}

TEST_F(Navigators, TheErrorOfTheNavLaneIsAdded) {
  pilot.around.nav.mission_latitude_deg = kAircraftPosition.latitude_deg + 0.01;
  pilot.around.nav.mission_longitude_deg = kAircraftPosition.longitude_deg;
  const double lane_m = metres_between(belief().estimated, belief().truth);
  pilot.press("nav error mn 2500 0");
  EXPECT_NEAR(metres_between(belief().estimated, belief().truth), lane_m + geo::Length::feet(2500.0).metres(), 1e-3);
}

TEST_F(Navigators, TheCursorJumpsToTheSymbolAndHasTheCoordinatesOfThePoint) {
  pilot.press("nav error mn 2500 -1000");
  pilot.press("sp 1");
  EXPECT_NEAR(metres_between(cursor(), point(0).position), geo::Length::feet(std::hypot(2500.0, 1000.0)).metres(), 3.0)
      << "the cursor lies on the displaced symbol";
  EXPECT_LT(metres_between(believed_cursor(), point(0).position), 1e-6) << "its estimated position is the point";
}

TEST_F(Navigators, AMapIsCommandedAtTheTruePositionUnderTheCursor) {
  pilot.press("nav error mn 2500 0");
  pilot.press("sp 2");
  ASSERT_TRUE(pilot.press("tdc release"));
  EXPECT_EQ(pilot.state.map_latitude_deg, pilot.state.cursor_latitude_deg);
  EXPECT_EQ(pilot.state.map_longitude_deg, pilot.state.cursor_longitude_deg);
}

TEST_F(Navigators, EachNavigatorHasItsOwnError) {
  pilot.press("nav error ins 0 4000");
  EXPECT_EQ(metres_between(belief().estimated, belief().truth), 0.0) << "the mission navigator is in use";
  pilot.press("nav ins");
  EXPECT_NEAR(metres_between(belief().estimated, belief().truth), geo::Length::feet(4000.0).metres(), 1e-6);
}

TEST_F(Navigators, DriftMovesTheBelievedPosition) {
  pilot.press("nav drift mn 3 -4");
  pilot.wait(60 * kTicksPerSecond - 1);
  EXPECT_NEAR(pilot.state.mission.north_m, geo::Length::feet(180.0).metres(), 1e-6);
  EXPECT_NEAR(pilot.state.mission.east_m, geo::Length::feet(-240.0).metres(), 1e-6);
  EXPECT_EQ(pilot.state.ins.north_m, 0.0);
}

TEST_F(Navigators, ASessionBeginsWithTheErrorsConfigured) {
  pilot.configuration.navigation.error_north_m = 100.0;
  pilot.configuration.navigation.drift_down_mps = -1.0;
  const databuffer::RadarState state = initial_state(pilot.configuration);
  for (const auto& error : {state.mission, state.ins}) {
    EXPECT_EQ(error.north_m, 100.0);
    EXPECT_EQ(error.velocity_down_mps, -1.0);
  }
}

TEST_F(Navigators, TheRandomWalkOfVelocityHasTheConfiguredRmsAfterAnHour) {
  // 300 separate hours with one step per second. walk_mps is the rms after one hour.
  pilot.configuration.navigation.walk_mps = 2.0;
  double sum = 0.0;
  constexpr int kHours = 300;
  databuffer::RadarState state = initial_state(pilot.configuration);
  for (int hour = 0; hour < kHours; ++hour) {
    state.mission = state.ins = {};
    for (int second = 0; second < 3600; ++second)
      advance_navigators(state, std::int64_t{kTicksPerSecond} * (3600 * hour + second), pilot.configuration);
    sum += state.mission.velocity_north_mps * state.mission.velocity_north_mps;
    ASSERT_EQ(state.mission.velocity_east_mps, state.ins.velocity_east_mps) << "both use the same INS";
  }
  EXPECT_NEAR(std::sqrt(sum / kHours), 2.0, 0.25);
}

TEST_F(Navigators, ErrorsRemainAfterPowerOff) {
  pilot.press("nav error mn 2500 0");
  pilot.press("power off");
  EXPECT_NEAR(pilot.state.mission.north_m, geo::Length::feet(2500.0).metres(), 1e-9);
}

TEST_F(Navigators, AnUpdateRemovesAnErrorOf2500Feet) {
  pilot.press("nav error mn 2000 1500");
  select_function(radar::CursorFunction::update);
  pilot.press("sp 1");
  EXPECT_NEAR(offset_ft(), 0.0, 1e-3) << "the cursor stands on the symbol";
  // On the video, the point lies off its symbol by the error.
  put_cursor_on(point(0).position);
  ASSERT_TRUE(pilot.is(databuffer::kUpdateShown));
  EXPECT_NEAR(offset_ft(), 2500.0, 10.0);
  EXPECT_GT(pilot.state.update_north_m, 0.0) << "the point lies north of its symbol";
  EXPECT_EQ(pilot.state.update_seconds, -1) << "for the mission navigator, no validity time runs";
  ASSERT_TRUE(pilot.press("tdc release"));
  EXPECT_NEAR(offset_ft(), 0.0, 1e-3);
  EXPECT_NEAR(pilot.state.mission.north_m, 0.0, 1e-3);
  EXPECT_NEAR(pilot.state.mission.east_m, 0.0, 1e-3);
  EXPECT_FALSE(pilot.press("tdc release")) << "the offset is already zero";
}

TEST_F(Navigators, AnUpdateIsExactAt35NmAndNearThePole) {
  for (const double latitude_deg : {0.0, 60.0, 85.0, 89.0}) {
    SCOPED_TRACE(latitude_deg);
    Pilot other;
    other.around.ownship.latitude_deg = latitude_deg;
    const geo::GeoPoint far =
        geo::geodesic_direct({latitude_deg, -121.0}, geo::Bearing::degrees(70.0), geo::Length::nautical_miles(35.0));
    other.configuration.route = {route_point("1", radar::PointKind::steer, far)};
    other.state = initial_state(other.configuration);
    for (const char* event : {"power opr", "nav error mn 6000 -5000", "pb 7"}) other.press(event);
    other.state.cursor_latitude_deg = far.latitude_deg;
    other.state.cursor_longitude_deg = far.longitude_deg;
    ASSERT_TRUE(other.press("tdc release"));
    const auto seen =
        databuffer::selected_navigator_position(other.around.ownship, other.around.nav, other.state).on_video(far);
    EXPECT_LT(metres_between(seen, far), 0.01);
  }
}

TEST_F(Navigators, TheUpdateCorrectsTheSelectedNavigator) {
  pilot.press("nav error mn 1000 0");
  pilot.press("nav error ins 0 1000");
  pilot.press("nav ins");
  select_function(radar::CursorFunction::update);
  put_cursor_on(point(0).position);
  ASSERT_TRUE(pilot.press("tdc release"));
  EXPECT_NEAR(pilot.state.ins.east_m, 0.0, 1e-3);
  EXPECT_NEAR(pilot.state.mission.north_m, geo::Length::feet(1000.0).metres(), 1e-9);
}

TEST_F(Navigators, ForTheInsTheCursorBecomesInvalidAfter30SecondsUntilItMoves) {
  pilot.press("nav error ins 500 500");
  pilot.press("nav ins");
  select_function(radar::CursorFunction::update);
  put_cursor_on(point(0).position);
  EXPECT_EQ(pilot.state.update_seconds, 30);
  pilot.wait(10 * kTicksPerSecond);
  EXPECT_EQ(pilot.state.update_seconds, 20);
  pilot.wait(20 * kTicksPerSecond);
  EXPECT_EQ(pilot.state.update_seconds, 0);
  EXPECT_TRUE(pilot.is(databuffer::kUpdateInvalid));
  EXPECT_FALSE(pilot.press("tdc release")) << "INV is not accepted";
  pilot.press("tdc 0.1 0");
  EXPECT_FALSE(pilot.is(databuffer::kUpdateInvalid));
  EXPECT_EQ(pilot.state.update_seconds, 30);
  EXPECT_TRUE(pilot.press("tdc release"));
}

TEST_F(Navigators, TheValidityTimeForTheInsIsConfigured) {
  pilot.configuration.navigation.update_validity_s = 5.0;
  pilot.press("nav ins");
  select_function(radar::CursorFunction::update);
  put_cursor_on(point(0).position);
  EXPECT_EQ(pilot.state.update_seconds, 5);
}

TEST_F(Navigators, TheUpdateIsShownOnlyInUpdtWithASelectedPoint) {
  EXPECT_FALSE(pilot.is(databuffer::kUpdateShown)) << "cursor function MAP";
  select_function(radar::CursorFunction::update);
  EXPECT_TRUE(pilot.is(databuffer::kUpdateShown));
  pilot.press("mode aa");
  EXPECT_FALSE(pilot.is(databuffer::kUpdateShown)) << "A/A has no cursor";
  pilot.press("mode ag");
  pilot.configuration.route.clear();
  pilot.wait();
  EXPECT_FALSE(pilot.is(databuffer::kUpdateShown)) << "no selected point";
}

TEST_F(Navigators, MagneticVariationComesFromNavigatorElseFieldModelElseConfiguration) {
  pilot.configuration.magnetic_variation_deg = 1.0;
  pilot.wait();
  EXPECT_EQ(pilot.state.magnetic_variation_deg, 1.0);
  pilot.around.field_variation_deg = 2.0;
  pilot.wait();
  EXPECT_EQ(pilot.state.magnetic_variation_deg, 2.0);
  pilot.around.nav.magnetic_variation_deg = 3.0;
  pilot.wait();
  EXPECT_EQ(pilot.state.magnetic_variation_deg, 3.0);
}

TEST_F(Navigators, AVariationThatNobodyGivesIsUnknownAndBearingsAreTrue) {
  pilot.wait();
  EXPECT_FALSE(pilot.is(databuffer::kVariationKnown));
  EXPECT_EQ(pilot.state.magnetic_variation_deg, 0.0);
  for (double* const source : {&pilot.configuration.magnetic_variation_deg, &pilot.around.field_variation_deg,
                               &pilot.around.nav.magnetic_variation_deg}) {
    *source = 0.0;
    pilot.wait();
    EXPECT_TRUE(pilot.is(databuffer::kVariationKnown)) << "0 deg is a variation";
    *source = kNaN;
    pilot.wait();
    EXPECT_FALSE(pilot.is(databuffer::kVariationKnown));
  }
}

}  // namespace
}  // namespace yars::statemachine::testing
