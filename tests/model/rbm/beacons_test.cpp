// Beacons: position, brightness and width of their replies, interrogation, occlusion, and the BCN mode.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "model/rbm/emitters.hpp"
#include "tests/model/kernel/cockpit.hpp"
#include "tests/model/physics/ground.hpp"

namespace yars::model::rbm {
namespace {

constexpr double kBeaconsAltitude_m = 3000.0;
constexpr double kBeaconsRange_m = 74080.0;
constexpr double kRangePerMicrosecond_m = 149.896229;  // [m] half the speed of light times 1 us

radar::Beacon beacon_north(double distance_m) {
  radar::Beacon beacon;
  beacon.position = geo::geodesic_direct(test::kMidLatitude, geo::Bearing(), geo::Length::metres(distance_m));
  beacon.altitude_m = 10.0;
  return beacon;
}

radar::RadarConfiguration with(const radar::Beacon& beacon) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.earth = radar::EarthModel::flat;
  configuration.fidelity.beam = radar::BeamPattern::gaussian;
  configuration.world.atmosphere.gases = false;
  configuration.world.beacons.beacons.push_back(beacon);
  return configuration;
}

physics::SweepGeometry geometry_off(double off_deg) {
  physics::SweepGeometry geometry = test::geometry_north(kBeaconsAltitude_m, kBeaconsRange_m);
  geometry.azimuth = geo::Bearing::degrees(off_deg);
  return geometry;
}

std::vector<Reply> replies(const radar::RadarConfiguration& configuration,
                           const physics::SweepGeometry& geometry = geometry_off(0.0),
                           const terrain::AnalyticTerrain::Height& height = terrain::flat(0.0)) {
  Beacons beacons(configuration);
  const auto found = beacons.replies(geometry, terrain::AnalyticTerrain(height));
  return {found.begin(), found.end()};
}

// Middle index of each run of samples with power.
std::vector<double> arcs(const std::vector<float>& power) {
  std::vector<double> middles;
  for (std::size_t i = 0; i < power.size(); ++i) {
    if (!(power[i] > 0.0F) || (i > 0 && power[i - 1] > 0.0F)) continue;
    std::size_t end = i;
    while (end < power.size() && power[end] > 0.0F) ++end;
    middles.push_back(0.5 * static_cast<double>(i + end - 1));
  }
  return middles;
}

TEST(Beacons, ReplyFartherThanTheirPositionByDelayAndSpacing) {
  radar::Beacon beacon = beacon_north(30000.0);
  beacon.delay_us = 5.0;
  beacon.spacing_us = 12.0;
  beacon.replies = 4;
  const auto found = replies(with(beacon));
  ASSERT_EQ(found.size(), 4U);
  const double height_m = kBeaconsAltitude_m - 10.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double slant_m =
        std::hypot(30000.0, height_m) + (5.0 + 12.0 * static_cast<double>(i)) * kRangePerMicrosecond_m;
    EXPECT_NEAR(found[i].slant_range_m, slant_m, 0.1);
    EXPECT_NEAR(found[i].distance_m, std::sqrt(slant_m * slant_m - height_m * height_m), 0.1);
  }
}

TEST(Beacons, ReplyWithThePowerOfTheOneWayRadarEquation) {
  const radar::RadarConfiguration configuration = with(beacon_north(50000.0));
  const physics::Receiver receiver = physics::Receivers(configuration).at(geo::Length::metres(kBeaconsRange_m));
  const double slant_m = std::hypot(50000.0, kBeaconsAltitude_m - 10.0);
  const double below = std::atan2(kBeaconsAltitude_m - 10.0, 50000.0) / receiver.elevation_beamwidth_rad;
  const double one_way = std::exp(-0.5 * physics::kTwoWayExponent * below * below);
  const double expected =
      4.0 * std::numbers::pi * 100.0 / std::pow(10.0, 7.2) * one_way / (slant_m * slant_m) / receiver.full_scale;
  const auto found = replies(configuration);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].power / expected, 1.0, 1e-6);
  EXPECT_EQ(found[0].power, found[1].power);
}

TEST(Beacons, ReplyWithinHalfABeamwidthToTheirCode) {
  radar::RadarConfiguration configuration = with(beacon_north(30000.0));
  for (const double off_deg : {-1.2, 0.0, 1.2}) EXPECT_EQ(replies(configuration, geometry_off(off_deg)).size(), 2U);
  for (const double off_deg : {-1.3, 1.3, 90.0, 180.0})
    EXPECT_TRUE(replies(configuration, geometry_off(off_deg)).empty());
  configuration.world.beacons.code = 2;
  EXPECT_TRUE(replies(configuration).empty());
  configuration.world.beacons.beacons[0].code = 2;
  EXPECT_EQ(replies(configuration).size(), 2U);
}

TEST(Beacons, AreHiddenBehindARidgeAndBeyondTheRange) {
  const radar::RadarConfiguration configuration = with(beacon_north(50000.0));
  EXPECT_EQ(replies(configuration).size(), 2U);
  const auto ridge = terrain::ridge(test::axis_north(), 40000.0, 2000.0, 900.0);
  EXPECT_TRUE(replies(configuration, geometry_off(0.0), ridge).empty());
  EXPECT_TRUE(replies(with(beacon_north(74100.0))).empty());
}

TEST(Beacons, WithoutAltitudeStandOnAMastOfTenMetres) {
  radar::Beacon mast = beacon_north(30000.0);
  mast.altitude_m = radar::kNotGiven;
  radar::Beacon given = mast;
  given.altitude_m = 310.0;
  EXPECT_EQ(replies(with(mast), geometry_off(0.0), terrain::flat(300.0))[0].slant_range_m,
            replies(with(given), geometry_off(0.0), terrain::flat(300.0))[0].slant_range_m);
}

TEST(Beacons, MakeArcsOfAPulsesLengthAtTheirDistances) {
  for (const bool slant : {false, true}) {
    radar::Beacon beacon = beacon_north(30000.0);
    beacon.replies = 3;
    radar::RadarConfiguration configuration = with(beacon);
    configuration.fidelity.slant_range = slant;
    std::vector<float> power(480, 7.0F);
    Beacons(configuration).measure(geometry_off(0.0), terrain::AnalyticTerrain(terrain::flat(0.0)), power);
    const auto middles = arcs(power);
    ASSERT_EQ(middles.size(), 3U);
    const double spacing_m = kBeaconsRange_m / 480.0;
    const auto found = replies(configuration);
    for (std::size_t i = 0; i < 3; ++i) {
      const double expected_m = slant ? found[i].slant_range_m : found[i].distance_m;
      // Tolerance in slant range: samples are at ground level, but the beacon is 10 m above.
      EXPECT_NEAR((middles[i] + 0.5) * spacing_m, expected_m, 0.51 * spacing_m) << slant;
      EXPECT_NEAR(power[static_cast<std::size_t>(middles[i])], found[i].power, 1e-6 * found[i].power);
    }
  }
}

TEST(Beacons, ShowOnlyTheRepliesWithinTheRange) {
  std::vector<float> power(480, 0.0F);
  Beacons(with(beacon_north(73000.0))).measure(geometry_off(0.0), terrain::AnalyticTerrain(terrain::flat(0.0)), power);
  EXPECT_EQ(arcs(power).size(), 1U);
}

// A radar in mode BCN with a beacon 20 NM ahead.
class BeaconMode : public testing::Test {
 protected:
  static radar::RadarConfiguration configuration() {
    radar::RadarConfiguration made;
    made.fidelity.noise = false;
    radar::Beacon beacon;
    beacon.position =
        geo::geodesic_direct({37.0, -122.0}, geo::Bearing::degrees(45.0), geo::Length::nautical_miles(20.0));
    made.world.beacons.beacons.push_back(beacon);
    return made;
  }
  class BeaconCockpit : public test::Cockpit {
   public:
    BeaconCockpit() : Cockpit(configuration()) { tick.command.mode = static_cast<std::uint8_t>(radar::Mode::beacon); }
  };
  // Brightest sample of each sweep of the next complete scan.
  static std::vector<int> brightest(test::Cockpit& cockpit) {
    std::vector<int> peaks;
    if (!cockpit.run_until(test::is_scan_end)) return peaks;
    for (const databuffer::Sweep& sweep : cockpit.run(200))
      peaks.push_back(*std::max_element(sweep.video, sweep.video + sweep.samples));
    return peaks;
  }
  static int lit(const std::vector<int>& peaks, int above) {
    return static_cast<int>(std::count_if(peaks.begin(), peaks.end(), [above](int peak) { return peak > above; }));
  }
};

TEST_F(BeaconMode, ShowsOnlyTheBeaconOneBeamwidthWide) {
  BeaconCockpit cockpit;
  EXPECT_TRUE(cockpit.kernel.need(cockpit.tick).ground) << "terrain may hide the beacon";
  const auto peaks = brightest(cockpit);
  ASSERT_EQ(peaks.size(), 182U);
  const int noise = *std::min_element(peaks.begin(), peaks.end());
  // 2.5 degrees are 4.55 sweeps of 0.55 degrees each.
  EXPECT_GE(lit(peaks, noise + 20), 4);
  EXPECT_LE(lit(peaks, noise + 20), 5);
}

TEST_F(BeaconMode, GainChangesTheBrightness) {
  BeaconCockpit cockpit;
  const auto full = brightest(cockpit);
  cockpit.tick.command.gain = 0;
  const auto least = brightest(cockpit);
  ASSERT_FALSE(full.empty() || least.empty());
  EXPECT_LT(*std::max_element(least.begin(), least.end()), *std::max_element(full.begin(), full.end()) - 50);
}

TEST_F(BeaconMode, SniffInterrogatesNoBeacon) {
  BeaconCockpit cockpit;
  const auto answered = brightest(cockpit);
  cockpit.set_flag(databuffer::kSniff, true);
  brightest(cockpit);
  const auto silent = brightest(cockpit);
  ASSERT_FALSE(answered.empty() || silent.empty());
  EXPECT_GT(lit(answered, 60), 0);
  EXPECT_EQ(lit(silent, 60), 0);
}

TEST_F(BeaconMode, FreezesAtTheEndOfTheScan) {
  BeaconCockpit cockpit;
  ASSERT_TRUE(cockpit.run_until(test::is_scan_start));
  cockpit.run(20);
  cockpit.set_flag(databuffer::kFreeze, true);
  EXPECT_EQ(cockpit.run(400).size(), 182U - 21U);
  EXPECT_NE(cockpit.status().flags & databuffer::kModelFrozen, 0U);
}

}  // namespace
}  // namespace yars::model::rbm
