// EffectiveEarth, the sphere whose radius allows for refraction: drop of the ground, horizon, slant range.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "model/physics/sweep_geometry.hpp"
#include "tests/model/physics/ground.hpp"

namespace yars::model::rbm {
namespace {

constexpr double kMeanRadius_m = 6371008.8;

TEST(EffectiveEarth, HasTheDropsOfTheSpecification) {
  struct Row {
    double range_nm, refracted_m, true_m;
  };
  // Source: docs/spec/physics.md#refraction, drops of the parabola to the metre. Exact drops are up to 0.03 % less.
  constexpr std::array<Row, 4> kRows{{{20, 81, 108}, {40, 323, 431}, {80, 1292, 1723}, {160, 5168, 6891}}};
  for (const Row& row : kRows) {
    const double distance_m = row.range_nm * geo::kMetresPerNauticalMile;
    EXPECT_NEAR(physics::EffectiveEarth(kMeanRadius_m * 4.0 / 3.0).drop_m(distance_m), row.refracted_m,
                0.5 + 3e-4 * row.refracted_m)
        << row.range_nm;
    EXPECT_NEAR(physics::EffectiveEarth(kMeanRadius_m).drop_m(distance_m), row.true_m, 0.5 + 3e-4 * row.true_m)
        << row.range_nm;
  }
}

TEST(EffectiveEarth, HasTheHorizonAtTheRootOfTwoKRadiusHeight) {
  radar::RadarConfiguration configuration = test::bare_configuration(4096);
  configuration.fidelity.earth = radar::EarthModel::sphere;
  configuration.fidelity.earth_radius_factor = 4.0 / 3.0;
  const terrain::AnalyticTerrain sea(terrain::flat(0.0));
  const double range_m = 160.0 * geo::kMetresPerNauticalMile;
  const auto samples = test::seen_by_reference(configuration, test::geometry_north(1000.0, range_m), sea);
  double last_lit_m = 0.0;
  for (const auto& sample : samples) {
    if (sample.lit) last_lit_m = sample.distance_m;
  }
  const double horizon_m = std::sqrt(2.0 * 4.0 / 3.0 * kMeanRadius_m * 1000.0);
  EXPECT_NEAR(last_lit_m, horizon_m, range_m / 4096.0);
}

TEST(EffectiveEarth, HasNoHorizonOnAFlatEarth) {
  const terrain::AnalyticTerrain sea(terrain::flat(0.0));
  const auto samples =
      test::seen_by_reference(test::bare_configuration(512), test::geometry_north(100.0, 300000.0), sea);
  for (const auto& sample : samples) ASSERT_TRUE(sample.lit) << sample.distance_m;
}

TEST(EffectiveEarth, EqualsVectorsOnASphere) {
  const physics::EffectiveEarth earth(8.5e6);
  for (const double distance_m : {10.0, 5000.0, 300000.0}) {
    for (const double height_m : {-100.0, 0.0, 4000.0}) {
      const double altitude_m = 4500.0;
      const physics::Sight sight = earth.sight(altitude_m, distance_m, height_m);
      // Position of the point relative to the aircraft: x horizontal, z up.
      const long double angle = distance_m / 8.5e6L;
      const long double x = (8.5e6L + height_m) * std::sin(angle);
      const long double z = (8.5e6L + height_m) * std::cos(angle) - (8.5e6L + altitude_m);
      EXPECT_NEAR(sight.tangent, static_cast<double>(z / x), 1e-9 * (1.0 + std::abs(sight.tangent)));
      EXPECT_NEAR(sight.slant_range_m, static_cast<double>(std::hypot(x, z)), 1e-6);
      // docs/spec/physics.md#incidence, with the point's height added to the radius and subtracted from the altitude.
      const double centre_m = 8.5e6 + height_m;
      const double above_m = altitude_m - height_m;
      const double range_m = sight.slant_range_m;
      const double sine =
          (above_m * above_m + 2.0 * above_m * centre_m - range_m * range_m) / (2.0 * range_m * centre_m);
      EXPECT_NEAR(sight.sin_grazing, sine, 1e-7);
      EXPECT_NEAR(sight.sin_grazing * sight.sin_grazing + sight.cos_grazing * sight.cos_grazing, 1.0, 1e-9);
    }
  }
}

TEST(EffectiveEarth, SlantRangeAndGroundRangeAreInverse) {
  const physics::EffectiveEarth earth(8.5e6);
  for (const double distance_m : {100.0, 20000.0, 300000.0}) {
    const double slant_m = earth.sight(4500.0, distance_m, 200.0).slant_range_m;
    EXPECT_NEAR(earth.distance_at_slant_range(4500.0, 200.0, slant_m), distance_m, 1e-3);
  }
}

TEST(EffectiveEarth, SlantRangesBelowTheHeightAboveGroundReturnNothing) {
  radar::RadarConfiguration configuration = test::bare_configuration(100);
  configuration.fidelity.slant_range = true;
  const terrain::AnalyticTerrain land(terrain::flat(500.0));
  // Samples of 100 m and ground 2000 m below the aircraft: the first 20 samples are empty.
  std::vector<float> power(100);
  Reference(configuration).measure(test::geometry_north(2500.0, 10000.0), land, power);
  for (std::size_t i = 0; i < 19; ++i) EXPECT_EQ(power[i], 0.0F) << i;
  for (std::size_t i = 20; i < 100; ++i) EXPECT_GT(power[i], 0.0F) << i;
}

}  // namespace
}  // namespace yars::model::rbm
