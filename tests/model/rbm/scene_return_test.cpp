// Return of scene objects in a sweep: one object against the radar equation, many objects against the sum of each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/physics/reflectivity.hpp"
#include "model/rbm/beam.hpp"
#include "model/rbm/point_return.hpp"
#include "model/rbm/standard.hpp"
#include "tests/model/made_up_objects.hpp"
#include "tests/model/physics/decibels.hpp"
#include "tests/model/physics/ground.hpp"

namespace yars::model::rbm {
namespace {

using test::Building;

constexpr double kSceneAltitude_m = 2000.0;
constexpr double kSceneRange_m = 40000.0;
constexpr std::size_t kSceneSamples = 1000;  // 40 m each

radar::RadarConfiguration base_configuration() {
  radar::RadarConfiguration configuration = test::bare_configuration(static_cast<int>(kSceneSamples));
  configuration.receiver.stc_exponent = 0.0;
  return configuration;
}

geo::GeoPoint north_by(double distance_m, double bearing_deg = 0.0) {
  return geo::geodesic_direct(test::kMidLatitude, geo::Bearing::degrees(bearing_deg), geo::Length::metres(distance_m));
}

std::vector<float> power_of(const radar::RadarConfiguration& configuration, const physics::SweepGeometry& geometry,
                            const scene::SceneView* scenes,
                            const terrain::AnalyticTerrain::Height& height = terrain::flat(0.0)) {
  Beam algorithm(configuration);
  std::vector<float> power(kSceneSamples);
  const terrain::AnalyticTerrain ground(height);
  algorithm.measure(geometry, {ground, scenes}, power);
  return power;
}

// By sample: power with the scene minus power of the ground alone.
std::vector<double> added_by(const radar::RadarConfiguration& configuration, const scene::SceneView& scenes,
                             const terrain::AnalyticTerrain::Height& height = terrain::flat(0.0),
                             const physics::SweepGeometry& geometry = test::geometry_north(kSceneAltitude_m,
                                                                                           kSceneRange_m)) {
  const auto with_scene = power_of(configuration, geometry, &scenes, height);
  const auto without = power_of(configuration, geometry, nullptr, height);
  std::vector<double> difference(kSceneSamples);
  std::transform(with_scene.begin(), with_scene.end(), without.begin(), difference.begin(),
                 [](float a, float b) { return static_cast<double>(a) - static_cast<double>(b); });
  return difference;
}

double sum_of(const std::vector<double>& power) {
  return std::accumulate(power.begin(), power.end(), 0.0);
}

std::size_t brightest(const std::vector<double>& power) {
  return static_cast<std::size_t>(std::max_element(power.begin(), power.end()) - power.begin());
}

// Power [full scale] of a cross section with its middle at a distance over flat ground and at a height.
double expected(const radar::RadarConfiguration& configuration, double sigma_m2, double distance_m, double height_m) {
  const physics::Receiver receiver = physics::Receivers(configuration).at(geo::Length::metres(kSceneRange_m));
  return sigma_m2 / std::pow(std::hypot(distance_m, kSceneAltitude_m - height_m), 4.0) / receiver.full_scale;
}

double gamma_of(std::size_t material) {
  return physics::make_land_return(base_configuration()).gamma[material];
}

TEST(SceneReturn, OfABoxIsGammaTimesTheAreaThatFacesTheRadarAtItsRange) {
  const double distance_m = 20020.0;
  const auto scenes = test::scene_of({Building{}}, north_by(distance_m));
  const auto added = added_by(base_configuration(), *scenes);
  EXPECT_EQ(brightest(added), 500U);
  for (std::size_t i = 0; i < added.size(); ++i) {
    if (i != 500) {
      EXPECT_EQ(added[i], 0.0) << i;
    }
  }
  const double slant_m = std::hypot(distance_m, kSceneAltitude_m - 15.0);
  const double seen_m2 = 20.0 * 30.0 * distance_m / slant_m + 20.0 * 20.0 * (kSceneAltitude_m - 15.0) / slant_m;
  EXPECT_NEAR(added[500] / expected(base_configuration(), gamma_of(5) * seen_m2, distance_m, 15.0), 1.0, 0.005);
}

TEST(SceneReturn, IsInTheSamplesThatTheObjectCovers) {
  // Box 120 m long and 0.8 m high. Its middle at 20 km is the border of samples 499 and 500.
  const auto scenes = test::scene_of({{0.0, 0.0, 20.0, 120.0, 0.8}}, north_by(20000.0));
  const auto added = added_by(base_configuration(), *scenes);
  std::vector<std::size_t> lit;
  for (std::size_t i = 0; i < added.size(); ++i)
    if (added[i] > 0.02 * sum_of(added)) lit.push_back(i);
  ASSERT_GE(lit.size(), 4U);
  EXPECT_LE(lit.size(), 6U);
  EXPECT_GE(lit.front(), 497U);
  EXPECT_LE(lit.back(), 502U);
}

TEST(SceneReturn, FollowsTheBeamPatternAndIsZeroBesideTheBeam) {
  const auto power_at = [](double bearing_deg) {
    return sum_of(added_by(base_configuration(), *test::scene_of({Building{}}, north_by(20020.0, bearing_deg))));
  };
  EXPECT_NEAR(decibels(power_at(1.25) / power_at(0.0)), -6.02, 0.1);
  EXPECT_NEAR(decibels(power_at(-1.25) / power_at(0.0)), -6.02, 0.1);
  EXPECT_EQ(power_at(6.0), 0.0);
}

TEST(SceneReturn, IsTheSameWithSeveralRaysAcrossTheBeam) {
  for (const double bearing_deg : {0.0, 0.3, -1.2}) {
    const auto scenes = test::scene_of({Building{}}, north_by(20020.0, bearing_deg));
    radar::RadarConfiguration rays = base_configuration();
    rays.fidelity.sub_beams = 5;
    EXPECT_NEAR(sum_of(added_by(rays, *scenes)) / sum_of(added_by(base_configuration(), *scenes)), 1.0, 1e-4)
        << bearing_deg;
  }
}

TEST(SceneReturn, IsInOneCellOfASharpenedBeamAndStrongerByTheSharpening) {
  physics::SweepGeometry geometry = test::geometry_north(kSceneAltitude_m, kSceneRange_m);
  const double half_rad = 0.05 * geo::kRadiansPerDegree;
  geometry.sharpened_cell = physics::AzimuthInterval{-half_rad, half_rad};
  const auto scene_at = [](double bearing_deg) { return test::scene_of({Building{}}, north_by(20020.0, bearing_deg)); };
  const double real = sum_of(added_by(base_configuration(), *scene_at(0.0)));
  const double beam_deg = physics::azimuth_cell_rad(base_configuration().antenna.azimuth_beamwidth_deg);
  EXPECT_NEAR(sum_of(added_by(base_configuration(), *scene_at(0.0), terrain::flat(0.0), geometry)) / real,
              beam_deg / 0.1, 0.01 * beam_deg / 0.1);
  EXPECT_EQ(sum_of(added_by(base_configuration(), *scene_at(0.15), terrain::flat(0.0), geometry)), 0.0);
  // An object on the border of two cells returns half of its power in each cell.
  EXPECT_NEAR(sum_of(added_by(base_configuration(), *scene_at(0.05), terrain::flat(0.0), geometry)) / real,
              0.5 * beam_deg / 0.1, 0.02 * beam_deg / 0.1);
}

TEST(SceneReturn, OfTwiceTheAreaIsThreeDecibelsMore) {
  const auto one = test::scene_of({{0, 0, 10.0, 20.0, 15.0}}, north_by(20020.0));
  const auto two = test::scene_of({{0, 0, 20.0, 20.0, 15.0}}, north_by(20020.0));
  EXPECT_NEAR(decibels(sum_of(added_by(base_configuration(), *two)) / sum_of(added_by(base_configuration(), *one))),
              3.01, 0.02);
}

TEST(SceneReturn, OfWallsThatFaceTheRadarHasTheCardinalEffect) {
  constexpr std::uint8_t kStone = 3;
  const Building building{0.0, 0.0, 20.0, 20.0, 30.0, kStone};
  const double facing = sum_of(added_by(base_configuration(), *test::scene_of({building}, north_by(20020.0), 0.0)));
  const double turned = sum_of(added_by(base_configuration(), *test::scene_of({building}, north_by(20020.0), 45.0)));
  const double slant_m = std::hypot(20020.0, kSceneAltitude_m - 15.0);
  const double level = 20020.0 / slant_m, up = (kSceneAltitude_m - 15.0) / slant_m;
  const double wall_m2 = 600.0 * level, roof_m2 = 400.0 * up;
  // Cardinal effect of stone: 10 dB, a factor of 10. At 45 degrees two walls are visible.
  const double expected_db = decibels((10.0 * wall_m2 + roof_m2) / (std::sqrt(2.0) * wall_m2 + roof_m2));
  EXPECT_NEAR(decibels(facing / turned), expected_db, 0.1);
  EXPECT_GT(expected_db, 8.0);
}

TEST(SceneReturn, BehindARidgeIsZero) {
  const auto hill = terrain::ridge(test::axis_north(), 15000.0, 1000.0, 900.0);
  for (const double power : added_by(base_configuration(), *test::scene_of({Building{}}, north_by(20020.0)), hill))
    EXPECT_EQ(power, 0.0);
  EXPECT_GT(sum_of(added_by(base_configuration(), *test::scene_of({Building{}}, north_by(12020.0)), hill)), 0.0);
}

TEST(SceneReturn, IsProportionalToTheHeightAboveTheHorizon) {
  // `hidden_m`: height at which the line of sight over the crest meets the tower.
  const double crest_m = 300.0, crest_at_m = 18020.0, tower_at_m = 21020.0;
  const double hidden_m = kSceneAltitude_m - (kSceneAltitude_m - crest_m) * tower_at_m / crest_at_m;
  ASSERT_GT(hidden_m, 0.0);
  const double tower_m = 4.0 * hidden_m;
  const auto scenes = test::scene_of({{0.0, 0.0, 20.0, 20.0, tower_m}}, north_by(tower_at_m));
  const auto hill = terrain::ridge(test::axis_north(), crest_at_m, 1000.0, crest_m);
  const double visible_fraction =
      sum_of(added_by(base_configuration(), *scenes, hill)) / sum_of(added_by(base_configuration(), *scenes));
  EXPECT_NEAR(visible_fraction, 0.75, 0.02);
}

TEST(SceneReturn, OfManyObjectsIsTheSumOfEach) {
  std::vector<Building> all;
  std::vector<double> sum(kSceneSamples, 0.0);
  for (int i = 0; i < 60; ++i) {
    const Building one{150.0 * (i % 10 - 5) + 16.0, 150.0 * (i / 10 - 3) + 16.0, 10.0, 8.0 + i, 5.0 + 0.5 * i};
    all.push_back(one);
    const auto added = added_by(base_configuration(), *test::scene_of({one}, north_by(20020.0)));
    std::transform(sum.begin(), sum.end(), added.begin(), sum.begin(), std::plus<>());
  }
  const auto together = added_by(base_configuration(), *test::scene_of(all, north_by(20020.0)));
  const double maximum = *std::max_element(sum.begin(), sum.end());
  for (std::size_t i = 0; i < kSceneSamples; ++i) EXPECT_NEAR(together[i], sum[i], 2e-5 * maximum) << i;
}

TEST(SceneReturn, OfARunwayReplacesTheGroundsReturn) {
  const auto scenes = test::scene_of({{0.0, 0.0, 600.0, 2000.0, 0.0, 9}}, north_by(20000.0));
  const physics::SweepGeometry geometry = test::geometry_north(kSceneAltitude_m, kSceneRange_m);
  for (const bool fast : {false, true}) {
    radar::RadarConfiguration configuration = base_configuration();
    if (fast) configuration.fidelity.algorithm = radar::Algorithm::standard;
    const auto with_scene = power_of(configuration, geometry, scenes.get(), terrain::flat(50.0));
    const auto without = power_of(configuration, geometry, nullptr, terrain::flat(50.0));
    const double ratio = gamma_of(9) / physics::Receivers(configuration).at(geometry.range).land_gamma;
    for (std::size_t i = 478; i < 522; ++i)
      EXPECT_NEAR(static_cast<double>(with_scene[i] / without[i]), ratio, 0.01 * ratio) << i;
    for (const std::size_t i : {400U, 470U, 530U, 600U}) EXPECT_EQ(with_scene[i], without[i]) << i;
  }
}

TEST(SceneReturn, OutsideTheSweepChangesNoBit) {
  const physics::SweepGeometry geometry = test::geometry_north(kSceneAltitude_m, kSceneRange_m);
  const auto without = power_of(base_configuration(), geometry, nullptr);
  for (const auto& position : {north_by(60000.0), north_by(20000.0, 90.0), north_by(20000.0, 180.0)}) {
    const auto scenes = test::scene_of({Building{}, {200, 0, 100, 100, 0.0, 9}}, position);
    EXPECT_EQ(power_of(base_configuration(), geometry, scenes.get()), without);
  }
}

TEST(SceneReturn, OfStandardEqualsThatOfReference) {
  std::vector<Building> town{{0.0, 900.0, 45.0, 1800.0, 0.0, 9}};
  for (int i = 0; i < 200; ++i) town.push_back({70.0 * (i % 20 - 10), 90.0 * (i / 20 - 5), 12.0, 18.0, 6.0 + i % 9, 3});
  const auto scenes = test::scene_of(town, north_by(25000.0, 0.4), 30.0);
  radar::RadarConfiguration configuration;
  configuration.fidelity.noise = false;
  configuration.fidelity.samples = static_cast<int>(kSceneSamples);
  const physics::SweepGeometry geometry = test::geometry_north(kSceneAltitude_m, kSceneRange_m);
  configuration.fidelity.algorithm = radar::Algorithm::standard;
  const auto fast = power_of(configuration, geometry, scenes.get(), terrain::flat(20.0));
  configuration.fidelity.algorithm = radar::Algorithm::reference;
  const auto exact = power_of(configuration, geometry, scenes.get(), terrain::flat(20.0));
  // The first and the last cell have one neighbour.
  constexpr std::size_t kPulse = 5;
  for (std::size_t i = kPulse; i + kPulse < kSceneSamples; ++i)
    EXPECT_NEAR(fast[i], exact[i], 1e-3F * exact[i] + 1e-9F) << i;
}

}  // namespace
}  // namespace yars::model::rbm
