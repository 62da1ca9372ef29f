// Projection of ground positions and stored sweeps to display units, and the frame of the present picture.
#include "display/symbology/plan_view.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "databuffer/messages/derived_values.hpp"
#include "tests/display/symbology/display_states.hpp"

namespace yars::display {
namespace {

using testing::at;
using testing::kAircraftPosition;

const PlanView kView{radar::ViewConfiguration{}};

ViewFrame frame_of(double up_deg, double range_nm) {
  return {kAircraftPosition, geo::Bearing::degrees(up_deg), range_nm * geo::kMetresPerNauticalMile};
}

TEST(PlanView, TheApexIs40UnitsAboveTheBottomAndTheRangeIs400UnitsLong) {
  EXPECT_FLOAT_EQ(kView.apex().x, 240.0F);
  EXPECT_FLOAT_EQ(kView.apex().y, 440.0F);
  EXPECT_FLOAT_EQ(kView.units_per_range(), 400.0F);
}

TEST(PlanView, AViewWiderThanHighIsCentredWithEqualScales) {
  const PlanView wide(radar::ViewConfiguration{-1.0, 1.0, 0.0, 1.0, 480});
  EXPECT_FLOAT_EQ(wide.units_per_range(), 240.0F);
  EXPECT_FLOAT_EQ(wide.apex().x, 240.0F);
  EXPECT_FLOAT_EQ(wide.apex().y, 360.0F);
}

TEST(PlanView, APointAtKnownBearingAndRangeLandsWhereTrigonometrySays) {
  for (const double range_nm : {4.7, 10.0, 20.0, 40.0, 80.0, 160.0}) {
    for (const double right_deg : {-50.0, -13.0, 0.0, 20.0, 60.0}) {
      const double up_deg = 350.0;  // so that some bearings wrap
      const double fraction = 0.8;
      const Point found = kView.at_ground(frame_of(up_deg, range_nm), at(up_deg + right_deg, fraction * range_nm));
      const double angle = right_deg * geo::kRadiansPerDegree;
      EXPECT_NEAR(found.x, 240.0 + 320.0 * std::sin(angle), 0.01) << range_nm << ' ' << right_deg;
      EXPECT_NEAR(found.y, 440.0 - 320.0 * std::cos(angle), 0.01) << range_nm << ' ' << right_deg;
    }
  }
}

TEST(PlanView, APointBeyondTheAntimeridianIsProjected) {
  const ViewFrame frame{{10.0, 179.9}, geo::Bearing::degrees(90.0), 40.0 * geo::kMetresPerNauticalMile};
  const geo::GeoPoint east =
      geo::geodesic_direct(frame.apex, geo::Bearing::degrees(90.0), geo::Length::nautical_miles(20.0));
  ASSERT_LT(east.longitude_deg, 0.0);
  EXPECT_NEAR(kView.at_ground(frame, east).x, 240.0F, 0.01F);
  EXPECT_NEAR(kView.at_ground(frame, east).y, 240.0F, 0.01F);
}

TEST(PlanView, DisplacementIsMeasuredAtTheOuterEdge) {
  const ViewFrame drawn = frame_of(0.0, 40.0);
  ViewFrame moved = drawn;
  moved.apex = at(0.0, 0.4);
  EXPECT_NEAR(displacement_units(kView, drawn, moved), 4.0, 1e-6);
  EXPECT_NEAR(displacement_units(kView, drawn, frame_of(1.0, 40.0)), 400.0 * geo::kRadiansPerDegree, 1e-6);
  EXPECT_GT(displacement_units(kView, drawn, frame_of(0.0, 80.0)), 1e9);
}

TEST(PlanView, MovementIsSplitAlongAndAcrossTheDirectionUp) {
  const ViewFrame drawn = frame_of(30.0, 40.0);
  ViewFrame moved = drawn;
  moved.apex = geo::geodesic_direct(drawn.apex, geo::Bearing::degrees(30.0), geo::Length::nautical_miles(0.4));
  moved.up = geo::geodesic_inverse(drawn.apex, moved.apex).azimuth_at_end;
  ASSERT_TRUE(movement_units(kView, drawn, moved));
  EXPECT_NEAR(movement_units(kView, drawn, moved)->along, 4.0, 1e-6);
  EXPECT_NEAR(movement_units(kView, drawn, moved)->across, 0.0, 1e-4);
  moved.apex = geo::geodesic_direct(drawn.apex, geo::Bearing::degrees(120.0), geo::Length::nautical_miles(0.4));
  moved.up = drawn.up;
  EXPECT_NEAR(movement_units(kView, drawn, moved)->along, 0.0, 1e-6);
  EXPECT_GE(movement_units(kView, drawn, moved)->across, 4.0 - 1e-6);
  moved.apex = geo::geodesic_direct(drawn.apex, geo::Bearing::degrees(210.0), geo::Length::nautical_miles(0.4));
  EXPECT_NEAR(movement_units(kView, drawn, moved)->along, -4.0, 1e-6);
  EXPECT_NEAR(movement_units(kView, drawn, frame_of(31.0, 40.0))->across, 400.0 * geo::kRadiansPerDegree, 1e-6);
  EXPECT_FALSE(movement_units(kView, drawn, frame_of(30.0, 80.0)));
}

// Far north the bearing of a straight flight changes by 7 deg in 5 NM. The picture does not turn.
TEST(PlanView, AStraightFlightNearThePoleIsNoTurn) {
  const ViewFrame drawn{{89.0, 20.0}, geo::Bearing::degrees(60.0), 40.0 * geo::kMetresPerNauticalMile};
  ViewFrame moved = drawn;
  moved.apex = geo::geodesic_direct(drawn.apex, drawn.up, geo::Length::nautical_miles(5.0));
  moved.up = geo::geodesic_inverse(drawn.apex, moved.apex).azimuth_at_end;
  EXPECT_GT(std::abs((moved.up - drawn.up).degrees()), 3.0);
  EXPECT_NEAR(movement_units(kView, drawn, moved)->along, 50.0, 1e-6);
  EXPECT_NEAR(movement_units(kView, drawn, moved)->across, 0.0, 1e-6);
}

databuffer::Sweep sweep_at(geo::GeoPoint apex, double left_deg, double right_deg) {
  databuffer::Sweep sweep{};
  sweep.apex_latitude_deg = apex.latitude_deg;
  sweep.apex_longitude_deg = apex.longitude_deg;
  sweep.azimuth_left_deg = left_deg;
  sweep.azimuth_right_deg = right_deg;
  sweep.ground_track_deg = 77.0;
  sweep.range_m = 40.0 * geo::kMetresPerNauticalMile;
  sweep.samples = 10;
  return sweep;
}

TEST(Wedges, ASweepLiesAtItsOwnApexAndItsOwnTrueAzimuth) {
  PolarStore store;
  store.insert(sweep_at(at(30.0, -2.0), 20.0, 21.0));
  std::vector<Wedge> wedges;
  place_wedges(store, kView, frame_of(30.0, 40.0), wedges);
  ASSERT_EQ(wedges.size(), 1U);
  // The sweep's apex is 2 NM behind the aircraft along the track: 20 units below the present apex.
  EXPECT_NEAR(wedges[0].apex.x, 240.0F, 0.01F);
  EXPECT_NEAR(wedges[0].apex.y, 460.0F, 0.01F);
  EXPECT_NEAR(wedges[0].range, 400.0F, 0.01F);
  EXPECT_NEAR(wedges[0].left.x, std::sin(-10.0 * geo::kRadiansPerDegree), 1e-3);
  EXPECT_NEAR(wedges[0].left.y, -std::cos(-10.0 * geo::kRadiansPerDegree), 1e-3);
  EXPECT_NEAR(wedges[0].right.x, std::sin(-9.0 * geo::kRadiansPerDegree), 1e-3);
  EXPECT_NEAR(wedges[0].half_width, 0.5 * geo::kRadiansPerDegree, 1e-6);
}

TEST(Wedges, ASweepOfAnotherRangeIsScaledToThePresentRange) {
  PolarStore store;
  store.insert(sweep_at(kAircraftPosition, 20.0, 21.0));
  std::vector<Wedge> wedges;
  place_wedges(store, kView, frame_of(30.0, 80.0), wedges);
  EXPECT_NEAR(wedges.at(0).range, 200.0F, 0.01F);
}

TEST(Wedges, ASweepOfALongerRangeEndsAtThePresentRange) {
  PolarStore store;
  store.insert(sweep_at(kAircraftPosition, 20.0, 21.0));
  std::vector<Wedge> wedges;
  place_wedges(store, kView, frame_of(30.0, 20.0), wedges);
  EXPECT_NEAR(wedges.at(0).range, 400.0F, 0.01F) << "the outer arc";
  EXPECT_EQ(wedges[0].samples, 5) << "the nearer half, at its own distance";
  place_wedges(store, kView, frame_of(30.0, 40.0), wedges);
  EXPECT_EQ(wedges.at(0).samples, 10) << "and is whole again at its own range";
  // 4 NM behind the aircraft: the outer arc of 20 NM is 24 NM away.
  PolarStore behind;
  databuffer::Sweep sweep = sweep_at(at(30.0, -4.0), 29.5, 30.5);
  sweep.samples = 400;
  behind.insert(sweep);
  place_wedges(behind, kView, frame_of(30.0, 20.0), wedges);
  EXPECT_EQ(wedges.at(0).samples, 240);
  EXPECT_NEAR(wedges[0].apex.y - wedges[0].range, 40.0F, 0.1F);
  // Nothing of a sweep that points away from the picture is within the arc.
  PolarStore away;
  away.insert(sweep_at(at(30.0, -21.0), 209.5, 210.5));
  place_wedges(away, kView, frame_of(30.0, 20.0), wedges);
  EXPECT_TRUE(wedges.empty());
}

TEST(Wedges, TheyAreDrawnOldestFirstAtAnyAzimuth) {
  PolarStore store;
  for (const double left_deg : {30.0, 20.0, 40.0, 25.0})
    store.insert(sweep_at(kAircraftPosition, left_deg, left_deg + 1.0));
  std::vector<Wedge> wedges;
  place_wedges(store, kView, frame_of(30.0, 40.0), wedges);
  ASSERT_EQ(wedges.size(), 4U);
  for (std::size_t i = 1; i < wedges.size(); ++i) EXPECT_LT(wedges[i - 1].serial, wedges[i].serial);
}

TEST(PresentFrame, TheGroundTrackIsUpNotTheHeading) {
  const DisplayInput input = testing::operating(radar::Mode::rbm, 40.0);
  const ViewFrame frame = present_frame(input, nullptr);
  EXPECT_NEAR(frame.up.degrees(), 30.0, 1e-9);
  EXPECT_DOUBLE_EQ(frame.range_m, 74080.0);
}

TEST(PresentFrame, WhileTheModelIsFrozenItIsTheFrameOfTheLastSweep) {
  DisplayInput input = testing::operating(radar::Mode::rbm, 40.0);
  PolarStore store;
  const geo::GeoPoint behind = at(30.0, -5.0);
  store.insert(sweep_at(behind, 20.0, 21.0));
  EXPECT_NEAR(present_frame(input, store.newest()).up.degrees(), 30.0, 1e-9) << "the model is not frozen yet";
  input.model.flags = databuffer::kModelFrozen;
  EXPECT_DOUBLE_EQ(present_frame(input, store.newest()).up.degrees(), 77.0);
  EXPECT_DOUBLE_EQ(present_frame(input, store.newest()).apex.latitude_deg, behind.latitude_deg);
}

TEST(PresentFrame, SymbolsAreDisplacedFromTheVideoByTheErrorOfTheSelectedNavigator) {
  DisplayInput input = testing::operating(radar::Mode::rbm, 40.0);
  const geo::GeoPoint position = at(30.0, 20.0);
  const geo::GeoPoint ins_position = at(120.0, 1.0);  // 1 NM to the right of the true position
  input.nav.ins_latitude_deg = ins_position.latitude_deg;
  input.nav.ins_longitude_deg = ins_position.longitude_deg;
  const ViewFrame frame = present_frame(input, nullptr);
  const Point by_mission = kView.at_ground(
      frame, databuffer::selected_navigator_position(input.ownship, input.nav, input.state).on_video(position));
  input.state.navigator = static_cast<std::uint8_t>(radar::Navigator::ins);
  const Point by_ins = kView.at_ground(
      frame, databuffer::selected_navigator_position(input.ownship, input.nav, input.state).on_video(position));
  EXPECT_NEAR(by_mission.x, 240.0F, 0.01F);
  EXPECT_NEAR(by_ins.x, 230.0F, 0.05F);
  EXPECT_NEAR(by_ins.y, 240.0F, 0.05F);
}

}  // namespace
}  // namespace yars::display
