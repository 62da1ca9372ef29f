// CUE, TGT and MARK have the elevation of the designated ground, even if the cursor moves on at once. The model answers
// requests for elevations one tick later.
#include <gtest/gtest.h>

#include "statemachine/designation.hpp"
#include "statemachine/machine.hpp"
#include "tests/statemachine/pilot.hpp"

namespace yars::statemachine::testing {
namespace {

class Elevations : public ::testing::Test {
 protected:
  Elevations() { pilot.press("power opr"); }
  void select_function(radar::CursorFunction function) {
    while (pilot.state.cursor_function != static_cast<std::uint8_t>(function)) pilot.press("pb 7");
  }
  Pilot pilot;
};

// Ground that rises by 1,000 m per degree of latitude, so that each route point has a different elevation.
double slope(geo::GeoPoint where) {
  return 1000.0 * (where.latitude_deg - 35.0);
}

// Does what the program state-machine does: delays an event, tick by tick, while waits_for_elevation() is true.
void send_in_turn(Pilot& pilot, const std::string& text) {
  const auto event = databuffer::event_from_text(text);
  ASSERT_TRUE(event);
  for (int tick = 0; tick < 5 && waits_for_elevation(pilot.state, *event, pilot.around); ++tick) pilot.wait();
  ASSERT_FALSE(waits_for_elevation(pilot.state, *event, pilot.around));
  pilot.send(text);
}

TEST_F(Elevations, AMarkHasTheElevationOfItsGroundThoughTheCursorJumpsAtOnce) {
  pilot.ground = slope;
  select_function(radar::CursorFunction::mark);
  pilot.wait(3);
  for (const char* point : {"sp 1", "sp 3.", "sp 2", "sp 1.1", "sp 2.01"}) {
    send_in_turn(pilot, point);
    send_in_turn(pilot, "tdc release");
  }
  pilot.send("sp 1");
  pilot.wait(5);
  ASSERT_EQ(outputs_of(pilot.state, pilot.around).mark_count, 5);
  for (int i = 0; i < 5; ++i)
    EXPECT_DOUBLE_EQ(outputs_of(pilot.state, pilot.around).marks[i].elevation_m,
                     slope({outputs_of(pilot.state, pilot.around).marks[i].latitude_deg,
                            outputs_of(pilot.state, pilot.around).marks[i].longitude_deg}))
        << i;
}

TEST_F(Elevations, AMarkMadeWhileSlewingHasTheElevationOfItsPosition) {
  pilot.ground = slope;
  select_function(radar::CursorFunction::mark);
  pilot.wait(3);
  pilot.send("tdc 0.3 1");
  for (int i = 0; i < 6; ++i) {
    pilot.wait(7);
    const double latitude_deg = pilot.state.cursor_latitude_deg;
    ASSERT_TRUE(pilot.send("tdc release"));
    pilot.wait(4);
    EXPECT_NEAR(outputs_of(pilot.state, pilot.around).marks[i].elevation_m, slope({latitude_deg, 0.0}), 1e-9) << i;
    EXPECT_NE(pilot.state.cursor_latitude_deg, latitude_deg);
  }
}

TEST_F(Elevations, TheElevationOfAnotherPositionIsNeverUsed) {
  pilot.ground = slope;
  select_function(radar::CursorFunction::cue);
  pilot.wait(3);
  pilot.send("sp 3.");
  pilot.send("tdc release");
  EXPECT_TRUE(std::isnan(outputs_of(pilot.state, pilot.around).cue_elevation_m)) << "the model has not answered yet";
  // A second designation before the answer replaces the request. The first mark has no elevation, not a wrong one.
  select_function(radar::CursorFunction::mark);
  pilot.send("sp 1");
  pilot.send("tdc release");
  pilot.send("sp 2");
  pilot.send("tdc release");
  pilot.wait(5);
  EXPECT_TRUE(std::isnan(outputs_of(pilot.state, pilot.around).marks[0].elevation_m));
  EXPECT_DOUBLE_EQ(outputs_of(pilot.state, pilot.around).marks[1].elevation_m,
                   slope({outputs_of(pilot.state, pilot.around).marks[1].latitude_deg, 0.0}));
  EXPECT_NEAR(outputs_of(pilot.state, pilot.around).cue_elevation_m, slope(pilot.configuration.route[4].position),
              1e-6);
}

TEST_F(Elevations, AfterAJumpInTheSameTickATargetHasNoRangingUntilItsElevationIsKnown) {
  pilot.ground = slope;
  select_function(radar::CursorFunction::target);
  pilot.wait(3);
  pilot.configuration.route[4].elevation_m = kNaN;
  pilot.send("sp 3.");
  pilot.send("tdc release");
  EXPECT_TRUE(std::isnan(outputs_of(pilot.state, pilot.around).slant_range_m));
  pilot.wait(3);
  EXPECT_NEAR(outputs_of(pilot.state, pilot.around).target_elevation_m, slope(pilot.configuration.route[4].position),
              1e-6);
  EXPECT_NEAR(outputs_of(pilot.state, pilot.around).cue_elevation_m,
              outputs_of(pilot.state, pilot.around).target_elevation_m, 1e-9);
  EXPECT_GT(outputs_of(pilot.state, pilot.around).slant_range_m, 0.0);
}

TEST_F(Elevations, UnknownGroundLeavesTheElevationUnknownAndDelaysEventsForAtMost20Ticks) {
  pilot.ground = [](geo::GeoPoint where) { return where.latitude_deg > 36.3 ? kNaN : slope(where); };
  select_function(radar::CursorFunction::mark);
  pilot.press("sp 3.");
  ASSERT_TRUE(pilot.press("tdc release"));
  pilot.press("sp 1");
  const auto release = databuffer::event_from_text("tdc release");
  EXPECT_TRUE(waits_for_elevation(pilot.state, *release, pilot.around));
  pilot.wait(20);
  EXPECT_FALSE(waits_for_elevation(pilot.state, *release, pilot.around));
  pilot.wait(400);
  EXPECT_TRUE(std::isnan(outputs_of(pilot.state, pilot.around).marks[0].elevation_m));
  EXPECT_NEAR(pilot.state.cursor_elevation_m, slope({pilot.state.cursor_latitude_deg, 0.0}), 1e-9)
      << "the elevation under the cursor is requested again";
}

TEST_F(Elevations, AMarkGetsItsElevationThoughANewMarkHasShiftedItInTheList) {
  pilot.ground = slope;
  select_function(radar::CursorFunction::mark);
  pilot.wait(3);
  for (int n = 0; n < 9; ++n) ASSERT_TRUE(pilot.press("tdc release"));
  pilot.send("sp 3.");
  pilot.send("tdc release");
  pilot.send("tdc release");
  pilot.wait(4);
  for (int i = 8; i < 10; ++i) {
    EXPECT_NEAR(outputs_of(pilot.state, pilot.around).marks[i].latitude_deg,
                pilot.configuration.route[4].position.latitude_deg, 1e-9);
    EXPECT_NEAR(outputs_of(pilot.state, pilot.around).marks[i].elevation_m,
                slope(pilot.configuration.route[4].position), 1e-6);
  }
  EXPECT_NEAR(outputs_of(pilot.state, pilot.around).marks[7].elevation_m,
              slope({outputs_of(pilot.state, pilot.around).marks[7].latitude_deg, 0.0}), 1e-9);
}

}  // namespace
}  // namespace yars::statemachine::testing
