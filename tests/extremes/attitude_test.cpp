// Antenna and airframe at the limits of their angles. The antenna is stabilized in space; a gimbal of +/- 60 degrees
// limits its reach.
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

// One scan of the hills with this attitude, once the antenna is where it is commanded.
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

TEST(ExtremeAttitudes, AtSixtyDegreesDownAHardBeamLightsTheGroundWithinHalfItsWidthAlone) {
  // Flat earth: the edges of a beam of 2.5 degrees meet the ground at H / tan(61.25) and H / tan(58.75).
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

TEST(ExtremeAttitudes, EveryBeamGivesNumbersAtEveryElevationFromSixtyDownToSixtyUp) {
  const terrain::AnalyticTerrain hills(terrain::sine_hills(test::axis_north(), 600.0, 12000.0));
  test::for_each_algorithm_and_beam(240, [&](radar::RadarConfiguration& configuration) {
    configuration.antenna.elevation_beamwidth_deg = 2.5;
    for (const double elevation_deg : {-60.0, -30.0, -1.25, -0.0, 0.0, 1.25, 60.0}) {
      physics::SweepGeometry geometry = geometry_from(test::kMidLatitude, 20.0, 3000.0, 40000.0);
      geometry.elevation = geo::Angle::degrees(elevation_deg);
      seen(configuration, geometry, hills);  // sees to it that each is finite and not negative
    }
  });
}

TEST(ExtremeAttitudes, InLevelFlightTheGimbalReachesSixtyUpAndSixtyDown) {
  test::for_each_algorithm(64, [&](const radar::RadarConfiguration& configuration) {
    expect_none_blank(scan_of(configuration, 0.0, 0.0, 60.0));
    expect_none_blank(scan_of(configuration, 0.0, 0.0, -60.0));
  });
}

TEST(ExtremeAttitudes, ThreeDegreesOfPitchTakeTheMiddleOfTheScanFromAnAntennaAtSixty) {
  // Straight ahead the antenna then stands 63 degrees from the nose in elevation. The track is the heading.
  for (const int way : {-1, 1}) {
    const auto sweeps = scan_of(test::bare_configuration(64), -3.0 * way, 0.0, 60.0 * way);
    ASSERT_FALSE(sweeps.empty());
    for (const auto& sweep : sweeps) {
      if (std::abs(sweep.azimuth_left_deg - 45.0) > 1.0) continue;
      EXPECT_TRUE(is_blank(sweep)) << way;
    }
  }
}

TEST(ExtremeAttitudes, WithTheNoseStraightUpOrDownAnAntennaNearTheHorizonReachesNothing) {
  // The horizon is 90 degrees from the nose all round.
  test::for_each_algorithm(64, [&](const radar::RadarConfiguration& configuration) {
    for (const double pitch_deg : {90.0, -90.0})
      for (const double elevation_deg : {-4.0, 0.0, 4.0})
        expect_all_blank_and_black(scan_of(configuration, pitch_deg, 0.0, elevation_deg));
  });
}

TEST(ExtremeAttitudes, WithTheNoseStraightUpTheWholeScanAtSixtyUpIsThirtyDegreesFromTheNose) {
  expect_none_blank(scan_of(test::bare_configuration(64), 90.0, 0.0, 60.0));
  expect_none_blank(scan_of(test::bare_configuration(64), -90.0, 0.0, -60.0));
}

TEST(ExtremeAttitudes, UpsideDownThePictureIsThatOfLevelFlightToTheBit) {
  // The antenna is held in space, and the gimbal's limits are the same on both sides.
  test::for_each_algorithm_and_beam(128, [&](const radar::RadarConfiguration& configuration) {
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

TEST(ExtremeAttitudes, HeadingsOf0And360GiveTheSameSweepsToTheBit) {
  test::for_each_algorithm(128, [&](const radar::RadarConfiguration& configuration) {
    const auto zero = scan_of(configuration, 0.0, 0.0, -4.0, 0.0);
    const auto whole = scan_of(configuration, 0.0, 0.0, -4.0, 360.0);
    ASSERT_EQ(zero.size(), whole.size());
    for (std::size_t i = 0; i < zero.size(); ++i) ASSERT_EQ(zero[i].hash, whole[i].hash) << i;
  });
}

TEST(ExtremeAttitudes, HeadingThroughNorthTheIslandDueNorthStaysInTheSweepThatHoldsNorth) {
  constexpr double kDistance_m = 37040.0, kRadius_m = 2000.0;  // half the range out
  const auto north = geo::geodesic_direct({37.0, -122.0}, geo::Bearing(), geo::Length::metres(kDistance_m));
  const auto island = [north](geo::GeoPoint position) {
    return geo::geodesic_inverse(north, position).distance.metres() < kRadius_m ? test::kIslandHeight_m : test::kVoid_m;
  };
  test::for_each_algorithm(100, [&](radar::RadarConfiguration& configuration) {
    configuration.antenna.elevation_beamwidth_deg = 180.0;
    configuration.receiver.noise_floor_db = -80.0;  // so that nothing is black
    Cockpit cockpit(configuration, island);
    cockpit.tick.command.antenna_elevation_deg = 0.0;
    cockpit.tick.ownship.velocity_north_mps = cockpit.tick.ownship.velocity_east_mps = 0.0;
    int found = 0;
    for (int tick = 0; tick < 1200; ++tick) {
      // 10 degrees a second from 354 through north to 6 and back, each half in 1.2 s.
      const double swing = std::abs(tick % 480 - 240) / 240.0;
      cockpit.tick.ownship.heading_deg = std::fmod(354.0 + 12.0 * swing, 360.0);
      const auto* sweep = cockpit.step();
      if (sweep == nullptr || is_blank(*sweep)) continue;
      ASSERT_LT(std::fmod(sweep->azimuth_right_deg - sweep->azimuth_left_deg + 360.0, 360.0), 2.0);
      // North lies in the wedge that begins left of it and ends right of it: a wedge over the wrap of the circle.
      const bool holds_north = sweep->azimuth_left_deg > 300.0 && sweep->azimuth_right_deg < 60.0;
      const double off_deg = std::abs(geo::wrapped_degrees(sweep->azimuth_left_deg));
      const bool lit = std::any_of(sweep->video, sweep->video + sweep->samples, [](auto level) { return level > 0; });
      // The island is 6.2 degrees wide.
      if (holds_north) {
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
