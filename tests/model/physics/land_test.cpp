// Return of land: gamma, materials, frequency, walls; position of texture, and direction of streets.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/physics/clutter.hpp"
#include "model/physics/reflectivity.hpp"
#include "tests/model/physics/decibels.hpp"

namespace yars::model::physics {
namespace {

TEST(Land, ReturnsFiveDecibelsMorePerDecadeOfFrequency) {
  const radar::LandConfiguration land;
  EXPECT_NEAR(frequency_term_db(land, 10.0), 0.0, 1e-12);
  EXPECT_NEAR(frequency_term_db(land, 1.0), -5.0, 1e-12);
  EXPECT_NEAR(frequency_term_db(land, 35.0), 2.72, 0.005);
}

TEST(Land, HasTheGammaOfItsMaterialElseTheDefaultGamma) {
  radar::RadarConfiguration configuration;
  configuration.receiver.frequency_ghz = 10.0;
  const LandReturn land = make_land_return(configuration);
  // Source: docs/spec/physics.md#land, start table by surface material code.
  const double gamma_db[] = {-14, 5, 2, 0, -3, -8, -14, -22, -8, -28, -17, -16, -12, -20, -14};
  for (std::size_t code = 0; code < std::size(gamma_db); ++code) {
    EXPECT_NEAR(decibels(land.gamma[code]), gamma_db[code], 1e-9) << code;
  }
  EXPECT_NEAR(decibels(1.0 + land.cardinal[1]), 12.0, 1e-9);
  EXPECT_EQ(land.cardinal[0], 0.0);
}

TEST(Land, ReturnsMoreFromWallsThatFaceTheRadarWithinSixDegrees) {
  const double cardinal = std::pow(10.0, 1.2) - 1.0;
  EXPECT_NEAR(decibels(cardinal_gain(cardinal, 0.0, 6.0)), 12.0, 1e-9);
  EXPECT_NEAR(cardinal_gain(cardinal, 3.0, 6.0), 1.0 + 0.5 * cardinal, 1e-9);
  EXPECT_NEAR(decibels(cardinal_gain(cardinal, 15.0, 6.0)), 0.0, 0.01);
}

TEST(Land, HasWallsParallelAndPerpendicularToItsStreets) {
  EXPECT_NEAR(off_street_deg(33.0, 30.0), 3.0, 1e-9);
  EXPECT_NEAR(off_street_deg(123.0, 30.0), 3.0, 1e-9);
  EXPECT_NEAR(off_street_deg(208.0, 30.0), -2.0, 1e-9);
  EXPECT_NEAR(off_street_deg(-61.0, 30.0), -1.0, 1e-9);
  EXPECT_NEAR(std::abs(off_street_deg(75.0, 30.0)), 45.0, 1e-9);
}

TEST(GroundGrid, HasCellsOfItsSizeAtEveryLatitude) {
  constexpr double kEdge_m = 512.0;
  const GroundGrid grid = make_ground_grid(kEdge_m);
  for (const double latitude_deg : {0.2, 37.6, -45.3, 60.4, 83.5, -88.7, 89.9}) {
    // Along a parallel, positions half a cell apart are mostly in one cell, and positions two cells apart never are.
    const double metres_per_degree = kGridMetresPerDegree * std::cos(latitude_deg * geo::kRadiansPerDegree);
    int equal = 0, beyond = 0;
    constexpr int kPositions = 2000;
    for (int i = 0; i < kPositions; ++i) {
      const double row_deg = latitude_deg + 1e-5 * i;
      const auto bits = [&](double east_m) { return ground_bits(grid, {row_deg, 10.0 + east_m / metres_per_degree}); };
      const double from_m = 29.0 * i;
      equal += bits(from_m) == bits(from_m + 0.5 * kEdge_m) ? 1 : 0;
      beyond += bits(from_m) == bits(from_m + 2.1 * kEdge_m) ? 1 : 0;
    }
    EXPECT_NEAR(equal, 0.34 * kPositions, 0.06 * kPositions) << latitude_deg;
    EXPECT_LE(beyond, 2) << latitude_deg;
  }
}

TEST(GroundGrid, TakesEveryPositionOnEarth) {
  const GroundGrid grid = make_ground_grid(64.0);
  EXPECT_EQ(ground_bits(grid, {12.3, 180.0}), ground_bits(grid, {12.3, -180.0}));
  EXPECT_EQ(ground_bits(grid, {12.3, 187.5}), ground_bits(grid, {12.3, -172.5}));
  for (const double latitude_deg : {-90.0, 90.0}) (void)ground_bits(grid, {latitude_deg, 0.0});
}

TEST(IncompleteGamma, AgreesWithItsClosedForms) {
  for (double x = 0.01; x < 30.0; x *= 1.3) {
    EXPECT_NEAR(incomplete_gamma(1.0, x), 1.0 - std::exp(-x), 1e-12) << x;
    EXPECT_NEAR(incomplete_gamma(2.0, x), 1.0 - std::exp(-x) * (1.0 + x), 1e-12) << x;
    EXPECT_NEAR(incomplete_gamma(0.5, x), std::erf(std::sqrt(x)), 1e-12) << x;
  }
  EXPECT_EQ(incomplete_gamma(3.0, 0.0), 0.0);
}

TEST(Texture, HasMeanOneAndTheVarianceOfItsShape) {
  for (const double shape : {0.3, 0.5, 1.0, 2.0, 4.0, 20.0, 100.0}) {
    const TextureLevels levels = make_texture_levels(shape);
    double mean = 0.0, square = 0.0;
    for (const float level : levels) {
      mean += static_cast<double>(level) / kTextureLevels;
      square += static_cast<double>(level) * static_cast<double>(level) / kTextureLevels;
    }
    EXPECT_NEAR(mean, 1.0, 1e-6) << shape;
    EXPECT_NEAR((square - 1.0) * shape, 1.0, shape < 1.0 ? 0.03 : 0.01) << shape;
    EXPECT_TRUE(std::is_sorted(levels.begin(), levels.end()));
  }
  for (const float level : make_texture_levels(0.0)) EXPECT_EQ(level, 1.0F);
}

TEST(Texture, OfManyShapesInTurnIsThatOfEach) {
  std::vector<TextureLevels> first;
  for (int turn = 0; turn < 2; ++turn)
    for (std::size_t i = 0; i < 12; ++i) {
      const TextureLevels levels = make_texture_levels(0.5 + static_cast<double>(i));
      if (turn == 0)
        first.push_back(levels);
      else
        EXPECT_EQ(levels, first[i]) << i;
    }
  EXPECT_NE(first[0], first[11]);
}

TEST(Texture, HasCellsAtLeastAsLongAsPulseAndSample) {
  EXPECT_EQ(texture_cell_m(300.0, 154.0), 512.0);
  EXPECT_EQ(texture_cell_m(75.0, 300.0), 512.0);
  EXPECT_EQ(texture_cell_m(64.0, 10.0), 64.0);
}

TEST(StreetGrid, BearingsAreBelow90DegreesAndEqualWithinAPatch) {
  int equal = 0;
  constexpr int kPositions = 2000;
  for (int index = 0; index < kPositions; ++index) {
    const geo::GeoPoint position{-70.0 + 0.07 * index, -180.0 + 0.18 * index};
    const double bearing_deg = street_bearing_deg(position);
    ASSERT_GE(bearing_deg, 0.0);
    ASSERT_LT(bearing_deg, 90.0);
    equal +=
        static_cast<int>(bearing_deg == street_bearing_deg({position.latitude_deg + 0.005, position.longitude_deg}));
  }
  EXPECT_GT(equal, kPositions * 3 / 4) << "positions 550 m apart are mostly in one patch";
  EXPECT_LT(equal, kPositions) << "but not all";
}

TEST(StreetGrid, AllDirectionsOccur) {
  int sectors[9] = {};
  for (int index = 0; index < 3000; ++index)
    ++sectors[static_cast<int>(street_bearing_deg({-40.0 + 0.03 * index, 3.1 * index}) / 10.0)];
  for (const int count : sectors) EXPECT_GT(count, 30);
}

TEST(StreetGrid, BearingsAreContinuousAcrossTheAntimeridian) {
  for (double latitude_deg = -89.5; latitude_deg < 90.0; latitude_deg += 0.5) {
    EXPECT_EQ(street_bearing_deg({latitude_deg, 180.0}), street_bearing_deg({latitude_deg, -180.0}));
    const double west = street_bearing_deg({latitude_deg, 179.9999999});
    EXPECT_EQ(west, street_bearing_deg({latitude_deg, -179.9999999})) << latitude_deg;
  }
}

TEST(StreetFinder, EqualsStreetPatchAlongLinesOfPositions) {
  StreetFinder finder;
  // Positions in small steps, as along a sweep. The lines cross the antimeridian; the last line passes beyond a pole.
  for (const double start_deg : {-89.9, -34.0, 37.0, 88.0})
    for (int step = 0; step < 800; ++step) {
      const geo::GeoPoint position{start_deg + 0.004 * step, 179.0 + 0.003 * step};
      const StreetPatch found = finder.patch(position);
      const StreetPatch expected = street_patch(position);
      ASSERT_EQ(found.bearing_deg, expected.bearing_deg) << position.latitude_deg;
      ASSERT_EQ(found.origin.longitude_deg, expected.origin.longitude_deg) << position.latitude_deg;
      ASSERT_EQ(finder.bearing_deg(position), expected.bearing_deg);
    }
}

}  // namespace
}  // namespace yars::model::physics
