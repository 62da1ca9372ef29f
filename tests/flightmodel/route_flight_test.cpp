// Tests of RouteFlight (`--source route:FILE`): flight along the geodesics between waypoints, with coordinated turns.
#include "flightmodel/route_flight.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "lib/file/text_file.hpp"
#include "tests/flightmodel/flight_checks.hpp"

namespace yars::flightmodel {
namespace {

constexpr double kStep = 0.02;  // [s]

Route route_of(const std::string& text) {
  return parse_route(text, "test").value();
}

// Route of two legs of 60 km; the second is turned by turn_deg, to the right.
Route corner_of(double turn_deg, double knots) {
  const geo::GeoPoint start{38.0, -123.0};
  const auto length = geo::Length::metres(60e3);
  const geo::GeodesicRay out(start, geo::Bearing::degrees(30.0));
  const auto corner = out.position_and_azimuth(length);
  const auto end = geo::geodesic_direct(corner.point, corner.azimuth + geo::Angle::degrees(turn_deg), length);
  const auto altitude = geo::AltitudeMsl::feet(15'000);
  Route route;
  for (const geo::GeoPoint point : {start, corner.point, end})
    route.waypoints.push_back({point, altitude, geo::Speed::knots(knots)});
  return route;
}

struct TurnMeasures {
  double largest_roll_deg = 0.0;
  double largest_roll_rate_dps = 0.0;
  double overshoot_m = 0.0;         // maximum distance from the second leg, on the outer side of the turn
  double heading_change_deg = 0.0;  // sum, right positive
  double cut_m = 1e9;               // least distance from the corner
};

// Flies the route of corner_of() and measures the turn.
TurnMeasures fly_corner(double turn_deg, double knots) {
  const Route route = corner_of(turn_deg, knots);
  const Leg second(route.waypoints[1].point, route.waypoints[2].point);
  RouteFlight flight(route);
  databuffer::Ownship before = flight.step({}).ownship;
  TurnMeasures turn;
  geo::Length near;
  const double duration_s = 115e3 / geo::Speed::knots(knots).metres_per_second();
  for (double time_s = 0.0; time_s < duration_s; time_s += kStep) {
    const databuffer::Ownship now = flight.step(geo::Duration::seconds(kStep)).ownship;
    turn.largest_roll_deg = std::max(turn.largest_roll_deg, std::abs(now.roll_deg));
    turn.largest_roll_rate_dps = std::max(turn.largest_roll_rate_dps, std::abs(now.roll_deg - before.roll_deg) / kStep);
    turn.heading_change_deg += geo::wrapped_degrees(now.heading_deg - before.heading_deg);
    turn.cut_m = std::min(turn.cut_m, distance_m(point_of(now), route.waypoints[1].point));
    const auto fix = second.fix(point_of(now), near);
    near = fix.along;
    if (fix.along.metres() > 0.0)
      turn.overshoot_m = std::max(turn.overshoot_m, std::copysign(1.0, -turn_deg) * fix.across.metres());
    before = now;
  }
  const auto last = second.fix(point_of(before), near);
  EXPECT_LT(std::abs(last.across.metres()), 1.0) << "off the second leg at the end";
  return turn;
}

TEST(RouteFlight, StartsAtTheFirstWaypointTowardsTheSecond) {
  RouteFlight flight(corner_of(60.0, 480.0));
  const databuffer::Ownship ownship = flight.step({}).ownship;
  EXPECT_NEAR(ownship.latitude_deg, 38.0, 1e-12);
  EXPECT_NEAR(ownship.longitude_deg, -123.0, 1e-12);
  EXPECT_NEAR(ownship.heading_deg, 30.0, 1e-9);
  EXPECT_NEAR(ground_speed_of(ownship), 480.0 * 1852.0 / 3600.0, 1e-9);
  EXPECT_STREQ(ownship.source, "route");
}

TEST(RouteFlight, FollowsTheGeodesicOfALeg) {
  const Route route = route_of("40 -120 30000 480\n50 -80 30000 480\n");
  const Leg leg(route.waypoints[0].point, route.waypoints[1].point);
  RouteFlight flight(route);
  double worst_m = 0.0;
  geo::Length near;
  for (int second = 0; second < 7'200; ++second) {
    const auto fix = leg.fix(point_of(flight.step(geo::Duration::seconds(1.0)).ownship), near);
    near = fix.along;
    worst_m = std::max(worst_m, std::abs(fix.across.metres()));
  }
  EXPECT_LT(worst_m, 0.1);
  EXPECT_NEAR(near.metres(), 7'200.0 * 480.0 * 1852.0 / 3600.0 * 6'371e3 / (6'371e3 + 9'144.0), 500.0);
}

// After a clock that went ahead by years, the step has an end.
TEST(RouteFlight, AStepFliesTenMinutesAtMost) {
  RouteFlight minutes(corner_of(60.0, 480.0));
  RouteFlight years(corner_of(60.0, 480.0));
  const databuffer::Ownship expected = minutes.step(RouteFlight::kMaxFlown).ownship;
  const databuffer::Ownship found = years.step(geo::Duration::seconds(1e9)).ownship;
  EXPECT_EQ(found.latitude_deg, expected.latitude_deg);
  EXPECT_EQ(found.longitude_deg, expected.longitude_deg);
}

TEST(RouteFlight, ATurnIsCoordinatedAndRollsOutOnTheNextLeg) {
  for (const double turn_deg : {-90.0, -45.0, 10.0, 30.0, 60.0, 90.0, 120.0}) {
    SCOPED_TRACE("turn " + std::to_string(turn_deg));
    const TurnMeasures turn = fly_corner(turn_deg, 480.0);
    EXPECT_LE(turn.largest_roll_deg, 30.0 + 1e-9);
    EXPECT_LE(turn.largest_roll_rate_dps, 15.0 + 1e-6);
    EXPECT_LT(turn.overshoot_m, 100.0);
    // The convergence of the meridians changes the heading by less than 2 deg.
    EXPECT_NEAR(turn.heading_change_deg, turn_deg, 5.0);
  }
}

TEST(RouteFlight, TheTurnCutsTheCornerByTheGeometryOfItsCircle) {
  // Turns are planned with 27 deg of bank. At 480 kt the radius is R = V^2 / (g tan(27 deg)) = 12.2 km. So the aircraft
  // misses the corner of a turn of 90 deg by (sqrt 2 - 1) R = 5.05 km.
  EXPECT_NEAR(fly_corner(90.0, 480.0).cut_m, 5'055.0, 450.0);
  EXPECT_NEAR(fly_corner(90.0, 240.0).cut_m, 5'055.0 / 4.0, 150.0);
}

TEST(RouteFlight, AReversalEndsOnTheSecondLeg) {
  const TurnMeasures turn = fly_corner(180.0, 300.0);
  EXPECT_NEAR(std::abs(turn.heading_change_deg), 180.0, 5.0);
}

TEST(RouteFlight, TurnRateIsThatOfACoordinatedTurn) {
  RouteFlight flight(corner_of(90.0, 480.0));
  databuffer::Ownship before = flight.step({}).ownship;
  int checked = 0;
  for (double time_s = 0.0; time_s < 450.0; time_s += kStep) {
    const databuffer::Ownship now = flight.step(geo::Duration::seconds(kStep)).ownship;
    if (std::abs(now.roll_deg) > 29.999 && before.roll_deg == now.roll_deg) {
      const double rate_dps = geo::wrapped_degrees(now.heading_deg - before.heading_deg) / kStep;
      const double expected_dps =
          9.80665 * std::tan(now.roll_deg * geo::kRadiansPerDegree) / ground_speed_of(now) / geo::kRadiansPerDegree;
      // The convergence of the meridians adds at most V tan(latitude) / R = 0.002 deg/s, V speed, R earth radius.
      ASSERT_NEAR(rate_dps, expected_dps, 0.003);
      ++checked;
    }
    before = now;
  }
  EXPECT_GT(checked, 1'000);
}

TEST(RouteFlight, VelocityIsTheDerivativeOfPositionInTurnsAndClimbs) {
  RouteFlight flight(
      route_of("38 -123 15000 480\n38.5 -123 20000 350\n38.5 -122 5000 600\n38 -122.5 15000 480\nloop\n"));
  expect_consistent(flight, 2'400.0, kStep, 0.05);
}

TEST(RouteFlight, ClimbsWithinItsLimitsAndLevelsOff) {
  RouteFlight flight(route_of("38 -123 5000 400\n40 -123 15000 400\n41 -123 15000 400\n"));
  double steepest_mps = 0.0;
  double highest_m = 0.0;
  double pitch_error_deg = 0.0;
  databuffer::Ownship now{};
  for (double time_s = 0.0; time_s < 600.0; time_s += kStep) {
    now = flight.step(geo::Duration::seconds(kStep)).ownship;
    steepest_mps = std::max(steepest_mps, -now.velocity_down_mps);
    highest_m = std::max(highest_m, now.altitude_msl_m);
    const double path_deg = std::atan2(-now.velocity_down_mps, ground_speed_of(now)) / geo::kRadiansPerDegree;
    pitch_error_deg = std::max(pitch_error_deg, std::abs(path_deg - now.pitch_deg));
  }
  EXPECT_NEAR(steepest_mps, 20.0, 1e-6);
  EXPECT_LT(highest_m, 4572.0 + 1.0);
  EXPECT_NEAR(now.altitude_msl_m, 4572.0, 1.0);
  EXPECT_LT(pitch_error_deg, 1e-9);
}

TEST(RouteFlight, AfterTheLastWaypointContinuesStraight) {
  const Route route = route_of("38 -123 15000 480\n38.2 -123 15000 480\n");
  RouteFlight flight(route);
  databuffer::Ownship now{};
  for (int second = 0; second < 1'000; ++second) now = flight.step(geo::Duration::seconds(1.0)).ownship;
  EXPECT_GT(now.latitude_deg, 39.0);
  EXPECT_NEAR(now.longitude_deg, -123.0, 1e-6);
  EXPECT_NEAR(geo::wrapped_degrees(now.heading_deg), 0.0, 1e-6);
}

TEST(RouteFlight, ALoopIsFlownRepeatedly) {
  const Route route = route_of("38 -123 15000 480\n39 -123 15000 480\n39 -122 15000 480\n38 -122 15000 480\nloop\n");
  RouteFlight flight(route);
  std::vector<int> passes(4, 0);
  std::vector<bool> inside(4, false);
  for (int second = 0; second < 7'200; ++second) {
    const databuffer::Ownship now = flight.step(geo::Duration::seconds(1.0)).ownship;
    for (std::size_t index = 0; index < 4; ++index) {
      const bool near_waypoint = distance_m(point_of(now), route.waypoints[index].point) < 8'000.0;
      if (near_waypoint && !inside[index]) ++passes[index];
      inside[index] = near_waypoint;
    }
  }
  for (const int count : passes) EXPECT_GE(count, 4);
}

TEST(RouteFlight, CrossesThePoleAndTheAntimeridian) {
  RouteFlight pole(route_of("89 20 30000 480\n89 -160 30000 480\n88 -160 30000 480\n"));
  expect_consistent(pole, 1'200.0, kStep, 0.05);
  RouteFlight line(route_of("0 179.5 30000 480\n0 -179.5 30000 480\n0.5 -179 30000 480\n"));
  expect_consistent(line, 900.0, kStep, 0.05);
}

TEST(RouteFlight, AfterRepositioningFliesToTheEndOfTheNearestLeg) {
  const Route route = route_of("38 -123 15000 480\n39 -123 15000 480\n39 -120 15000 480\n");
  RouteFlight flight(route);
  flight.step(geo::Duration::seconds(10.0));
  ASSERT_TRUE(flight.reposition({{39.3, -121.5}, geo::AltitudeMsl::feet(10'000), geo::Bearing::degrees(270)}));
  const databuffer::Ownship placed = flight.step({}).ownship;
  EXPECT_EQ(placed.latitude_deg, 39.3);
  EXPECT_EQ(placed.longitude_deg, -121.5);
  EXPECT_NEAR(placed.heading_deg, 270.0, 1e-9);
  EXPECT_EQ(placed.roll_deg, 0.0);
  double nearest_m = 1e9;
  for (int second = 0; second < 900; ++second)
    nearest_m = std::min(nearest_m, distance_m(point_of(flight.step(geo::Duration::seconds(1.0)).ownship), {39, -120}));
  EXPECT_LT(nearest_m, 500.0);
}

TEST(RouteFlight, AfterRepositioningWithASpeedFliesStraightAndLevelUntilTheNextOne) {
  const Route route = route_of("38 -123 15000 480\n39 -123 15000 480\n39 -120 15000 480\n");
  RouteFlight flight(route);
  const geo::GeoPoint start{39.3, -121.5};
  flight.reposition({start, geo::AltitudeMsl::feet(10'000), geo::Bearing::degrees(270), geo::Speed::knots(300)});
  databuffer::Ownship last{};
  for (int second = 0; second < 600; ++second) last = flight.step(geo::Duration::seconds(1.0)).ownship;
  const auto there = geo::geodesic_direct(start, geo::Bearing::degrees(270),
                                          geo::Length::metres(geo::Speed::knots(300).metres_per_second() * 600.0));
  EXPECT_LT(distance_m(point_of(last), there), 60.0) << "30 m less on the ellipsoid than at the altitude";
  EXPECT_NEAR(ground_speed_of(last), geo::Speed::knots(300).metres_per_second(), 1e-9);
  EXPECT_NEAR(last.altitude_msl_m, 3048.0, 1e-6);
  EXPECT_EQ(last.roll_deg, 0.0);
  flight.reposition({start, geo::AltitudeMsl::feet(10'000), geo::Bearing::degrees(270)});
  for (int second = 0; second < 60; ++second) last = flight.step(geo::Duration::seconds(1.0)).ownship;
  EXPECT_LT(last.heading_deg, 200.0) << "it has turned to the route";
  flight.reposition({start, geo::AltitudeMsl::feet(10'000), geo::Bearing::degrees(270), geo::Speed::knots(300)});
  flight.reset();
  EXPECT_EQ(flight.step({}).ownship.latitude_deg, 38.0);
  EXPECT_GT(flight.step(geo::Duration::seconds(60.0)).ownship.latitude_deg, 38.1);
}

// The looped route that comes with YARS, with a descent, changes of speed and turns.
TEST(RouteFlight, AFlightThatIsResumedGoesOnAsIfItHadNotEnded) {
  const auto text = file::read_text_file(std::string(YARS_SOURCE_DIR) + "/config/routes/default.route");
  for (const Route& route : {corner_of(90.0, 480.0), corner_of(-150.0, 480.0), route_of(*text)}) {
    RouteFlight flight(route);
    for (int part = 0; part < 12; ++part) {
      const databuffer::Ownship last = flight.step(geo::Duration::seconds(47.0)).ownship;
      RouteFlight resumed(route);
      ASSERT_TRUE(resumed.resume(last, geo::Duration()));
      const databuffer::Ownship first = resumed.step({}).ownship;
      EXPECT_LT(distance_m(point_of(first), point_of(last)), 1e-3);
      EXPECT_NEAR(first.roll_deg, last.roll_deg, 1e-9);
      EXPECT_NEAR(first.velocity_north_mps, last.velocity_north_mps, 1e-6);
      EXPECT_NEAR(first.velocity_down_mps, last.velocity_down_mps, 1e-9);
      RouteFlight uninterrupted = flight;
      for (int second = 0; second < 40; ++second) {
        const databuffer::Ownship expected = uninterrupted.step(geo::Duration::seconds(1.0)).ownship;
        const databuffer::Ownship found = resumed.step(geo::Duration::seconds(1.0)).ownship;
        ASSERT_LT(distance_m(point_of(found), point_of(expected)), 1.0) << "part " << part << ", " << second << " s";
      }
      // The gap is flown.
      RouteFlight later(route);
      later.resume(last, geo::Duration::seconds(10.0));
      RouteFlight after = flight;
      EXPECT_LT(
          distance_m(point_of(later.step({}).ownship), point_of(after.step(geo::Duration::seconds(10.0)).ownship)),
          1.0);
    }
  }
}

TEST(RouteFlight, AfterResetRepeatsTheSameFlight) {
  RouteFlight flight(corner_of(60.0, 480.0));
  std::vector<FlightSample> first;
  for (int second = 0; second < 400; ++second) first.push_back(flight.step(geo::Duration::seconds(1.0)));
  flight.reset();
  for (const FlightSample& sample : first) ASSERT_TRUE(same_sample(sample, flight.step(geo::Duration::seconds(1.0))));
}

TEST(RouteFlight, OneLongStepEqualsManyShortSteps) {
  RouteFlight once(corner_of(60.0, 480.0));
  RouteFlight often(corner_of(60.0, 480.0));
  const databuffer::Ownship far = once.step(geo::Duration::seconds(400.0)).ownship;
  databuffer::Ownship near{};
  for (int tick = 0; tick < 80'000; ++tick) near = often.step(geo::Duration::seconds(0.005)).ownship;
  EXPECT_LT(distance_m(point_of(far), point_of(near)), 20.0);
}

TEST(RouteFlight, TheShippedRouteGoesSouthAndReturnsToItsStart) {
  const auto text = file::read_text_file(std::string(YARS_SOURCE_DIR) + "/config/routes/california.route");
  ASSERT_TRUE(text) << text.error().message();
  const auto route = parse_route(*text, "california.route");
  ASSERT_TRUE(route) << route.error().message();
  EXPECT_TRUE(route->loop);
  RouteFlight flight(*route);
  double southernmost_deg = 90.0;
  double nearest_to_start_m = 1e9;
  for (int second = 0; second < 3'600; ++second) {
    const databuffer::Ownship now = flight.step(geo::Duration::seconds(1.0)).ownship;
    ASSERT_NEAR(now.altitude_msl_m, 4572.0, 1.0);
    ASSERT_EQ(databuffer::validate(now), std::nullopt);
    southernmost_deg = std::min(southernmost_deg, now.latitude_deg);
    if (second > 1'800)
      nearest_to_start_m = std::min(nearest_to_start_m, distance_m(point_of(now), route->waypoints[0].point));
  }
  EXPECT_LT(southernmost_deg, 35.5);
  EXPECT_LT(nearest_to_start_m, 10'000.0);
}

}  // namespace
}  // namespace yars::flightmodel
