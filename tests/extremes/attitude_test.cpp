// Antenna and airframe at the limits of their angles. The antenna is stabilized in space; its gimbal limits it to
// +/- 60 degrees from the nose in azimuth and in elevation. Directions beyond the gimbal limit give blank sweeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/extremes/islands.hpp"
#include "tests/model/kernel/cockpit.hpp"

namespace yars::model {
namespace {

using test::Cockpit;
using test::geometry_from;
using test::is_scan_start;
using test::seen;

// The sweeps of 0.75 s over hills with this attitude, from a scan's start on, after the antenna has reached its
// commanded elevation.
std::vector<databuffer::Sweep> scan_of(const radar::RadarConfiguration& configuration, double pitch_deg,
                                       double roll_deg, double elevation_deg, double heading_deg = 45.0) {
  Cockpit cockpit(configuration, terrain::sine_hills(test::axis_north(), 600.0, 12000.0));
  cockpit.tick.ownship.heading_deg = heading_deg;
  cockpit.tick.ownship.pitch_deg = pitch_deg;
  cockpit.tick.ownship.roll_deg = roll_deg;
  cockpit.tick.ownship.velocity_north_mps = cockpit.tick.ownship.velocity_east_mps = 0.0;
  cockpit.tick.command.antenna_elevation_deg = elevation_deg;
  cockpit.run(400);
  EXPECT_TRUE(cockpit.run_until(is_scan_start));
  EXPECT_NEAR(cockpit.status().antenna_elevation_deg, elevation_deg, 0.1);
  return cockpit.run(150);
}

bool is_blank(const databuffer::Sweep& sweep) {
  return (sweep.flags & databuffer::kSweepBlank) != 0U;
}

void expect_all_blank_and_black(const std::vector<databuffer::Sweep>& sweeps) {
  ASSERT_FALSE(sweeps.empty());
  for (const auto& sweep : sweeps) {
    ASSERT_TRUE(is_blank(sweep));
    ASSERT_TRUE(std::all_of(sweep.video, sweep.video + sweep.samples, [](std::uint8_t level) { return level == 0; }));
  }
}

void expect_none_blank(const std::vector<databuffer::Sweep>& sweeps) {
  ASSERT_FALSE(sweeps.empty());
  for (const auto& sweep : sweeps) ASSERT_FALSE(is_blank(sweep));
}

TEST(ExtremeAttitudes, AtSixtyDegreesDownAHardBeamLightsOnlyTheGroundBetweenItsEdges) {
  // Flat earth: the edges of a beam of 2.5 degrees meet the ground at H / tan(61.25 deg) and H / tan(58.75 deg). H is
  // the height above ground.
  constexpr double kHeight_m = 8000.0, kRange_m = 10000.0;
  const double near_m = kHeight_m / std::tan(61.25 * geo::kRadiansPerDegree);
  const double far_m = kHeight_m / std::tan(58.75 * geo::kRadiansPerDegree);
  const terrain::AnalyticTerrain plain(terrain::flat(100.0));
  test::for_each_algorithm(1000, [&](radar::RadarConfiguration& configuration) {
    configuration.fidelity.earth = radar::EarthModel::flat;
    configuration.antenna.elevation_beamwidth_deg = 2.5;
    physics::SweepGeometry geometry = geometry_from(test::kMidLatitude, 0.0, 100.0 + kHeight_m, kRange_m);
    geometry.elevation = geo::Angle::degrees(-60.0);
    test::expect_lit_between(seen(configuration, geometry, plain), kRange_m, near_m, far_m);
  });
}

TEST(ExtremeAttitudes, AtSixtyDegreesUpAHardBeamSeesNoGround) {
  test::for_each_algorithm(1000, [&](radar::RadarConfiguration& configuration) {
    configuration.antenna.elevation_beamwidth_deg = 2.5;
    physics::SweepGeometry geometry = geometry_from(test::kMidLatitude, 0.0, 8000.0, 40000.0);
    geometry.elevation = geo::Angle::degrees(60.0);
    EXPECT_TRUE(test::is_dark(seen(configuration, geometry, terrain::AnalyticTerrain(terrain::flat(100.0)))));
  });
}

TEST(ExtremeAttitudes, EveryBeamGivesFinitePowerFromSixtyDegreesDownToSixtyUp) {
  const terrain::AnalyticTerrain hills(terrain::sine_hills(test::axis_north(), 600.0, 12000.0));
  test::for_each_algorithm_and_beam(240, [&](radar::RadarConfiguration& configuration) {
    configuration.antenna.elevation_beamwidth_deg = 2.5;
    for (const double elevation_deg : {-60.0, -30.0, -1.25, -0.0, 0.0, 1.25, 60.0}) {
      physics::SweepGeometry geometry = geometry_from(test::kMidLatitude, 20.0, 3000.0, 40000.0);
      geometry.elevation = geo::Angle::degrees(elevation_deg);
      seen(configuration, geometry, hills);  // expects finite, non-negative power
    }
  });
}

TEST(ExtremeAttitudes, InLevelFlightTheGimbalAllowsSixtyDegreesUpAndDown) {
  test::for_each_algorithm(64, [&](const radar::RadarConfiguration& configuration) {
    expect_none_blank(scan_of(configuration, 0.0, 0.0, 60.0));
    expect_none_blank(scan_of(configuration, 0.0, 0.0, -60.0));
  });
}

TEST(ExtremeAttitudes, ThreeDegreesOfPitchBlankTheMiddleOfAScanAtSixtyDegrees) {
  // Straight ahead the antenna is 63 degrees from the nose in elevation. The ground track is the heading, 45 degrees.
  for (const int sign : {-1, 1}) {
    const auto sweeps = scan_of(test::bare_configuration(64), -3.0 * sign, 0.0, 60.0 * sign);
    ASSERT_FALSE(sweeps.empty());
    for (const auto& sweep : sweeps) {
      if (std::abs(sweep.azimuth_left_deg - 45.0) > 1.0) continue;
      EXPECT_TRUE(is_blank(sweep)) << sign;
    }
  }
}

TEST(ExtremeAttitudes, WithTheNoseStraightUpOrDownScansNearTheHorizonAreBlank) {
  // In every azimuth the horizon is 90 degrees from the nose.
  test::for_each_algorithm(64, [&](const radar::RadarConfiguration& configuration) {
    for (const double pitch_deg : {90.0, -90.0})
      for (const double elevation_deg : {-4.0, 0.0, 4.0})
        expect_all_blank_and_black(scan_of(configuration, pitch_deg, 0.0, elevation_deg));
  });
}

// The antenna is 30 degrees from the nose in the whole scan.
TEST(ExtremeAttitudes, WithTheNoseStraightUpOrDownAScanAtSixtyDegreesThereIsNotBlank) {
  expect_none_blank(scan_of(test::bare_configuration(64), 90.0, 0.0, 60.0));
  expect_none_blank(scan_of(test::bare_configuration(64), -90.0, 0.0, -60.0));
}

TEST(ExtremeAttitudes, UpsideDownTheSweepsEqualThoseOfLevelFlightBitForBit) {
  // The antenna is stabilized in space, and the gimbal limits are symmetric.
  test::for_each_algorithm_and_beam(64, [&](const radar::RadarConfiguration& configuration) {
    const bool slow = configuration.fidelity.algorithm == radar::Algorithm::reference;
    if (slow && configuration.fidelity.beam != radar::BeamPattern::mapping) return;
    const auto level = scan_of(configuration, 0.0, 0.0, -4.0);
    for (const double roll_deg : {180.0, -180.0}) {
      const auto rolled = scan_of(configuration, 0.0, roll_deg, -4.0);
      ASSERT_EQ(rolled.size(), level.size());
      for (std::size_t i = 0; i < level.size(); ++i) {
        ASSERT_EQ(rolled[i].hash, level[i].hash) << i;
        ASSERT_EQ(rolled[i].flags, level[i].flags) << i;
      }
    }
  });
}

TEST(ExtremeAttitudes, HeadingsOf0And360GiveTheSameSweepsBitForBit) {
  test::for_each_algorithm(128, [&](const radar::RadarConfiguration& configuration) {
    const auto zero = scan_of(configuration, 0.0, 0.0, -4.0, 0.0);
    const auto full_circle = scan_of(configuration, 0.0, 0.0, -4.0, 360.0);
    ASSERT_EQ(zero.size(), full_circle.size());
    for (std::size_t i = 0; i < zero.size(); ++i) ASSERT_EQ(zero[i].hash, full_circle[i].hash) << i;
  });
}

TEST(ExtremeAttitudes, WhileTheHeadingSwingsThroughNorthAnIslandDueNorthStaysInTheSweepsAcrossNorth) {
  constexpr double kDistance_m = 37040.0, kRadius_m = 2000.0;  // distance: half of the range
  const auto north = geo::geodesic_direct({37.0, -122.0}, geo::Bearing(), geo::Length::metres(kDistance_m));
  const auto island = [north](geo::GeoPoint position) {
    return geo::geodesic_inverse(north, position).distance.metres() < kRadius_m ? test::kIslandHeight_m : test::kVoid_m;
  };
  test::for_each_algorithm(100, [&](radar::RadarConfiguration& configuration) {
    configuration.antenna.elevation_beamwidth_deg = 180.0;
    configuration.receiver.noise_floor_db = -80.0;  // [dB] so low that weak returns are not black
    Cockpit cockpit(configuration, island);
    cockpit.tick.command.antenna_elevation_deg = 0.0;
    cockpit.tick.ownship.velocity_north_mps = cockpit.tick.ownship.velocity_east_mps = 0.0;
    int found = 0;
    for (int tick = 0; tick < 1200; ++tick) {
      // 10 deg/s from 354 deg through north to 6 deg and back, 1.2 s each way.
      const double swing = std::abs(tick % 480 - 240) / 240.0;
      cockpit.tick.ownship.heading_deg = std::fmod(354.0 + 12.0 * swing, 360.0);
      const auto* sweep = cockpit.step();
      if (sweep == nullptr || is_blank(*sweep)) continue;
      ASSERT_LT(std::fmod(sweep->azimuth_right_deg - sweep->azimuth_left_deg + 360.0, 360.0), 2.0);
      // A wedge contains north if its left edge is west of north and its right edge is east of north.
      const bool contains_north = sweep->azimuth_left_deg > 300.0 && sweep->azimuth_right_deg < 60.0;
      const double off_deg = std::abs(geo::wrapped_degrees(sweep->azimuth_left_deg));
      const bool lit = std::any_of(sweep->video, sweep->video + sweep->samples, [](auto level) { return level > 0; });
      // The island is 6.2 degrees wide.
      if (contains_north) {
        ++found;
        EXPECT_TRUE(lit) << sweep->azimuth_left_deg;
        EXPECT_GT(sweep->video[50], 0) << sweep->azimuth_left_deg;
      } else if (off_deg > 6.0) {
        EXPECT_FALSE(lit) << sweep->azimuth_left_deg;
      }
    }
    EXPECT_GE(found, 4);
  });
}

}  // namespace
}  // namespace yars::model
