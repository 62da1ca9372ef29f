// Ships and vehicles: position, return, and occlusion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/kernel/tick_inputs.hpp"
#include "model/physics/environment.hpp"
#include "model/rbm/beam.hpp"
#include "tests/model/physics/decibels.hpp"
#include "tests/model/physics/ground.hpp"

namespace yars::model::rbm {
namespace {

constexpr double kMoversAltitude_m = 2000.0;
constexpr double kMoversRange_m = 40000.0;
constexpr double kMoversSpacing_m = 40.0;

radar::Mover ship_at(double distance_m, double bearing_deg = 0.0) {
  radar::Mover ship;
  ship.position =
      geo::geodesic_direct(test::kMidLatitude, geo::Bearing::degrees(bearing_deg), geo::Length::metres(distance_m));
  return ship;
}

radar::RadarConfiguration with(const radar::Mover& mover) {
  radar::RadarConfiguration configuration = test::bare_configuration(1000);
  configuration.receiver.stc_exponent = 0.0;
  configuration.world.movers.push_back(mover);
  return configuration;
}

std::vector<float> power_of(const radar::RadarConfiguration& configuration, const physics::SweepGeometry& geometry,
                            const terrain::AnalyticTerrain::Height& height) {
  rbm::Beam beam(configuration);
  std::vector<float> power(1000);
  beam.measure(geometry, terrain::AnalyticTerrain(height), power);
  return power;
}

// By sample: power with the mover minus power without the mover.
std::vector<double> added_by(radar::RadarConfiguration configuration, const physics::SweepGeometry& geometry,
                             const terrain::AnalyticTerrain::Height& height = terrain::flat(0.0)) {
  const auto with_mover = power_of(configuration, geometry, height);
  configuration.world.movers.clear();
  const auto without = power_of(configuration, geometry, height);
  std::vector<double> difference(1000);
  std::transform(with_mover.begin(), with_mover.end(), without.begin(), difference.begin(),
                 [](float a, float b) { return static_cast<double>(a) - static_cast<double>(b); });
  return difference;
}

std::size_t brightest(const std::vector<double>& power) {
  return static_cast<std::size_t>(std::max_element(power.begin(), power.end()) - power.begin());
}

TEST(Movers, MoveAlongAGeodesicWithSimTime) {
  radar::Mover ship = ship_at(10000.0);
  ship.speed_mps = geo::Speed::knots(30.0).metres_per_second();
  ship.heading_deg = 45.0;
  const auto points = physics::moving_points(with(ship).world);
  EXPECT_LT(geo::geodesic_inverse(ship.position, points.at(0).position(geo::Duration())).distance.metres(), 1e-6);
  const auto path = geo::geodesic_inverse(ship.position, points.at(0).position(geo::Duration::seconds(3600.0)));
  EXPECT_NEAR(path.distance.nautical_miles(), 30.0, 1e-6);
  EXPECT_NEAR(path.azimuth_at_start.degrees(), 45.0, 1e-6);
}

TEST(Movers, ReturnOnlyInTheSampleOfTheirRange) {
  const auto power = added_by(with(ship_at(20020.0)), test::geometry_north(kMoversAltitude_m, kMoversRange_m));
  EXPECT_EQ(brightest(power), 500U);
  for (std::size_t i = 0; i < power.size(); ++i) {
    if (i != 500) {
      EXPECT_EQ(power[i], 0.0) << i;
    }
  }
}

TEST(Movers, ReturnSigmaOverTheFourthPowerOfTheRange) {
  radar::Mover ship = ship_at(20020.0);
  ship.cross_section_m2 = 5000.0;
  const physics::SweepGeometry geometry = test::geometry_north(kMoversAltitude_m, kMoversRange_m);
  const physics::Receiver receiver = physics::Receivers(with(ship)).at(geometry.range);
  const double slant_m = std::hypot(20020.0, kMoversAltitude_m - ship.height_m);
  const double expected = 5000.0 / std::pow(slant_m, 4.0) / receiver.full_scale;
  EXPECT_NEAR(added_by(with(ship), geometry)[500] / expected, 1.0, 1e-3);
}

TEST(Movers, AreTwelveDecibelsDownAtTwiceTheRange) {
  // Ships and aircraft are at one height, so that the slant range equals the ground range.
  radar::Mover near = ship_at(18000.0), far = ship_at(36000.0);
  near.height_m = far.height_m = 300.0;
  const physics::SweepGeometry geometry = test::geometry_north(300.0, kMoversRange_m);
  const auto power_at = [&](const radar::Mover& mover) {
    const auto power = added_by(with(mover), geometry);
    return power[brightest(power)];
  };
  EXPECT_NEAR(decibels(power_at(far) / power_at(near)), -12.04, 0.01);
}

TEST(Movers, FollowTheBeamPattern) {
  const physics::SweepGeometry geometry = test::geometry_north(kMoversAltitude_m, kMoversRange_m);
  const double centre = added_by(with(ship_at(20020.0)), geometry)[500];
  EXPECT_NEAR(decibels(added_by(with(ship_at(20020.0, 1.25)), geometry)[500] / centre), -6.02, 0.05);
  EXPECT_EQ(added_by(with(ship_at(20020.0, 6.0)), geometry)[500], 0.0);
}

TEST(Movers, AreAsLongAsThePulseAtTheSamePeakPower) {
  radar::RadarConfiguration configuration = with(ship_at(20020.0));
  const physics::SweepGeometry geometry = test::geometry_north(kMoversAltitude_m, kMoversRange_m);
  const double sharp = added_by(configuration, geometry)[500];
  configuration.fidelity.pulse_smear = true;
  const auto smeared = added_by(configuration, geometry);
  const double pulse_samples =
      physics::Receivers(configuration).pulse_length(geometry.range).metres() / kMoversSpacing_m;
  EXPECT_NEAR(smeared[500] / sharp, 1.0, 1e-3);
  double sum = 0.0;
  for (const double power : smeared) sum += power;
  EXPECT_NEAR(sum / sharp, pulse_samples, 0.01 * pulse_samples);
}

TEST(Movers, AreHiddenBehindAHill) {
  const physics::SweepGeometry geometry = test::geometry_north(kMoversAltitude_m, kMoversRange_m);
  const auto hill = terrain::ridge(test::axis_north(), 15000.0, 1000.0, 900.0);
  for (const double power : added_by(with(ship_at(20020.0)), geometry, hill)) EXPECT_EQ(power, 0.0);
  EXPECT_GT(added_by(with(ship_at(12020.0)), geometry, hill)[300], 0.0);
}

TEST(Movers, OutOfRangeGiveNoEchoes) {
  const radar::RadarConfiguration configuration = with(ship_at(60000.0));
  physics::Movers movers(configuration);
  const physics::SweepGeometry geometry = test::geometry_north(kMoversAltitude_m, kMoversRange_m);
  const physics::Receiver receiver = physics::Receivers(configuration).at(geometry.range);
  const terrain::AnalyticTerrain sea(terrain::flat(0.0));
  EXPECT_TRUE(movers.echoes(geometry, receiver, physics::EffectiveEarth(8.5e6), sea).empty());
}

// The traffic record has the ship's position at sim time 60 s. 30 s later, its entity returns what the configured ship
// returns at sim time 30 s.
TEST(Movers, OfTrafficReturnAsConfiguredMovers) {
  radar::Mover ship = ship_at(20020.0);
  ship.speed_mps = 10.0;
  ship.heading_deg = 300.0;
  databuffer::Traffic traffic{};
  traffic.tick = 12'000;  // 60 s
  traffic.count = 1;
  traffic.entities[0] = {ship.position.latitude_deg,
                         ship.position.longitude_deg,
                         ship.speed_mps * std::cos(geo::Angle::degrees(300.0).radians()),
                         ship.speed_mps * std::sin(geo::Angle::degrees(300.0).radians()),
                         ship.height_m,
                         ship.cross_section_m2,
                         7,
                         0};
  const terrain::AnalyticTerrain sea(terrain::flat(0.0));
  const physics::EffectiveEarth earth(8.5e6);
  physics::SweepGeometry geometry = test::geometry_north(kMoversAltitude_m, kMoversRange_m);
  physics::Movers configured(with(ship));
  physics::Movers none(test::bare_configuration(1000));
  const physics::Receiver receiver = physics::Receivers(with(ship)).at(geometry.range);
  geometry.sim_time = geo::Duration::seconds(30.0);
  const physics::Echo expected = configured.echoes(geometry, receiver, earth, sea)[0];
  geometry.sim_time = geo::Duration::seconds(30.0 + 60.0);
  const auto points = kernel::points_of(traffic);
  const auto echoes = none.echoes(geometry, receiver, earth, {sea, nullptr, true, points});
  ASSERT_EQ(echoes.size(), 1U);
  EXPECT_NEAR(echoes[0].distance_m, expected.distance_m, 1e-6);
  EXPECT_NEAR(echoes[0].power, expected.power, 1e-9 * expected.power);
}

// The search for movers in the beam is only a test before the exact one: it leaves none out.
TEST(Movers, AreFoundUpToTheEdgesOfBeamAndRange) {
  const terrain::AnalyticTerrain sea(terrain::flat(0.0));
  const physics::EffectiveEarth earth(8.5e6);
  for (const geo::GeoPoint apex : {test::kMidLatitude, geo::GeoPoint{-60.0, 179.9}, {89.99, 5.0}, {90.0, 0.0}})
    for (const double range_m : {40000.0, 590000.0})
      for (const double azimuth_deg : {0.0, 45.0, 130.0})
        for (const double beamwidths : {-2.0, 2.0}) {  // ends of point_interval()
          physics::SweepGeometry geometry = test::geometry_north(kMoversAltitude_m, range_m, apex);
          geometry.azimuth = geo::Bearing::degrees(azimuth_deg);
          radar::Mover ship;
          radar::RadarConfiguration configuration = test::bare_configuration(16);
          const double width_rad = physics::Receivers(configuration).at(geometry.range).azimuth_beamwidth_rad;
          const auto echoes = [&](double share, double further_rad) {
            ship.position = geo::geodesic_direct(
                apex, geometry.azimuth + geo::Angle::radians(share * beamwidths * width_rad + further_rad),
                geo::Length::metres(0.99999 * range_m));
            configuration.world.movers = {ship};
            physics::Movers movers(configuration);
            return movers.echoes(geometry, physics::Receivers(configuration).at(geometry.range), earth, sea).size();
          };
          EXPECT_EQ(echoes(0.999999, 0.0), 1U) << apex.latitude_deg << ", " << range_m << ", " << azimuth_deg;
          EXPECT_EQ(echoes(1.000001, 0.0), 0U);
          EXPECT_EQ(echoes(1.0, std::numbers::pi), 0U);
        }
}

TEST(Movers, OfStandardAreWithinThreeMetresOfTheGeodesic) {
  const terrain::AnalyticTerrain sea(terrain::flat(0.0));
  const physics::EffectiveEarth earth(8.5e6);
  for (const geo::GeoPoint apex : {test::kMidLatitude, geo::GeoPoint{-60.0, 179.9}, {89.99, 5.0}, {90.0, 0.0}})
    for (const double azimuth_deg : {0.0, 45.0, 130.0})
      for (const double distance_m : {30.0, 5000.0, 300000.0, 590000.0}) {
        physics::SweepGeometry geometry = test::geometry_north(kMoversAltitude_m, 592640.0, apex);
        geometry.azimuth = geo::Bearing::degrees(azimuth_deg);
        radar::Mover ship;
        ship.position =
            geo::geodesic_direct(apex, geometry.azimuth + geo::Angle::degrees(1.0), geo::Length::metres(distance_m));
        radar::RadarConfiguration configuration = with(ship);
        const physics::Receiver receiver = physics::Receivers(configuration).at(geometry.range);
        physics::Movers exact(configuration);
        configuration.fidelity.algorithm = radar::Algorithm::standard;
        physics::Movers fast(configuration);
        const auto expected = exact.echoes(geometry, receiver, earth, sea);
        const auto found = fast.echoes(geometry, receiver, earth, sea);
        ASSERT_EQ(expected.size(), 1U);
        ASSERT_EQ(found.size(), 1U);
        EXPECT_NEAR(found[0].distance_m, expected[0].distance_m, 3.0) << apex.latitude_deg << ", " << azimuth_deg;
        EXPECT_NEAR(decibels(found[0].power / expected[0].power), 0.0, 0.01) << distance_m;
      }
}

TEST(Movers, AreFoundAfterAnyTime) {
  radar::Mover ship = ship_at(20020.0);
  ship.speed_mps = 150.0;
  ship.heading_deg = 200.0;
  const radar::RadarConfiguration configuration = with(ship);
  const terrain::AnalyticTerrain sea(terrain::flat(0.0));
  physics::Movers movers(configuration);
  const physics::MovingPoint point = physics::moving_points(configuration.world).at(0);
  for (const double time_s : {0.0, 3.0, 400.0, 2.0, 40000.0, 40000.01, -5.0}) {
    physics::SweepGeometry geometry = test::geometry_north(kMoversAltitude_m, kMoversRange_m);
    geometry.sim_time = geo::Duration::seconds(time_s);
    geometry.apex = geo::geodesic_direct(point.position(geometry.sim_time), geo::Bearing::degrees(180.0),
                                         geo::Length::metres(30000.0));
    const physics::Receiver receiver = physics::Receivers(configuration).at(geometry.range);
    EXPECT_EQ(movers.echoes(geometry, receiver, physics::EffectiveEarth(8.5e6), sea).size(), 1U) << time_s;
  }
}

// Power of the echo of a mover in a scan.
double echo_in_scan(const radar::RadarConfiguration& configuration, std::uint32_t scan, double azimuth_deg = 0.0) {
  const terrain::AnalyticTerrain sea(terrain::flat(0.0));
  physics::Environment environment(sea);
  environment.scan = scan;
  physics::SweepGeometry geometry = test::geometry_north(kMoversAltitude_m, kMoversRange_m);
  geometry.azimuth = geo::Bearing::degrees(azimuth_deg);
  physics::Movers movers(configuration);
  return movers
      .echoes(geometry, physics::Receivers(configuration).at(geometry.range), physics::EffectiveEarth(8.5e6),
              environment)
      .front()
      .power;
}

TEST(Movers, FluctuateFromScanToScanWithNoiseAlone) {
  radar::RadarConfiguration configuration = with(ship_at(20020.0));
  const double steady = echo_in_scan(configuration, 1);
  EXPECT_EQ(echo_in_scan(configuration, 2), steady);
  configuration.fidelity.noise = true;
  const double first = echo_in_scan(configuration, 1), second = echo_in_scan(configuration, 2);
  EXPECT_NE(first, steady);
  EXPECT_NE(first, second);
  EXPECT_EQ(echo_in_scan(configuration, 1), first);
  EXPECT_NEAR(echo_in_scan(configuration, 1, 0.5) / first, echo_in_scan(with(ship_at(20020.0)), 1, 0.5) / steady, 1e-9)
      << "a target keeps its echo during a scan";
  ++configuration.seed;
  EXPECT_NE(echo_in_scan(configuration, 1), first);
  configuration.world.movers[0].echo = radar::TargetEcho::steady;
  EXPECT_EQ(echo_in_scan(configuration, 1), steady);
  configuration.world.movers[0].echo = radar::TargetEcho::swerling1;
  configuration.fidelity.algorithm = radar::Algorithm::report_1996;
  EXPECT_EQ(echo_in_scan(configuration, 1), echo_in_scan(configuration, 2)) << "in the picture of 1996";
}

TEST(Movers, OfDifferentNumbersFluctuateIndependently) {
  using physics::swerling_factor;
  double products = 0.0;
  constexpr std::uint32_t kScans = 10'000;
  for (std::uint32_t scan = 1; scan <= kScans; ++scan)
    products += swerling_factor(radar::TargetEcho::swerling1, 1, scan, 0) *
                swerling_factor(radar::TargetEcho::swerling1, 1, scan, 1);
  EXPECT_NEAR(products / kScans, 1.0, 0.05);
}

TEST(NearestSample, HasTheCentreNearestToTheDistance) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> centres{nan, nan, 25.0, 35.0, 45.0};
  EXPECT_EQ(physics::nearest_sample(centres, 1.0), 2U);
  EXPECT_EQ(physics::nearest_sample(centres, 29.0), 2U);
  EXPECT_EQ(physics::nearest_sample(centres, 31.0), 3U);
  EXPECT_EQ(physics::nearest_sample(centres, 49.0), 4U);
  EXPECT_EQ(physics::nearest_sample(std::vector<double>{nan, nan}, 3.0), 2U);
}

}  // namespace
}  // namespace yars::model::rbm
