// Attenuation by the gases of the air, against Recommendation ITU-R P.676-13 and against sums over thin layers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "model/kernel/scan_state.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/rbm/beam.hpp"
#include "model/rbm/emitters.hpp"
#include "model/rbm/standard.hpp"
#include "tests/model/made_up_objects.hpp"
#include "tests/model/physics/gas_layers.hpp"
#include "tests/model/physics/ground.hpp"

namespace yars::model::rbm {
namespace {

using physics::gas_attenuation;
using physics::reference_air;

constexpr double kNauticalMile_m = 1852.0;

// Source: validation examples of the ITU (CG-3M3J-13-ValEx, sheet "P.676-13 SpAtt") for 1013.25 hPa, 15 C, 7.5 g/m3.
// Attenuation of oxygen (dry) and water vapour [dB/km].
TEST(Gases, HaveTheRecommendationsSpecificAttenuation) {
  struct Example {
    double frequency_ghz, dry, water;
  };
  constexpr Example kExamples[] = {{12.0, 0.00869826406877357, 0.00953538822024593},
                                   {20.0, 0.0118835504778076, 0.0970473048151117},
                                   {60.0, 14.6234747964861, 0.154841840636247},
                                   {90.0, 0.0388697110724235, 0.341973394422181},
                                   {130.0, 0.0415090835995228, 0.75184470364613}};
  for (const Example& example : kExamples) {
    const auto found = gas_attenuation(example.frequency_ghz, {288.15, 1013.25, 7.5});
    EXPECT_NEAR(found.dry / example.dry, 1.0, 1e-9) << example.frequency_ghz;
    EXPECT_NEAR(found.water / example.water, 1.0, 1e-9) << example.frequency_ghz;
  }
  const auto at_ten = gas_attenuation(10.0, {288.15, 1013.25, 7.5});
  EXPECT_NEAR(at_ten.dry + at_ten.water, 0.0142, 0.00005);
}

// Recommendation ITU-R P.835-6, Annex 1: 216.65 K from 11 to 20 km; 226.32 hPa at 11 km, 54.75 hPa at 20 km. These
// heights are geopotential.
TEST(Gases, HaveTheReferenceAtmosphere) {
  const radar::AtmosphereConfiguration atmosphere;
  const auto air_at = [&](double geopotential_km) {
    return reference_air(atmosphere, 1000.0 * 6356.766 * geopotential_km / (6356.766 - geopotential_km));
  };
  const auto pressure_hpa = [](const physics::Air& air) { return air.dry_hpa + vapour_hpa(air); };
  EXPECT_NEAR(pressure_hpa(air_at(0.0)), 1013.25, 1e-9);
  EXPECT_NEAR(air_at(11.0).temperature_k, 216.65, 1e-9);
  EXPECT_NEAR(pressure_hpa(air_at(11.0)), 226.3226, 0.1);
  EXPECT_NEAR(pressure_hpa(air_at(20.0)), 54.7498, 0.1);
  EXPECT_NEAR(air_at(30.0).temperature_k, 226.65, 1e-9);
  EXPECT_NEAR(reference_air(atmosphere, 2000.0).water_g_m3, 7.5 / std::exp(1.0), 1e-9);
}

TEST(Gases, OfTwoAtmospheresInTurnAreThoseOfEach) {
  radar::AtmosphereConfiguration humid, dry;
  dry.water_g_m3 = 0.0;
  const double of_humid = physics::GasProfile(humid, 10.0).db_per_m(500.0);
  const double of_dry = physics::GasProfile(dry, 10.0).db_per_m(500.0);
  EXPECT_LT(of_dry, of_humid);
  EXPECT_EQ(physics::GasProfile(humid, 10.0).db_per_m(500.0), of_humid);
  EXPECT_LT(physics::GasProfile(humid, 5.0).db_per_m(500.0), of_humid);
  EXPECT_EQ(physics::GasProfile(dry, 10.0).db_per_m(500.0), of_dry);
}

TEST(Gases, ThatAreSwitchedOffAttenuateNothing) {
  radar::AtmosphereConfiguration atmosphere;
  atmosphere.gases = false;
  const physics::GasProfile profile(atmosphere, 10.0);
  EXPECT_TRUE(profile.empty());
  for (const double height_m : {-2000.0, 0.0, 5000.0, 50'000.0}) EXPECT_EQ(profile.db_per_m(height_m), 0.0) << height_m;
}

// Rays that go deeper are skipped, because no ground is so deep.
constexpr double kDeepest_m = -450.0;

// Lowest height [m MSL] of a ray from `altitude_m` to a point.
double lowest_m(double altitude_m, double distance_m, double height_m) {
  const double bow_m = 0.5 * distance_m * distance_m / (4.0 / 3.0 * 6371008.8);
  double lowest = height_m;
  for (double fraction = 0.0; fraction <= 1.0; fraction += 0.01)
    lowest = std::min(lowest, altitude_m + fraction * (height_m - altitude_m) - fraction * (1.0 - fraction) * bow_m);
  return lowest;
}

TEST(Gases, OfARayAreTheSumOverThinLayers) {
  const radar::RadarConfiguration configuration;
  const physics::GasPath path(configuration);
  const double radius_m = 4.0 / 3.0 * 6371008.8;
  for (const double altitude_m : {150.0, 1500.0, 4572.0, 12000.0, 18000.0})
    for (const double range_nm : {4.7, 10.0, 40.0, 80.0, 160.0})
      for (const double height_m : {-50.0, 0.0, 1500.0, 4000.0}) {
        const double distance_m = range_nm * kNauticalMile_m;
        if (lowest_m(altitude_m, distance_m, height_m) < kDeepest_m) continue;
        const double expected = test::gases_in_layers_db(configuration, radius_m, altitude_m, distance_m, height_m);
        EXPECT_NEAR(path.one_way_db(physics::EffectiveEarth(radius_m), altitude_m, distance_m, height_m), expected,
                    0.002 + 0.002 * expected)
            << altitude_m << " m, " << range_nm << " NM, " << height_m << " m";
      }
}

TEST(Gases, AttenuateByFourToEightDecibelsTwoWayAt140Miles) {
  radar::RadarConfiguration configuration;
  configuration.receiver.frequency_ghz = 10.0;
  const physics::GasPath path(configuration);
  const physics::EffectiveEarth flat(std::numeric_limits<double>::infinity());
  // Level ray at sea level over 160 NM = 296.32 km, at 0.0142 dB/km one way less 1.5 % for the vapour's pressure.
  EXPECT_NEAR(2.0 * path.one_way_db(flat, 0.0, 160.0 * kNauticalMile_m, 0.0), 2.0 * 0.0140 * 296.32, 0.05);
  const physics::EffectiveEarth earth(4.0 / 3.0 * 6371008.8);
  const double from_15000_ft = 2.0 * path.one_way_db(earth, 4572.0, 140.0 * kNauticalMile_m, 0.0);
  EXPECT_GT(from_15000_ft, 4.0);
  EXPECT_LT(from_15000_ft, 8.0);
}

// GasSamples, the fast factors of all samples of a sweep, against the integral along each ray.
TEST(Gases, OfSamplesAgreeWithThoseOfRays) {
  const radar::RadarConfiguration configuration;
  const physics::GasPath path(configuration);
  const physics::EffectiveEarth earth(4.0 / 3.0 * 6371008.8);
  constexpr std::size_t kSamples = 480;
  physics::GasSamples samples(configuration, kSamples);
  for (const double altitude_m : {150.0, 1500.0, 4572.0, 15000.0})
    for (const double range_nm : {4.7, 40.0, 160.0})
      for (const float height_m : {-400.0F, 0.0F, 700.0F, 2000.0F, 3500.0F, 6000.0F}) {
        std::vector<float> distance_m(kSamples), heights(kSamples, height_m), factor(kSamples, 1.0F);
        for (std::size_t i = 0; i < kSamples; ++i)
          distance_m[i] = static_cast<float>((static_cast<double>(i) + 0.5) * range_nm * kNauticalMile_m / kSamples);
        samples.use(path, altitude_m, range_nm * kNauticalMile_m, distance_m);
        const physics::GasSamples::Coefficients loss = samples.coefficients();
        const float h = std::clamp(height_m, physics::GasSamples::kLowest_m, physics::GasSamples::kHighest_m);
        for (std::size_t i = 0; i < kSamples; ++i) {
          const auto height = static_cast<double>(height_m);
          if (lowest_m(altitude_m, static_cast<double>(distance_m[i]), height) < kDeepest_m) continue;
          const double expected_db =
              -2.0 * path.one_way_db(earth, altitude_m, static_cast<double>(distance_m[i]), height);
          ASSERT_NEAR(10.0 * std::log10(static_cast<double>(loss.constant[i] + h * (loss.slope[i] + h * loss.bend[i]))),
                      expected_db, 0.1)
              << altitude_m << " m, " << range_nm << " NM, " << height_m << " m, sample " << i;
        }
      }
}

radar::RadarConfiguration without_gases(radar::RadarConfiguration configuration) {
  configuration.world.atmosphere.gases = false;
  return configuration;
}

TEST(Gases, ThatAreSwitchedOffGiveNoLossAlongARay) {
  const physics::GasPath path(without_gases({}));
  EXPECT_TRUE(path.none());
  EXPECT_EQ(path.two_way_transmission(physics::EffectiveEarth(8.0e6), 5000.0, 200000.0, 0.0), 1.0);
}

// Sweeps over ground alone, with a ship, and with rain. Each sample loses as much as the ray to it.
TEST(Gases, AttenuateGroundShipsAndRainEqually) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.pulse_smear = false;
  const physics::SweepGeometry geometry = test::geometry_north(4572.0, 80.0 * kNauticalMile_m);
  const geo::GeoPoint ahead = geo::geodesic_direct(geometry.apex, geometry.azimuth, geo::Length::nautical_miles(60.0));
  const terrain::AnalyticTerrain plain(terrain::flat(100.0));
  radar::RadarConfiguration ship = configuration, rain = configuration;
  ship.world.movers.push_back({"ship", ahead, 0.0, 0.0, 1.0e7, 5.0});
  rain.world.rain.cells.push_back({ahead, 9000.0, 50.0, 4000.0});
  const physics::EffectiveEarth earth = physics::effective_earth(configuration, geometry);
  for (const auto algorithm : {radar::Algorithm::standard, radar::Algorithm::reference})
    for (radar::RadarConfiguration with : {configuration, ship, rain}) {
      with.fidelity.algorithm = algorithm;
      const radar::RadarConfiguration no_gases = without_gases(with);
      std::vector<float> attenuated(480), clear(480);
      Beam(with).measure(geometry, plain, attenuated);
      Beam(no_gases).measure(geometry, plain, clear);
      const physics::GasPath path(with);
      for (const std::size_t i : {100U, 359U, 360U, 470U}) {
        const double distance_m = (static_cast<double>(i) + 0.5) * geometry.range.metres() / 480.0;
        ASSERT_GT(clear[i], 0.0F);
        EXPECT_NEAR(10.0 * std::log10(static_cast<double>(attenuated[i]) / static_cast<double>(clear[i])),
                    -2.0 * path.one_way_db(earth, 4572.0, distance_m, 100.0), 0.03)
            << i;
      }
    }
}

// With `standard` the loss of a line of sight is that of a point up to 71 m beside the aircraft.
void expect_one_way_loss(radar::Algorithm algorithm, double tolerance_db) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.algorithm = algorithm;
  const physics::SweepGeometry geometry = test::geometry_north(4572.0, 80.0 * kNauticalMile_m);
  const geo::GeoPoint ahead = geo::geodesic_direct(geometry.apex, geometry.azimuth, geo::Length::nautical_miles(60.0));
  radar::Jammer jammer;
  jammer.position = ahead;
  jammer.altitude_m = 500.0;
  jammer.power_w = 100.0;
  jammer.band = radar::kEveryBand;
  jammer.channels = {1};
  configuration.world.jamming.jammers.push_back(jammer);
  radar::Beacon beacon;
  beacon.position = ahead;
  beacon.altitude_m = 500.0;
  beacon.code = configuration.world.beacons.code;
  configuration.world.beacons.beacons.push_back(beacon);
  const radar::RadarConfiguration no_gases = without_gases(configuration);
  const terrain::AnalyticTerrain plain(terrain::flat(100.0));
  physics::GeometryParameters parameters(configuration);
  parameters.exact = false;  // lines of sight that are kept use the series, in `reference`, too
  const physics::EffectiveEarth earth = physics::effective_earth(parameters, geometry);
  const double expected_db = -physics::GasPath(configuration).one_way_db(earth, 4572.0, 60.0 * kNauticalMile_m, 500.0);
  const double strobe = Strobes(configuration).level(geometry, plain) / Strobes(no_gases).level(geometry, plain);
  EXPECT_NEAR(10.0 * std::log10(strobe), expected_db, tolerance_db);
  Beacons heard(configuration), clear(no_gases);
  ASSERT_FALSE(heard.replies(geometry, plain).empty());
  const double reply = heard.replies(geometry, plain)[0].power / clear.replies(geometry, plain)[0].power;
  EXPECT_NEAR(10.0 * std::log10(reply), expected_db, tolerance_db);
}

TEST(Gases, AttenuateJammersAndBeaconsOneWay) {
  expect_one_way_loss(radar::Algorithm::reference, 1e-6);
  expect_one_way_loss(radar::Algorithm::standard, 0.005);
}

// Power with gases divided by power without gases, by sample [dB]; NaN where nothing returns.
std::vector<double> loss_db(const radar::RadarConfiguration& configuration, const physics::SweepGeometry& geometry,
                            const terrain::TerrainView& ground, const scene::SceneView* scenes) {
  const std::size_t count = sample_count(configuration);
  std::vector<float> attenuated(count), clear(count);
  Beam(configuration).measure(geometry, {ground, scenes, true, {}}, attenuated);
  Beam(without_gases(configuration)).measure(geometry, {ground, scenes, true, {}}, clear);
  std::vector<double> found;
  for (std::size_t i = 0; i < count; ++i)
    found.push_back(clear[i] > 0.0F
                        ? 10.0 * std::log10(static_cast<double>(attenuated[i]) / static_cast<double>(clear[i]))
                        : std::numeric_limits<double>::quiet_NaN());
  return found;
}

// Sweeps of the HRM PPI over level ground at 100 m and at 2,500 m.
TEST(Gases, AttenuateTheHrmPpiByTheirIntegral) {
  for (const double ground_m : {100.0, 2500.0})
    for (const auto algorithm : {radar::Algorithm::standard, radar::Algorithm::reference}) {
      radar::RadarConfiguration configuration = kernel::dbs_configuration({});
      configuration.fidelity.algorithm = algorithm;
      configuration.fidelity.pulse_smear = false;
      physics::SweepGeometry geometry = test::geometry_north(6000.0, 80.0 * kNauticalMile_m);
      const terrain::AnalyticTerrain plain(terrain::flat(ground_m));
      const double radius_m = physics::effective_earth(configuration, geometry).radius_m();
      const std::vector<double> found = loss_db(configuration, geometry, plain, nullptr);
      ASSERT_EQ(found.size(), 480U);
      for (const std::size_t i : {60U, 240U, 360U, 479U}) {
        const double distance_m = (static_cast<double>(i) + 0.5) * geometry.range.metres() / 480.0;
        EXPECT_NEAR(found[i], -2.0 * test::gases_in_layers_db(configuration, radius_m, 6000.0, distance_m, ground_m),
                    0.1)
            << i << ", " << ground_m << " m";
      }
    }
}

// A hall 200 m high on ground with a gamma of -60 dB. Samples in which the hall dominates lose as much as a ray to its
// middle.
TEST(Gases, AttenuateObjectsOfScenesByTheirIntegral) {
  for (const double miles : {20.0, 60.0})
    for (const auto algorithm : {radar::Algorithm::standard, radar::Algorithm::reference}) {
      radar::RadarConfiguration configuration;
      configuration.fidelity.algorithm = algorithm;
      configuration.fidelity.pulse_smear = false;
      configuration.receiver.land_gamma_db = -60.0;
      const physics::SweepGeometry geometry = test::geometry_north(6000.0, 80.0 * kNauticalMile_m);
      const geo::GeoPoint position =
          geo::geodesic_direct(geometry.apex, geometry.azimuth, geo::Length::nautical_miles(miles));
      const auto ground = terrain::flat(300.0);
      const auto scene = test::scene_of({{0.0, 0.0, 100.0, 100.0, 200.0}}, position, 0.0, ground);
      const double radius_m = physics::effective_earth(configuration, geometry).radius_m();
      radar::RadarConfiguration no_gases = without_gases(configuration);
      std::vector<float> with(480), without(480);
      Beam(no_gases).measure(geometry, {terrain::AnalyticTerrain(ground), scene.get(), true, {}}, with);
      Beam(no_gases).measure(geometry, {terrain::AnalyticTerrain(ground), nullptr, true, {}}, without);
      const std::vector<double> found = loss_db(configuration, geometry, terrain::AnalyticTerrain(ground), scene.get());
      int hall_samples = 0;
      for (std::size_t i = 0; i < found.size(); ++i) {
        if (!(with[i] > 1000.0F * without[i])) continue;
        ++hall_samples;
        const double distance_m = (static_cast<double>(i) + 0.5) * geometry.range.metres() / 480.0;
        EXPECT_NEAR(found[i], -2.0 * test::gases_in_layers_db(configuration, radius_m, 6000.0, distance_m, 400.0), 0.1)
            << i << ", " << miles << " NM";
      }
      EXPECT_GT(hall_samples, 0);
    }
}

}  // namespace
}  // namespace yars::model::rbm
