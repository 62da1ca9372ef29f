// Jammers: level, pattern, bands and channels, occlusion, and their strobes in SNIFF.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "model/physics/receiver.hpp"
#include "model/rbm/emitters.hpp"
#include "tests/model/kernel/cockpit.hpp"
#include "tests/model/physics/decibels.hpp"
#include "tests/model/physics/ground.hpp"

namespace yars::model::rbm {
namespace {

constexpr double kStrobesAltitude_m = 3000.0;
constexpr double kStrobesRange_m = 74080.0;

radar::Jammer jammer_north(double distance_m, double altitude_m = kStrobesAltitude_m) {
  radar::Jammer jammer;
  jammer.position = geo::geodesic_direct(test::kMidLatitude, geo::Bearing(), geo::Length::metres(distance_m));
  jammer.altitude_m = altitude_m;
  return jammer;
}

radar::RadarConfiguration jammed_by(const radar::Jammer& jammer) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.beam = radar::BeamPattern::gaussian;
  configuration.world.atmosphere.gases = false;
  configuration.world.jamming.jammers.push_back(jammer);
  return configuration;
}

physics::SweepGeometry geometry_off(double off_deg) {
  physics::SweepGeometry geometry = test::geometry_north(kStrobesAltitude_m, kStrobesRange_m);
  geometry.azimuth = geo::Bearing::degrees(off_deg);
  return geometry;
}

double level(const radar::RadarConfiguration& configuration, const physics::SweepGeometry& geometry,
             const terrain::AnalyticTerrain::Height& height = terrain::flat(0.0)) {
  return Strobes(configuration).level(geometry, terrain::AnalyticTerrain(height));
}

TEST(Strobes, HaveThePowerOfTheOneWayRadarEquation) {
  radar::RadarConfiguration configuration = jammed_by(jammer_north(50000.0));
  configuration.fidelity.earth = radar::EarthModel::flat;
  const physics::Receiver receiver = physics::Receivers(configuration).at(geo::Length::metres(kStrobesRange_m));
  const double radar_w = std::pow(10.0, 7.2);
  const double expected = 4.0 * std::numbers::pi * 10.0 / radar_w / (50000.0 * 50000.0) / receiver.full_scale;
  EXPECT_NEAR(level(configuration, geometry_off(0.0)) / expected, 1.0, 1e-6);
}

TEST(Strobes, FallSixDecibelsAtTwiceTheRange) {
  radar::RadarConfiguration near = jammed_by(jammer_north(40000.0));
  radar::RadarConfiguration far = jammed_by(jammer_north(80000.0));
  near.fidelity.earth = far.fidelity.earth = radar::EarthModel::flat;
  EXPECT_NEAR(decibels(level(far, geometry_off(0.0)) / level(near, geometry_off(0.0))), -6.02, 0.005);
}

TEST(Strobes, FollowTheOneWayPatternAndHaveSidelobesOfConstantLevel) {
  const radar::RadarConfiguration configuration = jammed_by(jammer_north(50000.0));
  const double centre = level(configuration, geometry_off(0.0));
  EXPECT_NEAR(decibels(level(configuration, geometry_off(1.25)) / centre), -3.01, 0.02);
  EXPECT_NEAR(decibels(level(configuration, geometry_off(-1.25)) / centre), -3.01, 0.02);
  // The sidelobe level is relative to the beam's centre. In elevation, the jammer is slightly off this centre.
  EXPECT_NEAR(decibels(level(configuration, geometry_off(90.0)) / centre), -35.0, 0.3);
  EXPECT_EQ(level(configuration, geometry_off(90.0)), level(configuration, geometry_off(45.0)));
}

TEST(Strobes, AreOnlyOnTheJammedBandAndChannels) {
  radar::Jammer jammer = jammer_north(50000.0);
  jammer.band = 1;
  jammer.channels = {3, 4};
  const radar::RadarConfiguration configuration = jammed_by(jammer);
  for (std::uint8_t band = 0; band < 5; ++band) {
    for (std::uint8_t channel = 1; channel <= 8; ++channel) {
      physics::SweepGeometry geometry = geometry_off(0.0);
      geometry.band = band;
      geometry.channel = channel;
      const bool jammed = band == 1 && (channel == 3 || channel == 4);
      EXPECT_EQ(level(configuration, geometry) > 0.0, jammed) << int(band) << ", " << int(channel);
    }
  }
}

TEST(Strobes, AreHiddenBehindARidgeAndBelowTheHorizon) {
  const radar::RadarConfiguration low = jammed_by(jammer_north(50000.0, 20.0));
  EXPECT_GT(level(low, geometry_off(0.0)), 0.0);
  EXPECT_EQ(level(low, geometry_off(0.0), terrain::ridge(test::axis_north(), 40000.0, 2000.0, 900.0)), 0.0);
  physics::SweepGeometry skimming = geometry_off(0.0);
  skimming.altitude = geo::AltitudeMsl::metres(30.0);
  // On the 4/3 earth the horizon is 22.6 km away for 30 m, and 18.4 km for 20 m: together 41 km.
  EXPECT_EQ(level(low, skimming), 0.0);
  EXPECT_GT(level(jammed_by(jammer_north(40000.0, 20.0)), skimming), 0.0);
  EXPECT_EQ(level(jammed_by(jammer_north(42500.0, 20.0)), skimming), 0.0);
}

TEST(Strobes, OfAJammerWithoutAltitudeComeFromAMastOfTenMetres) {
  const radar::RadarConfiguration given = jammed_by(jammer_north(50000.0, 310.0));
  const radar::RadarConfiguration mast = jammed_by(jammer_north(50000.0, radar::kNotGiven));
  EXPECT_EQ(level(mast, geometry_off(0.0), terrain::flat(300.0)),
            level(given, geometry_off(0.0), terrain::flat(300.0)));
}

TEST(Strobes, AreEquallyBrightInEverySample) {
  radar::RadarConfiguration configuration = test::bare_configuration(64);
  configuration.receiver.stc_exponent = 0.0;
  Reference reference(configuration);
  const std::vector<float> nothing(64, 0.0F);
  std::vector<std::uint8_t> quiet(64), jammed(64);
  reference.form_video({nothing, nothing, nothing}, geo::Length::metres(kStrobesRange_m), 3, {}, quiet);
  reference.form_video({nothing, nothing, nothing, 0.1}, geo::Length::metres(kStrobesRange_m), 3, {}, jammed);
  for (std::size_t i = 0; i < jammed.size(); ++i) {
    EXPECT_EQ(jammed[i], jammed[0]);
    EXPECT_NEAR(jammed[i], 255.0 * (1.0 - 10.0 / 45.0), 1.0);
    EXPECT_LT(quiet[i], jammed[i]);
  }
}

// Sixteen jammers around a position, from 300 m to 580 km away.
radar::RadarConfiguration jammed_from_all_sides(geo::GeoPoint middle) {
  radar::RadarConfiguration configuration;
  for (int i = 0; i < 16; ++i) {
    radar::Jammer jammer;
    jammer.position =
        geo::geodesic_direct(middle, geo::Bearing::degrees(23.0 * i), geo::Length::metres(300.0 * std::pow(1.65, i)));
    jammer.altitude_m = 9000.0 + 100.0 * i;
    jammer.power_w = 0.01 * std::pow(2.7, i);
    configuration.world.jamming.jammers.push_back(jammer);
  }
  return configuration;
}

TEST(Strobes, OfStandardAreThoseOfTheReferenceWithinAHundredthOfADecibel) {
  const terrain::AnalyticTerrain hills(terrain::sine_hills(test::axis_north(), 600.0, 12000.0));
  for (const geo::GeoPoint middle : {test::kMidLatitude, geo::GeoPoint{-17.0, 179.999}, {88.0, 30.0}, {89.9999, 0.0}}) {
    radar::RadarConfiguration configuration = jammed_from_all_sides(middle);
    Strobes standard(configuration);
    configuration.fidelity.algorithm = radar::Algorithm::reference;
    Strobes reference(configuration);
    for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += 22.6) {
      physics::SweepGeometry geometry = test::geometry_north(8000.0 + azimuth_deg, kStrobesRange_m, middle);
      geometry.apex = geo::geodesic_direct(middle, geo::Bearing::degrees(50.0), geo::Length::metres(azimuth_deg));
      geometry.azimuth = geo::Bearing::degrees(azimuth_deg);
      const double exact = reference.level(geometry, hills);
      ASSERT_GT(exact, 0.0);
      EXPECT_NEAR(decibels(standard.level(geometry, hills) / exact), 0.0, 0.01)
          << middle.latitude_deg << ", " << azimuth_deg;
    }
  }
}

TEST(Strobes, DoNotDependOnWhereTheAircraftWasBefore) {
  const terrain::AnalyticTerrain hills(terrain::sine_hills(test::axis_north(), 600.0, 12000.0));
  radar::RadarConfiguration configuration = jammed_from_all_sides(test::kMidLatitude);
  for (radar::Jammer& jammer : configuration.world.jamming.jammers) jammer.altitude_m = radar::kNotGiven;
  Strobes flown(configuration);
  for (int i = 0; i < 80; ++i) {
    physics::SweepGeometry geometry = test::geometry_north(700.0 + 0.3 * i, kStrobesRange_m);
    geometry.apex.latitude_deg += 2e-5 * (i % 60);
    geometry.azimuth = geo::Bearing::degrees(7.0 * i);
    ASSERT_EQ(flown.level(geometry, hills), Strobes(configuration).level(geometry, hills)) << i;
  }
  // Another terrain, at the same position.
  const terrain::AnalyticTerrain ridge(terrain::ridge(test::axis_north(), 2000.0, 1000.0, 3000.0));
  const physics::SweepGeometry geometry = test::geometry_north(700.0, kStrobesRange_m);
  EXPECT_LT(flown.level(geometry, ridge), flown.level(geometry, hills));
}

double mean_video(const databuffer::Sweep& sweep) {
  return std::accumulate(sweep.video, sweep.video + sweep.samples, 0.0) / sweep.samples;
}

// Mean video of the brightest and of the dimmest sweep of a scan in SNIFF; left edge [deg] of the brightest.
struct Extremes {
  double brightest = 0.0, dimmest = 255.0, brightest_deg = 0.0;
};

Extremes extremes_in_sniff(std::uint8_t channel) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.algorithm = radar::Algorithm::reference;
  configuration.fidelity.samples = 64;
  radar::Jammer jammer;
  jammer.channels = {5};
  jammer.power_w = 1.0;
  jammer.position = geo::geodesic_direct({37.0, -122.0}, geo::Bearing::degrees(60.0), geo::Length::metres(60000.0));
  configuration.world.jamming.jammers.push_back(jammer);
  test::Cockpit cockpit(configuration);
  cockpit.tick.command.channel = channel;
  cockpit.set_flag(databuffer::kSniff, true);
  EXPECT_TRUE(cockpit.run_until(test::is_scan_end));
  Extremes found;
  for (const databuffer::Sweep& sweep : cockpit.run(200)) {
    EXPECT_NE(sweep.flags & databuffer::kSweepNoiseOnly, 0U);
    const double mean = mean_video(sweep);
    if (mean > found.brightest) {
      found.brightest = mean;
      found.brightest_deg = sweep.azimuth_left_deg;
    }
    found.dimmest = std::min(found.dimmest, mean);
  }
  return found;
}

TEST(Sniff, ShowsAStrobeAtTheJammersAzimuthOnItsChannel) {
  const Extremes jammed = extremes_in_sniff(5);
  EXPECT_GT(jammed.brightest, jammed.dimmest + 40.0);
  EXPECT_NEAR(jammed.brightest_deg, 60.0, 1.5);
  const Extremes unjammed = extremes_in_sniff(4);
  EXPECT_LT(unjammed.brightest, unjammed.dimmest + 40.0);
}

}  // namespace
}  // namespace yars::model::rbm
