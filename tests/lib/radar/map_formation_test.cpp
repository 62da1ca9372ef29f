// Formation time and resolution of a map. Source: docs/spec/physics.md#formation-time, #hrm-resolution.
#include <gtest/gtest.h>

#include <cmath>

#include "lib/radar/mapping.hpp"

namespace yars::radar {
namespace {

MapLook look_at(double squint_deg) {
  return {geo::Length::nautical_miles(20.0), geo::Length::feet(8.5) * kCellsOfMap, geo::Angle::degrees(squint_deg),
          geo::Speed::knots(480.0), 1};
}

double seconds_at(const MapLook& look) {
  return formation_time(look, RadarConfiguration()).seconds();
}

TEST(FormationTime, IsThatOfTheTable) {
  EXPECT_NEAR(seconds_at(look_at(8.0)), 7.8, 0.05);
  EXPECT_NEAR(seconds_at(look_at(15.0)), 4.2, 0.05);
  EXPECT_NEAR(seconds_at(look_at(30.0)), 2.2, 0.05);
  EXPECT_NEAR(seconds_at(look_at(45.0)), 1.5, 0.05);
  EXPECT_NEAR(seconds_at(look_at(90.0)), 1.1, 0.05);
}

TEST(FormationTime, GrowsWithRangeLooksAndFinerCells) {
  const MapLook look = look_at(30.0);
  MapLook farther = look;
  farther.slant_range = 2.0 * look.slant_range;
  EXPECT_NEAR(seconds_at(farther), 2.0 * seconds_at(look), 1e-6);
  MapLook looks = look;
  looks.looks = 3;
  EXPECT_NEAR(seconds_at(looks), 3.0 * seconds_at(look), 1e-6);
  MapLook coarser = look;
  coarser.window = 0.8 * look.window;
  EXPECT_NEAR(seconds_at(coarser), seconds_at(look) / 0.8, 1e-6);
}

TEST(FormationTime, IsTheSameOnBothSidesAndAstern) {
  EXPECT_NEAR(seconds_at(look_at(-30.0)), seconds_at(look_at(30.0)), 1e-9);
  EXPECT_NEAR(seconds_at(look_at(150.0)), seconds_at(look_at(30.0)), 1e-9);
}

TEST(FormationTime, NeverExceedsItsCap) {
  EXPECT_EQ(seconds_at(look_at(0.0)), RadarConfiguration().high_resolution.formation_cap_s);
  MapLook standing = look_at(90.0);
  standing.ground_speed = geo::Speed();
  EXPECT_EQ(seconds_at(standing), RadarConfiguration().high_resolution.formation_cap_s);
}

}  // namespace
}  // namespace yars::radar
