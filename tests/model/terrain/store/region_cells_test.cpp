// cells_within(): the one-degree cells that a region's circle touches.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain {
namespace {

std::set<std::size_t> slots(const TerrainRegion& region) {
  std::set<std::size_t> result;
  for (const CellCorner corner : cells_within(region))
    EXPECT_TRUE(result.insert(slot_of(corner)).second) << "a cell is listed twice";
  return result;
}

TEST(RegionCells, APointNeedsItsOwnCell) {
  EXPECT_THAT(slots({{36.5, -121.5}, 0.0}), ::testing::Contains(slot_of({36, -122})));
}

// The posts of an edge are in both cells, and one of them may lack them.
TEST(RegionCells, APointOnAnEdgeNeedsAllCellsThatHaveIt) {
  EXPECT_THAT(slots({{36.0, -121.5}, 0.0}), ::testing::ElementsAre(slot_of({35, -122}), slot_of({36, -122})));
  EXPECT_THAT(slots({{36.0, -180.0}, 0.0}), ::testing::UnorderedElementsAre(slot_of({35, -180}), slot_of({36, -180}),
                                                                            slot_of({35, 179}), slot_of({36, 179})));
  EXPECT_THAT(slots({{-90.0, 20.5}, 0.0}), ::testing::Contains(slot_of({-90, 20})));
}

TEST(RegionCells, ADiscAcrossTheAntimeridianNeedsCellsOnBothSides) {
  const auto cells = slots({{10.5, 179.9}, 30e3});
  EXPECT_THAT(cells, ::testing::IsSupersetOf({slot_of({10, 179}), slot_of({10, -180})}));
}

TEST(RegionCells, ADiscOverThePoleNeedsThePolarCellOfEveryLongitude) {
  const auto cells = slots({{89.95, 20.0}, 20e3});
  for (int west = -180; west < 180; ++west) EXPECT_EQ(cells.count(slot_of({89, west})), 1U) << west;
}

TEST(RegionCells, EveryPositionWithinTheDiscHasItsCell) {
  constexpr unsigned kSeed = 4;
  std::mt19937_64 random(kSeed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int round = 0; round < 300; ++round) {
    const TerrainRegion region{{uniform(-90, 90), uniform(-180, 180)}, uniform(0, 320e3)};
    const auto cells = slots(region);
    for (int sample = 0; sample < 100; ++sample) {
      const double reach_m = sample % 2 == 0 ? region.radius_m : uniform(0, region.radius_m);
      const geo::GeoPoint position =
          geo::geodesic_direct(region.centre, geo::Bearing::degrees(uniform(0, 360)), geo::Length::metres(reach_m));
      ASSERT_EQ(cells.count(slot_of(cell_containing(position))), 1U)
          << "seed " << kSeed << ", round " << round << ": " << position.latitude_deg << ", " << position.longitude_deg
          << " from " << region.centre.latitude_deg << ", " << region.centre.longitude_deg << " at " << reach_m << " m";
    }
  }
}

TEST(RegionCells, ADiscOf160NauticalMilesAtMidLatitudeNeedsFewCells) {
  // The disc's area is that of 28 cells at 37 N; its circumference touches further cells.
  EXPECT_LT(cells_within({{37.0, -122.0}, 160 * 1852.0}).size(), 60U);
}

}  // namespace
}  // namespace yars::model::terrain
