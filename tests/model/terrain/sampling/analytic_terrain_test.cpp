// Analytic terrain: heights of the shapes in shapes.hpp, the fast path, and the built-in hills at the antimeridian.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/model/terrain/sampling/fast_path.hpp"
#include "tests/model/terrain/shapes.hpp"

namespace yars::model::terrain {
namespace {

const TerrainAxis kAxis{{37.0, -122.0}, geo::Bearing::degrees(30)};

// The position `along_m` metres along the axis and `across_m` metres to its right, by a geodesic from the origin.
geo::GeoPoint at(double along_m, double across_m = 0.0) {
  const geo::Angle off_axis = geo::Angle::radians(std::atan2(across_m, along_m));
  return geo::geodesic_direct(kAxis.origin, kAxis.direction + off_axis,
                              geo::Length::metres(std::hypot(along_m, across_m)));
}

TEST(AnalyticTerrain, APlaneRisesWithItsSlopeAlongTheAxisOnly) {
  const AnalyticTerrain terrain(plane(kAxis, 100, 0.02));
  EXPECT_NEAR(terrain.elevation_m(at(20000)), 500, 1e-6);
  EXPECT_NEAR(terrain.elevation_m(at(20000, 15000)), 500, 1e-6);
  EXPECT_NEAR(terrain.elevation_m(at(-5000)), 0, 1e-6);
}

TEST(AnalyticTerrain, AWedgeRisesFromItsStart) {
  const AnalyticTerrain terrain(wedge(kAxis, 10000, 0.1));
  EXPECT_EQ(terrain.elevation_m(at(9999)), 0);
  EXPECT_NEAR(terrain.elevation_m(at(12000)), 200, 1e-6);
}

TEST(AnalyticTerrain, APlateauHasTwoEdges) {
  const AnalyticTerrain terrain(plateau(kAxis, 10000, 20000, 800));
  EXPECT_EQ(terrain.elevation_m(at(9999)), 0);
  EXPECT_EQ(terrain.elevation_m(at(10001)), 800);
  EXPECT_EQ(terrain.elevation_m(at(19999)), 800);
  EXPECT_EQ(terrain.elevation_m(at(20001)), 0);
}

TEST(AnalyticTerrain, ARidgeIsARoof) {
  const AnalyticTerrain terrain(ridge(kAxis, 30000, 2000, 1000));
  EXPECT_NEAR(terrain.elevation_m(at(30000)), 1000, 1e-6);
  EXPECT_NEAR(terrain.elevation_m(at(29000)), 500, 1e-6);
  EXPECT_NEAR(terrain.elevation_m(at(31000)), 500, 1e-6);
  EXPECT_EQ(terrain.elevation_m(at(32001)), 0);
}

TEST(AnalyticTerrain, AStepWallHasNoThickness) {
  const AnalyticTerrain terrain(step_wall(kAxis, 5000, 10, 300));
  EXPECT_EQ(terrain.elevation_m(at(4999.9)), 10);
  EXPECT_EQ(terrain.elevation_m(at(5000.1)), 300);
}

TEST(AnalyticTerrain, SineHillsRepeatAfterAWavelength) {
  const AnalyticTerrain terrain(sine_hills(kAxis, 100, 4000));
  EXPECT_NEAR(terrain.elevation_m(at(1000, 1000)), 200, 1e-6);
  EXPECT_NEAR(terrain.elevation_m(at(5000, 1000)), 200, 1e-6);
  EXPECT_NEAR(terrain.elevation_m(at(3000, 3000)), 0, 1e-6);
}

TEST(AnalyticTerrain, TheFastPathGivesTheSameHeightsAndZeroIsWater) {
  const AnalyticTerrain terrain(wedge(kAxis, 10000, 0.1));
  const geo::GeoPoint sea = at(5000);
  const geo::GeoPoint land = at(15000);
  const auto found = test::fast_path(
      terrain, {sea, {land.latitude_deg, land.longitude_deg + 360.0}, {std::numeric_limits<double>::quiet_NaN(), 0.0}});
  const auto& [positions, elevation_m, water, peak_m, material, not_loaded] = found;
  EXPECT_EQ(material[1], 0);
  EXPECT_EQ(peak_m[1], elevation_m[1]);
  EXPECT_EQ(not_loaded, 0U);
  EXPECT_EQ(elevation_m[0], 0);
  EXPECT_EQ(water[0], 1);
  EXPECT_NEAR(elevation_m[1], terrain.elevation_m(positions[1]), 0.05);
  EXPECT_NEAR(elevation_m[1], 500, 0.05) << "the same position, with a longitude 360 degrees higher";
  EXPECT_EQ(water[1], 0);
  EXPECT_TRUE(std::isnan(elevation_m[2]));
}

TEST(AnalyticTerrain, TheBuiltInHillsHaveNoSeamAtTheAntimeridian) {
  const AnalyticTerrain terrain(built_in_hills());
  for (const double latitude : {-60.0, 0.0, 45.0})
    EXPECT_NEAR(terrain.elevation_m({latitude, 180.0 - 1e-9}), terrain.elevation_m({latitude, -180.0 + 1e-9}), 1e-2);
}

}  // namespace
}  // namespace yars::model::terrain
