// An instructor changes the sequence points: selection, designated target and drawn points follow; the cursor stays.
// Source: docs/pilots_manual.md#rule-11.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "statemachine/machine.hpp"
#include "tests/statemachine/pilot.hpp"

namespace yars::statemachine::testing {
namespace {

class RouteChange : public ::testing::Test {
 protected:
  RouteChange() { pilot.press("power opr"); }

  radar::RoutePoint& point(const std::string& name) {
    return *std::ranges::find(pilot.configuration.route, name, &radar::RoutePoint::name);
  }
  // Changes the route as an instructor does, without a tick.
  template <class Change>
  void change(Change change_points) {
    const std::vector<radar::RoutePoint> before = pilot.configuration.route;
    change_points(pilot.configuration.route);
    change_route(pilot.state, before, pilot.around, pilot.configuration);
  }
  void remove(const std::string& name) {
    change([&name](auto& route) { std::erase_if(route, [&name](const auto& one) { return one.name == name; }); });
  }
  const databuffer::DrawnPoint* drawn(const std::string& name) const {
    const auto end = pilot.state.points + pilot.state.points_drawn;
    const auto found = std::find_if(pilot.state.points, end, [&name](const auto& one) { return one.name == name; });
    return found == end ? nullptr : found;
  }
  void designate(const std::string& name) {
    while (pilot.state.cursor_function != static_cast<std::uint8_t>(radar::CursorFunction::target)) pilot.press("pb 7");
    pilot.press("sp " + name);
    ASSERT_TRUE(pilot.press("tdc release"));
    ASSERT_EQ(pilot.state.target_name, name);
  }

  Pilot pilot;
  const geo::GeoPoint elsewhere = position(20.0, 16.0);
};

TEST_F(RouteChange, AMovedPointIsDrawnAtItsNewPlaceAtOnceAndTheCursorStays) {
  pilot.press("sp 2");
  const double cursor_deg = pilot.state.cursor_latitude_deg;
  change([this](auto&) { point("2").position = elsewhere; });
  ASSERT_NE(drawn("2"), nullptr);
  EXPECT_EQ(drawn("2")->latitude_deg, elsewhere.latitude_deg);
  EXPECT_EQ(drawn("2")->longitude_deg, elsewhere.longitude_deg);
  EXPECT_EQ(drawn("2")->selected, 1);
  EXPECT_STREQ(pilot.state.sequence_point, "2");
  EXPECT_EQ(pilot.state.cursor_latitude_deg, cursor_deg);
  pilot.press("sp 2");
  EXPECT_EQ(pilot.state.cursor_latitude_deg, elsewhere.latitude_deg) << "the next selection finds the new place";
}

TEST_F(RouteChange, ANewPointCanBeSelected) {
  change([this](auto& route) { route.push_back(route_point("7", radar::PointKind::steer, elsewhere)); });
  ASSERT_TRUE(pilot.press("sp 7"));
  EXPECT_STREQ(pilot.state.sequence_point, "7");
  EXPECT_EQ(pilot.state.cursor_latitude_deg, elsewhere.latitude_deg);
}

TEST_F(RouteChange, AfterTheRemovalOfTheSelectedPointThatWithTheLowestNumberIsSelected) {
  pilot.press("sp 2");
  remove("2");
  EXPECT_STREQ(pilot.state.sequence_point, "1");
  EXPECT_EQ(drawn("2"), nullptr);
  pilot.press("sp 3.");
  remove("1.1");
  EXPECT_STREQ(pilot.state.sequence_point, "3.") << "the removal of another point changes no selection";
}

TEST_F(RouteChange, WithoutAnyPointNoneIsSelectedAndTheFirstNewOneIs) {
  change([](auto& route) { route.clear(); });
  EXPECT_STREQ(pilot.state.sequence_point, "");
  EXPECT_EQ(pilot.state.points_drawn, 0);
  change([this](auto& route) { route.push_back(route_point("5", radar::PointKind::steer, elsewhere)); });
  EXPECT_STREQ(pilot.state.sequence_point, "5");
}

TEST_F(RouteChange, WithPowerOffTheSelectionFollowsToo) {
  pilot.press("power off");
  ASSERT_STREQ(pilot.state.sequence_point, "1");
  remove("1");
  pilot.press("power opr");
  EXPECT_STREQ(pilot.state.sequence_point, "1.1");
}

TEST_F(RouteChange, ATargetThatIsAPointOfTheRouteMovesWithIt) {
  designate("3.");
  change([this](auto&) {
    point("3.").position = elsewhere;
    point("3.").elevation_m = 250.0;
  });
  EXPECT_EQ(pilot.state.target_latitude_deg, elsewhere.latitude_deg);
  EXPECT_EQ(pilot.state.target_longitude_deg, elsewhere.longitude_deg);
  EXPECT_EQ(pilot.state.target_elevation_m, 250.0);
  change([this](auto&) { point("3.").elevation_m = kNaN; });
  EXPECT_EQ(pilot.state.target_elevation_m, 250.0) << "an elevation that is known at the same place stays";
  change([this](auto&) { point("3.").position = position(0.0, 20.0); });
  EXPECT_TRUE(std::isnan(pilot.state.target_elevation_m)) << "the elevation of another place says nothing";
}

TEST_F(RouteChange, ATargetStaysWhenItsPointIsRemovedOrItLiesElsewhere) {
  designate("3.");
  const double latitude_deg = pilot.state.target_latitude_deg;
  remove("3.");
  EXPECT_EQ(pilot.state.target_latitude_deg, latitude_deg);
  EXPECT_STREQ(pilot.state.sequence_point, "3.") << "the target can be selected without the route";
  change([](auto& route) { route.push_back(route_point("3.", radar::PointKind::target, position(15.0, 25.0))); });
  change([this](auto&) { point("3.").position = elsewhere; });
  EXPECT_EQ(pilot.state.target_latitude_deg, latitude_deg) << "it was not designated at this point";
}

TEST_F(RouteChange, OffsetsOfAnInitialPointAreMarked) {
  change([](auto& route) {
    route.push_back(route_point("2.1", radar::PointKind::steer_offset, position(2.0, 18.0)));
    std::erase_if(route, [](const auto& one) { return one.name == "2.01"; });
  });
  ASSERT_NE(drawn("2.1"), nullptr);
  EXPECT_EQ(drawn("2.1")->of_initial_point, 1);
  EXPECT_EQ(drawn("1.1")->of_initial_point, 0);
  EXPECT_EQ(drawn("2")->of_initial_point, 0) << "the initial point itself is none";
}

}  // namespace
}  // namespace yars::statemachine::testing
