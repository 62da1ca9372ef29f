// Tests of route files: a waypoint per line (LAT LON ALT_FT KT), a last line `loop`, and errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flightmodel/route_flight.hpp"

namespace yars::flightmodel {
namespace {

using ::testing::HasSubstr;

std::string route_refusal(const char* text) {
  const auto route = parse_route(text, "x.route");
  return route ? "accepted" : route.error().message();
}

TEST(Route, WaypointsAreReadInOrder) {
  const auto route = parse_route("# a route\n38 -123.1 15000 480\n\n37.5 -122.6 1000 250 # lower\n", "x.route");
  ASSERT_TRUE(route) << route.error().message();
  ASSERT_EQ(route->waypoints.size(), 2U);
  EXPECT_FALSE(route->loop);
  EXPECT_EQ(route->waypoints[1].point.latitude_deg, 37.5);
  EXPECT_EQ(route->waypoints[1].point.longitude_deg, -122.6);
  EXPECT_NEAR(route->waypoints[1].altitude.feet(), 1000.0, 1e-9);
  EXPECT_NEAR(route->waypoints[1].ground_speed.knots(), 250.0, 1e-9);
}

TEST(Route, AfterTheLastWaypointOfALoopComesTheFirst) {
  const auto route = parse_route("0 0 1000 300\n0 1 1000 300\n1 1 1000 300\nloop\n", "x.route");
  ASSERT_TRUE(route) << route.error().message();
  EXPECT_EQ(route->after(0), 1U);
  EXPECT_EQ(route->after(2), 0U);
}

TEST(Route, WithoutLoopNoWaypointComesAfterTheLast) {
  const auto route = parse_route("0 0 1000 300\n0 1 1000 300\n", "x.route");
  ASSERT_TRUE(route);
  EXPECT_EQ(route->after(1), 2U);
}

TEST(Route, ErrorsCarryTheLineAndWhatWasExpected) {
  EXPECT_THAT(route_refusal("0 0 1000 300\n\n95 0 1000 300\n"), HasSubstr("x.route:3: expected LAT in [-90, 90]"));
  EXPECT_THAT(route_refusal("0 0 1000\n"), HasSubstr("x.route:1: expected LAT LON ALT_FT KT, found 3 fields"));
  EXPECT_THAT(route_refusal("0 0 1000 300\n0 1 1000 10\n"), HasSubstr("x.route:2: expected KT in [30, 5000]"));
  EXPECT_THAT(route_refusal("0 0 1000 300\n0 0 2000 300\n"), HasSubstr("x.route:2"));
  EXPECT_THAT(route_refusal("0 0 1000 300\nloop\n0 1 1000 300\n"),
              HasSubstr("x.route:3: expected nothing behind loop"));
  EXPECT_THAT(route_refusal("0 0 1000 300\n"), HasSubstr("at least two waypoints"));
  EXPECT_THAT(route_refusal(""), HasSubstr("at least two waypoints"));
  EXPECT_THAT(route_refusal("0 0 1000 300\n0 1 1000 300\n0 0 1000 300\nloop"), HasSubstr("adds the leg to the first"));
}

}  // namespace
}  // namespace yars::flightmodel
