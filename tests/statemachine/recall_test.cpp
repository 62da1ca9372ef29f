// The frozen patch map: recall of NEW, OLD and STORE, SET, and the cursor on the map.
// Source: docs/pilots_manual.md#rule-5, #rule-8, #rule-10, #rule-21.
#include <gtest/gtest.h>

#include "tests/statemachine/pilot.hpp"

namespace yars::statemachine::testing {
namespace {

using databuffer::kFreeze;
using databuffer::kSet;

class FrozenMap : public ::testing::Test {
 protected:
  // Frozen patch map; maps 2 (NEW) and 1 (OLD); range 40 NM.
  FrozenMap() { bring_into(pilot, "PATCH", true); }
  std::string field(const std::string& name) const { return fields_of(pilot).at(name); }
  // Legend of PB 10, id of the map on the display, and ids of NEW/OLD/STORE.
  std::string recall() const { return pilot.legend(10) + " " + field("shown") + " of " + field("maps"); }
  Pilot pilot;
};

TEST_F(FrozenMap, Pb10AlternatesNewAndOld) {
  EXPECT_EQ(recall(), "NEW 2 of 2/1/0");
  pilot.press("pb 10");
  EXPECT_EQ(recall(), "OLD 1 of 2/1/0");
  pilot.press("pb 10");
  EXPECT_EQ(recall(), "NEW 2 of 2/1/0");
}

TEST_F(FrozenMap, WithOnlyOneMapPb10IsDead) {
  Pilot one;
  one.press("power opr");
  one.make_map();
  one.press("freeze");
  EXPECT_EQ(one.legend(10), "NEW");
  EXPECT_FALSE(one.press("pb 10"));
}

TEST_F(FrozenMap, AStoredMapReplacesOldInTheAlternationWithNew) {
  pilot.press("pb 15");
  EXPECT_EQ(recall(), "STORE 2 of 2/1/2");
  EXPECT_TRUE(pilot.boxed(15));
  pilot.make_map();
  EXPECT_EQ(recall(), "NEW 3 of 3/2/2");
  pilot.make_map();
  EXPECT_EQ(recall(), "NEW 4 of 4/2/2") << "the stored map stays in place of OLD";
  pilot.press("pb 10");
  EXPECT_EQ(recall(), "STORE 2 of 4/2/2");
  pilot.press("pb 10");
  EXPECT_EQ(recall(), "NEW 4 of 4/2/2");
}

TEST_F(FrozenMap, TheSecondPressOfStoEndsTheProtectionOfTheMap) {
  pilot.press("pb 15");
  pilot.press("pb 15");
  EXPECT_EQ(recall(), "NEW 2 of 2/1/0");
  EXPECT_FALSE(pilot.boxed(15));
  pilot.press("pb 10");
  pilot.press("pb 15");
  EXPECT_EQ(recall(), "STORE 1 of 2/1/1");
  pilot.make_map();
  pilot.press("pb 15");
  EXPECT_EQ(recall(), "NEW 3 of 3/1/0");
}

TEST_F(FrozenMap, AfterAReMapCompletedSinceStoringEndingTheStoreMakesTheMapOld) {
  pilot.press("pb 15");
  pilot.complete_map();
  EXPECT_EQ(recall(), "STORE 2 of 3/1/2");
  pilot.press("pb 15");
  EXPECT_EQ(recall(), "OLD 2 of 3/2/0");
}

TEST_F(FrozenMap, UnfreezingShowsNewAndForgetsStore) {
  pilot.press("pb 10");
  pilot.press("pb 15");
  pilot.press("freeze");
  EXPECT_EQ(recall(), " 2 of 2/1/0");
  EXPECT_EQ(field("recall"), "-");
}

TEST_F(FrozenMap, AMapRecalledOnAFrozenPpiDisappearsWhenUnfrozen) {
  Pilot ppi;
  bring_into(ppi, "MAPS", true);
  EXPECT_EQ(ppi.legend(10), "NEW");
  EXPECT_EQ(ppi.state.map_shown, 0U);
  ppi.press("pb 10");
  ppi.press("pb 10");
  EXPECT_EQ(ppi.legend(10), "OLD");
  EXPECT_EQ(ppi.state.map_shown, 1U);
  ppi.press("freeze");
  EXPECT_EQ(ppi.state.map_shown, 0U);
  EXPECT_EQ(fields_of(ppi).at("mode"), "HRM");
}

TEST_F(FrozenMap, InSetPb7CyclesTheCursorFunctionsWithoutMap) {
  pilot.press("mode aa");
  pilot.press("pb 18");
  EXPECT_TRUE(pilot.boxed(18));
  for (const char* legend : {"UPDT", "CUE", "TGT", "MARK", "UPDT"}) {
    EXPECT_EQ(pilot.legend(7), legend);
    pilot.press("pb 7");
  }
}

TEST_F(FrozenMap, SetEndsOnlyWhenDeselected) {
  Pilot set;
  bring_into(set, "AASET", false);
  for (const char* event : {"mode agr", "mode ag", "mode aa", "pb 11", "pb 6", "mode ag"}) set.press(event);
  EXPECT_EQ(fields_of(set).at("mode"), "PATCH");
  EXPECT_TRUE(set.is(kSet));
  EXPECT_TRUE(set.is(kFreeze));
  set.press("pb 18");
  EXPECT_FALSE(set.is(kSet));
  EXPECT_FALSE(set.is(kFreeze));
  EXPECT_EQ(set.legend(18), "SNIFF");
}

TEST_F(FrozenMap, HrmLeftWithoutAMapOffersNoSet) {
  Pilot ppi;
  bring_into(ppi, "HRM", false);
  ppi.press("mode agr");
  EXPECT_EQ(ppi.legend(18), "");
  EXPECT_FALSE(ppi.is(kFreeze));
}

// Report, appendix A, "Set Function": "the last HRM map is automatically frozen".
TEST_F(FrozenMap, AnHrmPpiLeftWithAMapInMemoryOffersSetOverThatMap) {
  for (const bool frozen : {false, true}) {
    Pilot ppi;
    bring_into(ppi, "MAPS", frozen);
    const std::uint64_t newest = ppi.state.map_newest;
    EXPECT_EQ(ppi.state.map_shown, 0U);
    ppi.press("mode agr");
    EXPECT_EQ(ppi.state.map_shown, newest);
    EXPECT_TRUE(ppi.is(kFreeze));
    ASSERT_EQ(ppi.legend(18), "SET");
    Pilot back = ppi;
    back.press("mode ag");
    EXPECT_EQ(fields_of(back).at("mode"), "HRM");
    EXPECT_EQ(back.state.map_shown, 0U) << "the PPI is shown again";
    EXPECT_EQ(back.is(kFreeze), frozen) << "frozen only if the pilot had frozen it";
    ASSERT_TRUE(ppi.press("pb 18"));
    ppi.press("mode ag");
    EXPECT_EQ(ppi.state.map_shown, newest) << "SET is still on";
    ppi.press("pb 18");
    EXPECT_EQ(ppi.state.map_shown, 0U);
    EXPECT_EQ(ppi.is(kFreeze), frozen);
  }
}

TEST_F(FrozenMap, RbmLeftWithAMapInMemoryOffersNoSet) {
  Pilot rbm;
  bring_into(rbm, "MAPS", false);
  rbm.press("radar rbm");
  rbm.press("mode aa");
  EXPECT_EQ(rbm.legend(18), "");
}

TEST_F(FrozenMap, HrmInSniffIsStillFrozenAfterAReturnFromAirToAir) {
  Pilot silent;
  bring_into(silent, "PATCH", false);
  silent.press("pb 18");
  silent.press("mode aa");
  silent.press("mode ag");
  EXPECT_TRUE(silent.is(kFreeze));
  EXPECT_EQ(silent.legend(10), "NEW");
}

// Position of the cursor on the map, in fractions of the window from the map's centre. Computed independently of the
// code under test.
struct MapPosition {
  double right, up;
};
MapPosition on_map(const Pilot& pilot, const databuffer::PatchMap& map) {
  const auto inverse = geo::geodesic_inverse({map.apex_latitude_deg, map.apex_longitude_deg},
                                             {pilot.state.cursor_latitude_deg, pilot.state.cursor_longitude_deg});
  const double angle_rad = (inverse.azimuth_at_start.degrees() - map.up_deg) * geo::kRadiansPerDegree;
  const double window_m = map.window_nm * geo::kMetresPerNauticalMile;
  return {inverse.distance.metres() * std::sin(angle_rad) / window_m,
          (inverse.distance.metres() * std::cos(angle_rad) - map.distance_m) / window_m};
}

class MapCursor : public ::testing::Test {
 protected:
  // A map with a window of 4.7 NM, centred on point 2, 18 NM north. The cursor is on that point.
  MapCursor() {
    pilot.press("power opr");
    pilot.press("pb 13");
    pilot.press("sp 2");
    pilot.make_map();
    map = pilot.around.maps[0];
    pilot.wait();
  }
  Pilot pilot;
  databuffer::PatchMap map;
};

TEST_F(MapCursor, StaysOnItsGroundPointWhenTheMapAppears) {
  EXPECT_EQ(point_under_cursor(pilot), "2");
  EXPECT_NEAR(on_map(pilot, map).right, 0.0, 1e-9);
  EXPECT_NEAR(on_map(pilot, map).up, 0.0, 1e-9);
}

TEST_F(MapCursor, CrossesTheMapInTwoSecondsAtFullTdcDeflection) {
  pilot.send("tdc -1 0");
  pilot.wait(300);
  ASSERT_NEAR(on_map(pilot, map).right, -0.5, 1e-7);
  pilot.send("tdc 1 0");
  pilot.wait(399);
  EXPECT_LT(on_map(pilot, map).right, 0.5 - 0.002);
  pilot.wait(1);
  EXPECT_NEAR(on_map(pilot, map).right, 0.5, 1e-7);
  EXPECT_NEAR(on_map(pilot, map).up, 0.0, 1e-7) << "along the map's edge, not along a circle about the aircraft";
}

TEST_F(MapCursor, StopsAtEveryEdgeOfTheMap) {
  struct Edge {
    const char* event;
    double right, up;
  };
  for (const Edge& edge : {Edge{"tdc 1 1", 0.5, 0.5}, Edge{"tdc 0 -1", 0.5, -0.5}, Edge{"tdc -1 0", -0.5, -0.5}}) {
    pilot.send(edge.event);
    pilot.wait(500);
    EXPECT_NEAR(on_map(pilot, map).right, edge.right, 1e-7) << edge.event;
    EXPECT_NEAR(on_map(pilot, map).up, edge.up, 1e-7) << edge.event;
  }
}

TEST_F(MapCursor, IsSlewedInTheMapsFrameWhereverTheAircraftFlies) {
  const auto ahead = position(70.0, 6.0);
  pilot.around.ownship.latitude_deg = ahead.latitude_deg;
  pilot.around.ownship.longitude_deg = ahead.longitude_deg;
  pilot.around.ownship.velocity_east_mps = 200.0;
  pilot.send("tdc 0 1");
  pilot.wait(100);
  EXPECT_NEAR(on_map(pilot, map).right, 0.0, 1e-7);
  EXPECT_NEAR(on_map(pilot, map).up, 100 / 400.0, 1e-6);
  EXPECT_EQ(pilot.state.frame_latitude_deg, map.apex_latitude_deg);
  EXPECT_EQ(pilot.state.frame_track_deg, map.up_deg);
}

TEST_F(MapCursor, BearingAndRangeAreFromTheAircraft) {
  const auto ahead = position(0.0, 6.0);
  pilot.around.ownship.latitude_deg = ahead.latitude_deg;
  pilot.around.ownship.longitude_deg = ahead.longitude_deg;
  pilot.wait();
  EXPECT_NEAR(pilot.state.cursor_range_nm, 12.0, 1e-6);
}

TEST_F(MapCursor, GoesToTheCentreOfTheMapInANewEpoch) {
  pilot.configuration.route.clear();
  pilot.press("tdc 1 0");
  pilot.press("tdc 0 0");
  ++pilot.around.epoch;
  pilot.wait();
  EXPECT_NEAR(on_map(pilot, map).right, 0.0, 1e-7);
  EXPECT_NEAR(on_map(pilot, map).up, 0.0, 1e-7);
}

TEST_F(MapCursor, IsNotSlewedOnAMapWithoutARecord) {
  pilot.around.maps = {};
  const double latitude_deg = pilot.state.cursor_latitude_deg;
  pilot.send("tdc 1 1");
  pilot.wait(50);
  EXPECT_EQ(pilot.state.cursor_latitude_deg, latitude_deg);
}

TEST_F(MapCursor, IsSlewedInAirToAirOnlyInSet) {
  pilot.press("mode aa");
  pilot.send("tdc 0.5 0");
  pilot.wait(50);
  EXPECT_NEAR(on_map(pilot, map).right, 0.0, 1e-9);
  pilot.press("pb 18");
  pilot.wait(49);
  EXPECT_NEAR(on_map(pilot, map).right, 0.5 * 50 / 400.0, 1e-6);
}

TEST_F(MapCursor, HasTheFrameOfTheAircraftAgainOnThePpi) {
  pilot.press("pb 14");
  EXPECT_EQ(pilot.state.frame_latitude_deg, pilot.around.ownship.latitude_deg);
  EXPECT_EQ(pilot.state.frame_track_deg, 0.0);
}

}  // namespace
}  // namespace yars::statemachine::testing
