// Extreme heights of the aircraft and of the ground. Expected results come from triangles: over a sphere of radius k R,
// the horizon of an aircraft at height H above level ground is at k R acos(k R / (k R + H)), about sqrt(2 k R H).
// R is the earth radius. The factor k = 4/3 accounts for refraction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/geo/quantity.hpp"
#include "tests/extremes/islands.hpp"

namespace yars::model {
namespace {

using test::expect_lit_between;
using test::geometry_from;
using test::seen;

constexpr double kFactor = 4.0 / 3.0;        // k
constexpr double kMeanRadius_m = 6371008.8;  // [m] EarthModel::sphere
constexpr double kFar_m = 1e9;               // [m] beyond every range

// Distance of the horizon at sea level, over level ground of elevation `ground_m`.
double horizon_m(double above_ground_m, double ground_m) {
  const double radius_m = kFactor * kMeanRadius_m;
  const double ground_radius_m = radius_m + ground_m;
  return radius_m * std::acos(ground_radius_m / (ground_radius_m + above_ground_m));
}

// False for the algorithm of the 1996 report, whose earth is flat.
bool has_curvature(const radar::RadarConfiguration& configuration) {
  return configuration.fidelity.algorithm != radar::Algorithm::report_1996;
}

// Expects power from level ground up to the horizon. The flat earth of the 1996 report has no horizon.
void expect_horizon(double altitude_m, double ground_m, double range_m) {
  test::for_each_algorithm_and_beam(400, [&](radar::RadarConfiguration& configuration) {
    configuration.fidelity.earth = radar::EarthModel::sphere;
    configuration.fidelity.earth_radius_factor = kFactor;
    const double end_m = has_curvature(configuration) ? horizon_m(altitude_m - ground_m, ground_m) : kFar_m;
    expect_lit_between(seen(configuration, geometry_from(test::kMidLatitude, 0.0, altitude_m, range_m),
                            terrain::AnalyticTerrain(terrain::flat(ground_m))),
                       range_m, 0.0, end_m);
  });
}

TEST(ExtremeHeights, At20MetresAboveTheDeadSeaTheHorizonIsAt18Kilometres) {
  EXPECT_NEAR(horizon_m(20.0, -420.0), std::sqrt(2.0 * kFactor * kMeanRadius_m * 20.0), 20.0);
  expect_horizon(-400.0, -420.0, 40000.0);
}

TEST(ExtremeHeights, At60000FeetTheHorizonIsAt557Kilometres) {
  const double altitude_m = geo::AltitudeMsl::feet(60000.0).metres();
  EXPECT_NEAR(horizon_m(altitude_m, 1.0), 557000.0, 1000.0);
  expect_horizon(altitude_m, 1.0, geo::Length::nautical_miles(320.0).metres());
}

TEST(ExtremeHeights, At100KilometresTheHorizonIsTheRootOfTwoKRH) {
  // The root is the first term of a series; the second term reduces it by 5 H / (12 k R), 0.5 %.
  const double root_m = std::sqrt(2.0 * kFactor * kMeanRadius_m * 100e3);
  EXPECT_NEAR(horizon_m(100e3, 1.0), root_m, 0.006 * root_m);
  expect_horizon(100e3, 1.0, geo::Length::nautical_miles(800.0).metres());
}

TEST(ExtremeHeights, AtZeroFeetAboveLevelGroundSamplesFromTheThirdOnAreDark) {
  // At height 0 the horizon is at the aircraft, so that all ground ahead is hidden.
  for (const double ground_m : {-400.0, 0.0, 0.5, 1000.0, 8848.0}) {
    SCOPED_TRACE(ground_m);
    test::for_each_algorithm_and_beam(400, [&](const radar::RadarConfiguration& configuration) {
      const auto power = seen(configuration, geometry_from(test::kMidLatitude, 0.0, ground_m, 40000.0),
                              terrain::AnalyticTerrain(terrain::flat(ground_m)));
      EXPECT_TRUE(std::all_of(power.begin() + 2, power.end(), [](float value) { return value == 0.0F; }));
    });
  }
}

TEST(ExtremeHeights, AtZeroFeetAboveGroundAHillsideAheadReturnsPowerFromItsFootOn) {
  // Flat earth: the grazing angle of the plain is 0. A slope of 5 % begins at 5 km and faces the aircraft.
  const terrain::AnalyticTerrain hillside([](geo::GeoPoint position) {
    const double distance_m = geo::geodesic_inverse(test::kMidLatitude, position).distance.metres();
    return 100.0 + 0.05 * std::max(0.0, distance_m - 5000.0);
  });
  test::for_each_algorithm_and_beam(400, [&](radar::RadarConfiguration& configuration) {
    configuration.fidelity.earth = radar::EarthModel::flat;
    const auto power = seen(configuration, geometry_from(test::kMidLatitude, 0.0, 100.0, 40000.0), hillside);
    EXPECT_TRUE(std::all_of(power.begin() + 2, power.begin() + 48, [](float value) { return value == 0.0F; }));
    EXPECT_TRUE(std::all_of(power.begin() + 53, power.end(), [](float value) { return value > 0.0F; }));
  });
}

TEST(ExtremeHeights, BelowTheTerrainSamplesFromTheThirdOnAreDark) {
  // The elevation angle of level ground above the aircraft decreases with distance: the nearest sample hides the rest.
  for (const double below_m : {0.1, 10.0, 500.0, 9000.0}) {
    SCOPED_TRACE(below_m);
    test::for_each_algorithm_and_beam(400, [&](const radar::RadarConfiguration& configuration) {
      const auto power = seen(configuration, geometry_from(test::kMidLatitude, 0.0, 8848.0 - below_m, 40000.0),
                              terrain::AnalyticTerrain(terrain::flat(8848.0)));
      EXPECT_TRUE(std::all_of(power.begin() + 2, power.end(), [](float value) { return value == 0.0F; }));
    });
  }
}

TEST(ExtremeHeights, InSlantRangeOnlySamplesFromTheNadirOnHavePower) {
  // No ground is nearer than the point below the aircraft (nadir). Level ground returns power from there on.
  for (const double above_m : {140.0, 3000.0, 18288.0}) {
    SCOPED_TRACE(above_m);
    test::for_each_algorithm_and_beam(400, [&](radar::RadarConfiguration& configuration) {
      if (!has_curvature(configuration)) return;  // the report has only ground range
      configuration.fidelity.slant_range = true;
      constexpr double kRange_m = 40000.0;
      const auto power = seen(configuration, geometry_from(test::kMidLatitude, 0.0, 200.0 + above_m, kRange_m),
                              terrain::AnalyticTerrain(terrain::flat(200.0)));
      // The sample of the nadir. The echo below the aircraft is shared with the sample before it.
      const auto nadir = static_cast<std::size_t>(above_m / (kRange_m / 400.0));
      for (std::size_t i = 0; i < power.size(); ++i) {
        if (i + 1 != nadir) {
          EXPECT_EQ(power[i] > 0.0F, i >= nadir) << i << " of " << nadir;
        }
      }
    });
  }
}

TEST(ExtremeHeights, InGroundRangeTheNadirIsTheFirstSampleWithASineOfOne) {
  // The middle of the first sample is at 5 m ground range, 3000 m below the aircraft. Its grazing angle is within 0.1
  // degrees of 90, so that its sine is 1. The report's power is this sine divided by the sine for level ground at sea
  // level at half the range (decision 20).
  constexpr double kAltitude_m = 3100.0, kRange_m = 40000.0;
  test::for_each_algorithm_and_beam(4000, [&](const radar::RadarConfiguration& configuration) {
    const auto power = seen(configuration, geometry_from(test::kMidLatitude, 0.0, kAltitude_m, kRange_m),
                            terrain::AnalyticTerrain(terrain::flat(100.0)));
    EXPECT_GT(power[0], 0.0F);
    if (has_curvature(configuration)) return;
    EXPECT_NEAR(static_cast<double>(power[0]), std::hypot(kAltitude_m, 0.5 * kRange_m) / kAltitude_m, 1e-4);
  });
}

// Distance at which the line of sight from the aircraft over an edge meets level ground behind the edge. Bisection of
// the distance, with elevation angles computed about the centre of the earth.
double shadow_end_m(double altitude_m, double edge_m, double edge_height_m, double ground_m) {
  const double radius_m = kFactor * kMeanRadius_m;
  // Tangent of the elevation angle of a point, seen from the aircraft.
  const auto tangent = [&](double distance_m, double height_m) {
    const double angle = distance_m / radius_m;
    return ((radius_m + height_m) * std::cos(angle) - (radius_m + altitude_m)) /
           ((radius_m + height_m) * std::sin(angle));
  };
  const double edge = tangent(edge_m, edge_height_m);
  double hidden_m = edge_m, lit_m = horizon_m(altitude_m - ground_m, ground_m);
  for (int step = 0; step < 100; ++step) {
    const double middle_m = 0.5 * (hidden_m + lit_m);
    (tangent(middle_m, ground_m) < edge ? hidden_m : lit_m) = middle_m;
  }
  return lit_m;
}

TEST(ExtremeHeights, BehindACliffOf8848MetresTheShadowEndsWhereTheLineOfSightMeetsTheGround) {
  constexpr double kCliff_m = 20000.0, kAltitude_m = 12000.0, kRange_m = 120000.0;
  const terrain::AnalyticTerrain cliff(terrain::step_wall(test::axis_north(), kCliff_m, 8848.0, 1.0));
  constexpr double kSpacing_m = kRange_m / 1200.0;
  // A sweep samples the cliff's edge at the middle of the last sample on the cliff.
  constexpr double kEdge_m = kCliff_m - 0.5 * kSpacing_m;
  test::for_each_algorithm_and_beam(1200, [&](radar::RadarConfiguration& configuration) {
    configuration.fidelity.earth = radar::EarthModel::sphere;
    configuration.fidelity.earth_radius_factor = kFactor;
    // For the flat earth the end follows from similar triangles.
    const double end_m = has_curvature(configuration) ? shadow_end_m(kAltitude_m, kEdge_m, 8848.0, 1.0)
                                                      : kEdge_m * (kAltitude_m - 1.0) / (kAltitude_m - 8848.0);
    ASSERT_LT(end_m, 0.8 * kRange_m);
    const auto power = seen(configuration, geometry_from(test::kMidLatitude, 0.0, kAltitude_m, kRange_m), cliff);
    for (std::size_t i = 0; i < power.size(); ++i) {
      const double distance_m = (static_cast<double>(i) + 0.5) * kSpacing_m;
      const bool near_an_edge =
          std::abs(distance_m - kCliff_m) < 2.0 * kSpacing_m || std::abs(distance_m - end_m) < 2.0 * kSpacing_m;
      if (near_an_edge) continue;
      EXPECT_EQ(power[i] > 0.0F, distance_m < kCliff_m || distance_m > end_m) << distance_m << ", end " << end_m;
    }
  });
}

TEST(ExtremeHeights, TheFaceOfACliffOf8848MetresIsTheBrightestAndHidesAllGroundBehindIt) {
  // At 2000 m the aircraft is below the edge, so that the line of sight over the edge never meets the ground.
  constexpr double kRange_m = 60000.0;
  const terrain::AnalyticTerrain cliff(terrain::step_wall(test::axis_north(), 20000.0, 1.0, 8848.0));
  test::for_each_algorithm_and_beam(600, [&](const radar::RadarConfiguration& configuration) {
    const auto power = seen(configuration, geometry_from(test::kMidLatitude, 0.0, 2000.0, kRange_m), cliff);
    // Samples nearer than 5 km are excluded, because the ground below the aircraft is bright too.
    const auto brightest = std::max_element(power.begin() + 50, power.end()) - power.begin();
    EXPECT_NEAR(static_cast<double>(brightest), 200.0, 2.0);
    EXPECT_TRUE(std::all_of(power.begin() + 203, power.end(), [](float value) { return value == 0.0F; }));
  });
}

TEST(ExtremeHeights, ElevationZeroIsWaterThatReturnsPowerInEverySample) {
  // From 4572 m the horizon is at 279 km, beyond the range.
  constexpr double kAltitude_m = 4572.0, kRange_m = 80000.0;
  test::for_each_algorithm_and_beam(400, [&](const radar::RadarConfiguration& configuration) {
    const auto power = seen(configuration, geometry_from(test::kMidLatitude, 0.0, kAltitude_m, kRange_m),
                            terrain::AnalyticTerrain(terrain::flat(0.0)));
    EXPECT_TRUE(std::all_of(power.begin(), power.end(), [](float value) { return value > 0.0F; }));
    if (has_curvature(configuration)) return;
    for (std::size_t i = 1; i + 1 < power.size(); ++i) {
      const double distance_m = (static_cast<double>(i) + 0.5) * kRange_m / 400.0;
      // The sine of the depression divided by the sine at half the range (decision 20). The report averages
      // neighbouring samples, which changes the power by the second difference of the curve.
      const double full_scale = kAltitude_m / std::hypot(kAltitude_m, 0.5 * kRange_m);
      EXPECT_NEAR(static_cast<double>(power[i]), kAltitude_m / std::hypot(kAltitude_m, distance_m) / full_scale, 0.01);
    }
  });
}

}  // namespace
}  // namespace yars::model
