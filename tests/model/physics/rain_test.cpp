// Rain: reflectivity and attenuation, chords through rain cells, parts of a ray below the top of the rain, and the
// effect on sweeps by the algorithm `reference`.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "model/physics/atmosphere.hpp"
#include "model/physics/rain_attenuation.hpp"
#include "tests/model/physics/decibels.hpp"
#include "tests/model/physics/ground.hpp"

namespace yars::model::rbm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

geo::GeoPoint north_of(double distance_m, double bearing_deg = 0.0) {
  return geo::geodesic_direct(test::kMidLatitude, geo::Bearing::degrees(bearing_deg), geo::Length::metres(distance_m));
}

TEST(Rain, OfTenMillimetresPerHourHas39DbzAndAFifthOfADecibelPerKilometre) {
  const radar::RainConfiguration rain;
  const double wavelength_m = 0.03123;
  const double z = 200.0 * std::pow(10.0, 1.6);
  EXPECT_NEAR(decibels(z), 39.0, 0.05);
  const double eta = std::pow(std::numbers::pi, 5.0) * 0.93 * z * 1e-18 / std::pow(wavelength_m, 4.0);
  EXPECT_NEAR(physics::rain_reflectivity(rain, 10.0, wavelength_m) / eta, 1.0, 1e-9);
  EXPECT_NEAR(decibels(eta), -56.2, 0.1);
  EXPECT_NEAR(1000.0 * physics::rain_attenuation_db_per_m({0.010183, 1.27845}, 10.0), 0.193, 0.001);
}

TEST(Rain, AttenuatesByTheFrequencyUnlessTheConfigurationHasTheFactors) {
  radar::RadarConfiguration configuration;
  configuration.receiver.frequency_ghz = 16.0;
  const physics::RainLaw computed = physics::configured_rain_law(configuration);
  configuration.world.rain.attenuation_factor = 0.02;
  EXPECT_EQ(physics::configured_rain_law(configuration).factor, 0.02);
  EXPECT_EQ(physics::configured_rain_law(configuration).exponent, computed.exponent);
  configuration.world.rain.attenuation_exponent = 1.1;
  EXPECT_EQ(physics::configured_rain_law(configuration).exponent, 1.1);
  configuration.world.rain = {};
  configuration.receiver.frequency_ghz = 9.6;
  EXPECT_NEAR(physics::configured_rain_law(configuration).factor, 0.010183, 1e-6);
  EXPECT_NEAR(physics::configured_rain_law(configuration).exponent, 1.27845, 1e-5);
}

TEST(RainChord, ThroughTheMiddleHasAnIntegralOf16FifteenthsOfTheRadius) {
  const auto chord = physics::rain_chord(test::kMidLatitude, geo::Bearing(), north_of(30000.0), 6000.0);
  EXPECT_NEAR(chord.middle_m, 30000.0, 100.0);
  EXPECT_NEAR(chord.half_m, 6000.0, 1.0);
  EXPECT_NEAR(chord.integral_m(0.0, 1e9), 6400.0, 1.0);
  EXPECT_NEAR(chord.integral_m(0.0, chord.middle_m), 3200.0, 1.0);
  EXPECT_NEAR(chord.profile(chord.middle_m), 1.0, 1e-6);
}

TEST(RainChord, OffTheMiddleHasAnIntegralEqualToTheSumOverItsProfile) {
  const auto chord = physics::rain_chord(test::kMidLatitude, geo::Bearing(), north_of(30000.0, 7.0), 6000.0);
  EXPECT_NEAR(chord.depth, 1.0 - std::pow(30.0 * std::sin(7.0 * geo::kRadiansPerDegree) / 6.0, 2.0), 5e-3);
  double sum_m = 0.0;
  for (double d = 25000.5; d < 31000.0; d += 1.0) sum_m += chord.profile(d);
  EXPECT_NEAR(chord.integral_m(25000.0, 31000.0), sum_m, 0.01);
}

TEST(RainChord, ThatMissesIsEmpty) {
  const auto chord = physics::rain_chord(test::kMidLatitude, geo::Bearing(), north_of(30000.0, 20.0), 6000.0);
  EXPECT_EQ(chord.half_m, 0.0);
  EXPECT_EQ(chord.profile(30000.0), 0.0);
  EXPECT_EQ(chord.integral_m(0.0, 1e6), 0.0);
}

TEST(StretchBelow, OverAFlatEarthIsProportionalToTheDescent) {
  const physics::EffectiveEarth flat(kInfinity);
  const physics::Stretch below = physics::stretch_below(flat, 3000.0, 30000.0, 0.0, 1000.0);
  EXPECT_NEAR(below.from_m, 20000.0, 1e-6);
  EXPECT_NEAR(below.to_m, 30000.0, 1e-6);
  const physics::Stretch climbing = physics::stretch_below(flat, 500.0, 30000.0, 2000.0, 1000.0);
  EXPECT_NEAR(climbing.from_m, 0.0, 1e-6);
  EXPECT_NEAR(climbing.to_m, 10000.0, 1e-6);
  const physics::Stretch above = physics::stretch_below(flat, 3000.0, 30000.0, 2000.0, 1000.0);
  EXPECT_GE(above.from_m, above.to_m);
}

TEST(StretchBelow, OverARoundEarthIsWhereTheRayIsBelow) {
  const physics::EffectiveEarth round(8.5e6);
  for (const double altitude_m : {500.0, 3000.0, 12000.0}) {
    for (const double distance_m : {5000.0, 80000.0, 250000.0}) {
      const physics::Stretch below = physics::stretch_below(round, altitude_m, distance_m, 100.0, 2000.0);
      for (double fraction = 0.0005; fraction < 1.0; fraction += 0.001) {
        const double height_m = altitude_m + (100.0 - altitude_m) * fraction -
                                distance_m * distance_m * fraction * (1.0 - fraction) / (2.0 * 8.5e6);
        if (std::abs(height_m - 2000.0) < 5.0) continue;
        const double position_m = fraction * distance_m;
        EXPECT_EQ(position_m > below.from_m && position_m < below.to_m, height_m < 2000.0)
            << altitude_m << ", " << distance_m << ", " << fraction;
      }
    }
  }
}

TEST(BeamIntegral, EqualsTheSumOverThePattern) {
  const double theta = 2.5 * geo::kRadiansPerDegree;
  for (const auto pattern : {radar::BeamPattern::hard_edge, radar::BeamPattern::gaussian,
                             radar::BeamPattern::cosecant_squared, radar::BeamPattern::mapping}) {
    for (const double antenna_deg : {-8.0, -1.0, 3.0}) {
      const double antenna = antenna_deg * geo::kRadiansPerDegree;
      const double step = 1e-5;
      double sum = 0.0;
      for (double elevation = -0.9 + 0.5 * step; elevation < 0.2; elevation += step) {
        sum += step * physics::two_way_gain(pattern, theta, antenna, elevation);
      }
      EXPECT_NEAR(physics::beam_integral(pattern, theta, antenna, -0.9, 0.2) / sum, 1.0, 1e-3)
          << static_cast<int>(pattern) << " at " << antenna_deg;
    }
  }
  EXPECT_EQ(physics::beam_integral(radar::BeamPattern::gaussian, theta, 0.0, 0.1, 0.0), 0.0);
}

radar::RadarConfiguration rainy(double distance_m, double radius_m, double rate_mmh = 10.0, double top_m = 9000.0) {
  radar::RadarConfiguration configuration = test::bare_configuration(1000);
  configuration.world.rain.cells.push_back({north_of(distance_m), radius_m, rate_mmh, top_m});
  return configuration;
}

TEST(RainPath, ReturnsInInverseProportionToTheRangeSquared) {
  radar::RadarConfiguration configuration = rainy(40000.0, 39000.0, 10.0, 30000.0);
  configuration.antenna.elevation_beamwidth_deg = 2.0;  // the rain fills the beam
  physics::RainPath path(configuration);
  const physics::SweepGeometry geometry = test::geometry_north(2000.0, 80000.0);
  path.enter(geometry);
  const physics::Receiver receiver = physics::Receivers(configuration).at(geometry.range);
  const physics::EffectiveEarth flat(kInfinity);
  const auto chord = physics::rain_chord(geometry.apex, geometry.azimuth, north_of(40000.0), 39000.0);
  const auto per_profile = [&](double distance_m) {
    return path.power(receiver, flat, geometry, distance_m, -1.0) / chord.profile(distance_m);
  };
  // The range is the slant range to the top of the rain, 28 km above the aircraft.
  const double near_m = std::hypot(20000.0, 28000.0), far_m = std::hypot(40000.0, 28000.0);
  EXPECT_NEAR(per_profile(40000.0) / per_profile(20000.0), near_m * near_m / (far_m * far_m), 1e-6);
}

TEST(RainPath, AttenuatesTwoWayBehindTheRain) {
  const terrain::AnalyticTerrain plain(terrain::flat(100.0));
  const physics::SweepGeometry geometry = test::geometry_north(2000.0, 40000.0);
  radar::RadarConfiguration configuration = rainy(15000.0, 5000.0);
  const auto wet = test::seen_by_reference(configuration, geometry, plain);
  const double one_way_db_per_m = physics::rain_attenuation_db_per_m(physics::configured_rain_law(configuration), 10.0);
  configuration.world.rain.cells.clear();
  const auto dry = test::seen_by_reference(configuration, geometry, plain);
  // The slope of the ray, 1 : 19, adds a thousandth to its length in the rain.
  EXPECT_NEAR(decibels(wet[900].power / dry[900].power), -2.0 * one_way_db_per_m * 16.0 / 15.0 * 5000.0, 0.01);
  EXPECT_NEAR(wet[200].power, dry[200].power, 1e-12) << "in front of the rain";
}

TEST(RainPath, AttenuatesNothingAboveTheTopOfTheRain) {
  radar::RadarConfiguration configuration = rainy(15000.0, 5000.0, 10.0, 500.0);
  physics::RainPath path(configuration);
  path.enter(test::geometry_north(8000.0, 40000.0));
  // The ray to 35 km is above 500 m until 33 km.
  EXPECT_EQ(path.two_way_transmission(physics::EffectiveEarth(kInfinity), 8000.0, 35000.0, 0.0, 36000.0), 1.0);
}

TEST(RainPath, IsSeenAboveTheShadowOfARidge) {
  const terrain::AnalyticTerrain ridge(terrain::ridge(test::axis_north(), 10000.0, 1000.0, 1500.0));
  const physics::SweepGeometry geometry = test::geometry_north(2000.0, 40000.0);
  const auto wet = test::seen_by_reference(rainy(25000.0, 6000.0), geometry, ridge);
  const std::size_t middle = 25000 / 40;
  EXPECT_FALSE(wet[middle].lit);
  EXPECT_GT(wet[middle].power, 0.0);
  EXPECT_EQ(wet[400].power, 0.0) << "in the shadow in front of the rain";
}

}  // namespace
}  // namespace yars::model::rbm
