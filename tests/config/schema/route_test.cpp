// Tests of the GUF forms of routes: positions, kinds of points, number of points.
#include <gmock/gmock.h>

#include "tests/config/support.hpp"

namespace yars::config {
namespace {

using ::testing::DoubleEq;
using ::testing::HasSubstr;
using testing::loaded;
using testing::refusal;

TEST(LatLong, IsDegreesMinutesAndSecondsWithAHemisphere) {
  const auto route =
      loaded("( Route `( ( Point \"1\" ( lat-long N 35 44 51 ) ( lat-long west 121 30 2 ) ) ) )").radar.route;
  ASSERT_EQ(route.size(), 1U);
  EXPECT_THAT(route[0].position.latitude_deg, DoubleEq(35.0 + 44.0 / 60.0 + 51.0 / 3600.0));
  EXPECT_THAT(route[0].position.longitude_deg, DoubleEq(-(121.0 + 30.0 / 60.0 + 2.0 / 3600.0)));
}

TEST(LatLong, OfTheWrongHemisphereOrBeyondThePoleIsRefused) {
  EXPECT_EQ(refusal("( Database ( lat-long E 35 ) )"), "text.guf:1:12: expected N or S for a latitude, found E or W");
  EXPECT_THAT(refusal("( Database ( lat-long N 90 1 ) )"), HasSubstr("[-90, 90] deg for :latitude"));
}

TEST(Route, TakesTheKindOfAPointFromItsName) {
  const auto route = loaded(R"(( Route `(
    ( Point "1" 36 -122 500 ) ( Point "2" 36.1 -122 :kind initial ) ( Point "3." 36.2 -122 )
    ( Point "3.01" 36.2 -122.1 ) ( Point "1.1" 36 -122.1 ) ) ))")
                         .radar.route;
  ASSERT_EQ(route.size(), 5U);
  EXPECT_EQ(route[0].kind, radar::PointKind::steer);
  EXPECT_DOUBLE_EQ(route[0].elevation_m, 152.4);
  EXPECT_EQ(route[1].kind, radar::PointKind::initial);
  EXPECT_TRUE(std::isnan(route[1].elevation_m));
  EXPECT_EQ(route[2].kind, radar::PointKind::target);
  EXPECT_EQ(route[3].kind, radar::PointKind::target_offset);
  EXPECT_EQ(route[4].kind, radar::PointKind::steer_offset);
}

TEST(Route, RefusesPointsThatAreInvalidIncompleteOrRepeated) {
  EXPECT_THAT(refusal("( Route `( ( Point \"x\" 1 2 ) ) )"), HasSubstr("expected a name of a sequence point"));
  EXPECT_THAT(refusal("( Route `( ( Point \"1\" 1 2 :kind target ) ) )"),
              HasSubstr("text.guf:1:34: expected the kind that the name 1 has, steer for :kind, found target"));
  EXPECT_THAT(refusal("( Route `( ( Point \"1\" 1 2 ) ( Point \"1\" 3 4 ) ) )"),
              HasSubstr("a name that is not yet in the route"));
  EXPECT_THAT(refusal("( Route `( ( Point \"1\" 1 ) ) )"),
              HasSubstr("expected a longitude for :longitude, found none"));
}

TEST(Route, ASecondRouteReplacesTheFirst) {
  const auto route = loaded("( Route `( ( Point \"1\" 1 2 ) ) )( Route `( ( Point \"7\" 3 4 ) ) )").radar.route;
  ASSERT_EQ(route.size(), 1U);
  EXPECT_EQ(route[0].name, "7");
}

TEST(Route, MakesTheLastSteerPointBeforeATargetTheInitialPoint) {
  const auto kind_of = [](const std::vector<radar::RoutePoint>& route, const std::string& name) {
    for (const auto& point : route) {
      if (point.name == name) return point.kind;
    }
    return radar::PointKind::target_offset;
  };
  // The points are flown by ascending number, whatever their order in the file.
  const auto route = loaded(R"(( Route `( ( Point "4." 1 1 ) ( Point "2" 1 2 ) ( Point "3" 1 3 ) ( Point "3.1" 1 3 )
                                          ( Point "5." 1 4 ) ( Point "6" 1 5 ) ) ))")
                         .radar.route;
  EXPECT_EQ(kind_of(route, "2"), radar::PointKind::steer);
  EXPECT_EQ(kind_of(route, "3"), radar::PointKind::initial);
  EXPECT_EQ(kind_of(route, "3.1"), radar::PointKind::steer_offset);
  EXPECT_EQ(kind_of(route, "6"), radar::PointKind::steer);
  EXPECT_EQ(route.front().name, "4.") << "the order of the file is kept";
}

TEST(Route, KeepsTheKindThatTheFileGivesToASteerPoint) {
  const auto with_steer =
      loaded(R"(( Route `( ( Point "1" 1 1 ) ( Point "2" 1 2 :kind steer ) ( Point "3." 1 3 ) ) ))");
  EXPECT_EQ(with_steer.radar.route[0].kind, radar::PointKind::steer);
  EXPECT_EQ(with_steer.radar.route[1].kind, radar::PointKind::steer);
  const auto with_initial = loaded(R"(( Route `( ( Point "1" 1 1 :kind initial ) ( Point "2" 1 2 ) ( Point "3." 1 3 )
                                          ( Point "4" 1 1 ) ( Point "5." 1 3 ) ) ))");
  EXPECT_EQ(with_initial.radar.route[0].kind, radar::PointKind::initial);
  EXPECT_EQ(with_initial.radar.route[1].kind, radar::PointKind::steer);
  EXPECT_EQ(with_initial.radar.route[3].kind, radar::PointKind::initial)
      << "each target has an initial point of its own";
}

TEST(Route, HasAtMostAHundredPointsAndOneForEachNumber) {
  std::string points;
  for (int number = 1; number <= 100; ++number) {
    const std::string name = std::to_string(number);
    points += "( Point \"" + name + "\" 1 2 ) ( Point \"" + name + ".1\" 1 2 )";
  }
  EXPECT_EQ(loaded("( Route `( " + points + " ) )").radar.route.size(), 200U) << "offsets do not count";
  EXPECT_THAT(refusal("( Route `( " + points + " ( Point \"101\" 1 2 ) ) )"), HasSubstr("number 1 to 100"));
  for (int offset = 11; offset <= 66; ++offset) points += "( Point \"7." + std::to_string(offset) + "\" 1 2 )";
  EXPECT_EQ(loaded("( Route `( " + points + " ) )").radar.route.size(), 256U);
  EXPECT_THAT(refusal("( Route `( " + points + " ( Point \"8.11\" 1 2 ) ) )"),
              HasSubstr("at most 256 points in a route"));
  EXPECT_THAT(
      refusal("( Route `( ( Point \"2\" 1 2 ) ( Point \"2.\" 1 2 ) ) )"),
      HasSubstr("expected a number that no other steer point or target has for :name, found \"2.\" beside \"2\""));
}

}  // namespace
}  // namespace yars::config
