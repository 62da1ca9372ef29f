// Formation time of a patch map, against the table of docs/spec/physics.md#formation-time.
#include <gtest/gtest.h>

#include <cmath>

#include "lib/radar/configuration.hpp"
#include "lib/radar/mission.hpp"

namespace yars::radar {
namespace {

// The table's example: 20 NM, cells of 8.5 ft, 480 kt, one look.
MapGeometry look_at(double squint_deg) {
  return {geo::Length::nautical_miles(20.0), geo::Length::feet(8.5) * kMapCells, geo::Angle::degrees(squint_deg),
          geo::Speed::knots(480.0), 1};
}

double seconds_at(const MapGeometry& geometry) {
  return formation_time(geometry, RadarConfiguration()).seconds();
}

TEST(FormationTime, EqualsTheTable) {
  EXPECT_NEAR(seconds_at(look_at(8.0)), 7.8, 0.05);
  EXPECT_NEAR(seconds_at(look_at(15.0)), 4.2, 0.05);
  EXPECT_NEAR(seconds_at(look_at(30.0)), 2.2, 0.05);
  EXPECT_NEAR(seconds_at(look_at(45.0)), 1.5, 0.05);
  EXPECT_NEAR(seconds_at(look_at(90.0)), 1.1, 0.05);
}

TEST(FormationTime, GrowsWithRangeLooksAndFinerCells) {
  const MapGeometry geometry = look_at(30.0);
  MapGeometry farther = geometry;
  farther.slant_range = 2.0 * geometry.slant_range;
  EXPECT_NEAR(seconds_at(farther), 2.0 * seconds_at(geometry), 1e-6);
  MapGeometry looks = geometry;
  looks.looks = 3;
  EXPECT_NEAR(seconds_at(looks), 3.0 * seconds_at(geometry), 1e-6);
  MapGeometry finer = geometry;
  finer.window = 0.8 * geometry.window;
  EXPECT_NEAR(seconds_at(finer), seconds_at(geometry) / 0.8, 1e-6);
}

TEST(FormationTime, IsTheSameOnBothSidesAndAstern) {
  EXPECT_NEAR(seconds_at(look_at(-30.0)), seconds_at(look_at(30.0)), 1e-9);
  EXPECT_NEAR(seconds_at(look_at(150.0)), seconds_at(look_at(30.0)), 1e-9);
}

TEST(FormationTime, NeverExceedsItsCap) {
  EXPECT_EQ(seconds_at(look_at(0.0)), RadarConfiguration().high_resolution.max_formation_time_s);
  MapGeometry at_rest = look_at(90.0);
  at_rest.ground_speed = geo::Speed();
  EXPECT_EQ(seconds_at(at_rest), RadarConfiguration().high_resolution.max_formation_time_s);
}

}  // namespace
}  // namespace yars::radar
