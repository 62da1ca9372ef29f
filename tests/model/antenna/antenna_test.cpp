// Antenna servo and scan pattern: rates, limits, modes, and the order of sweeps in a scan.
#include "model/antenna/antenna.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <vector>

#include "lib/radar/modes.hpp"
#include "lib/radar/sensor.hpp"

namespace yars::model::antenna {
namespace {

using geo::Angle;
using geo::Bearing;

radar::Platform flying(double heading_deg, double drift_deg = 0.0) {
  return {Bearing::degrees(heading_deg), Angle(), Angle(), Bearing::degrees(heading_deg + drift_deg)};
}

// Steps until the first sweep begins. Returns that step.
AntennaStep until_sweeping(Antenna& antenna, const radar::Platform& platform) {
  for (int tick = 0; tick < 2000; ++tick) {
    const AntennaStep step = antenna.step(platform, Angle());
    if (step.phase == Phase::sweeping) return step;
  }
  ADD_FAILURE() << "no sweep in 10 s";
  return {};
}

// Limits in these tests: 110 deg/s, 60 deg either side, tolerance 0.1 deg.
TEST(Axis, MovesAtItsRate) {
  Axis axis({110.0, 60.0, 0.1});
  axis.command_position(50.0);
  axis.step();
  EXPECT_DOUBLE_EQ(axis.position_deg(), 110.0 * radar::kTickSeconds);
  axis.command_position(-50.0);
  axis.step();
  EXPECT_DOUBLE_EQ(axis.position_deg(), 0.0);
}

TEST(Axis, StopsAtItsLimits) {
  Axis axis({110.0, 60.0, 0.1});
  axis.command_position(500.0);
  for (int tick = 0; tick < 1000; ++tick) axis.step();
  EXPECT_DOUBLE_EQ(axis.position_deg(), 60.0);
  axis.command_position(-500.0);
  for (int tick = 0; tick < 10000; ++tick) axis.step();
  EXPECT_DOUBLE_EQ(axis.position_deg(), -60.0);
}

TEST(Axis, ReachesAPositionWithinATenthOfADegreeAndThenHoldsItExactly) {
  Axis axis({110.0, 60.0, 0.1});
  axis.command_position(-12.3);
  EXPECT_FALSE(axis.reached());
  for (int tick = 0; tick < 23; ++tick) axis.step();
  EXPECT_TRUE(axis.reached());
  EXPECT_EQ(axis.position_deg(), -12.3);
}

TEST(Axis, HoldsItsPositionWhenFrozen) {
  Axis axis({110.0, 60.0, 0.1});
  axis.command_position(50.0);
  axis.step();
  const double held_deg = axis.position_deg();
  axis.freeze();
  axis.step();
  EXPECT_EQ(axis.position_deg(), held_deg);
}

TEST(Axis, IgnoresNaN) {
  Axis axis({110.0, 60.0, 0.1});
  axis.command_position(std::nan(""));
  axis.set_position(std::nan(""));
  axis.step();
  EXPECT_EQ(axis.position_deg(), 0.0);
}

TEST(ScanPattern, HasAScanTimeOfOneSecondFor100DegreesInProportionToWidth) {
  const radar::AntennaConfiguration antenna;
  EXPECT_EQ(make_scan_pattern(antenna, 100.0).scan_ticks(), 200);
  EXPECT_EQ(make_scan_pattern(antenna, 50.0).scan_ticks(), 100);
  EXPECT_EQ(make_scan_pattern(antenna, 25.0).scan_ticks(), 50);
}

TEST(ScanPattern, StaysWithinTheRate) {
  const radar::AntennaConfiguration antenna;
  for (const double width_deg : {100.0, 50.0, 25.0, 33.0}) {
    const ScanPattern pattern = make_scan_pattern(antenna, width_deg);
    EXPECT_LE(pattern.edge_deg(1, 1) - pattern.edge_deg(0, 1), 110.0 * radar::kTickSeconds + 1e-12) << width_deg;
  }
}

TEST(ScanPattern, HasATurnAroundThatEndsWhereTheNextPassBegins) {
  const ScanPattern pattern = make_scan_pattern({}, 100.0);
  EXPECT_NEAR(pattern.turn_deg(pattern.turn_ticks, 1), pattern.edge_deg(0, -1), 1e-12);
  EXPECT_GT(pattern.turn_deg(pattern.turn_ticks / 2, 1), pattern.edge_deg(pattern.sweep_ticks, 1));
}

TEST(Antenna, RepeatsBitIdenticallyEveryTwoPassesOf200Ticks) {
  Antenna antenna({});
  antenna.restart(100.0);
  const radar::Platform platform = flying(33.0, 4.0);
  until_sweeping(antenna, platform);
  std::vector<std::uint64_t> first;
  for (int tick = 0; tick < 400; ++tick) {
    antenna.step(platform, Angle());
    first.push_back(std::bit_cast<std::uint64_t>(antenna.azimuth_deg()));
  }
  for (int tick = 0; tick < 400 * 500; ++tick) {
    antenna.step(platform, Angle());
    ASSERT_EQ(std::bit_cast<std::uint64_t>(antenna.azimuth_deg()), first[static_cast<std::size_t>(tick % 400)]);
  }
}

TEST(Antenna, AlternatesDirectionWithoutSweepsInTheTurnAround) {
  Antenna antenna({});
  antenna.restart(100.0);
  AntennaStep step = until_sweeping(antenna, flying(0.0));
  EXPECT_TRUE(step.scan_start);
  int sweeps = 1, turn_ticks = 0, ends = step.scan_end ? 1 : 0;
  for (int tick = 1; tick < 200; ++tick) {
    step = antenna.step(flying(0.0), Angle());
    EXPECT_EQ(step.direction, 1);
    ++(step.phase == Phase::sweeping ? sweeps : turn_ticks);
    ends += step.scan_end ? 1 : 0;
  }
  EXPECT_EQ(sweeps, 182);
  EXPECT_EQ(turn_ticks, 18);
  EXPECT_EQ(ends, 1);
  step = antenna.step(flying(0.0), Angle());
  EXPECT_EQ(step.direction, -1);
  EXPECT_TRUE(step.scan_start);
  EXPECT_NEAR((step.right - Bearing::degrees(50.0)).degrees(), 0.0, 1e-9);
}

TEST(Antenna, LeavesNoGapsBetweenSweepsWhileTheAircraftTurns) {
  Antenna antenna({});
  antenna.restart(100.0);
  double heading_deg = 350.0;
  AntennaStep before = until_sweeping(antenna, flying(heading_deg));
  for (int tick = 0; tick < 2000; ++tick) {
    heading_deg += 20.0 * radar::kTickSeconds;
    const AntennaStep step = antenna.step(flying(heading_deg), Angle());
    if (step.phase == Phase::sweeping) {
      EXPECT_GT((step.right - step.left).degrees(), 0.0);
      if (before.phase == Phase::sweeping && !step.scan_start) {
        ASSERT_EQ(step.direction > 0 ? step.left : step.right, before.direction > 0 ? before.right : before.left);
      }
    }
    before = step;
  }
}

// The centre moves at 30 deg/s to the left, faster than the scan moves to the right.
TEST(Antenna, HasTheEdgesOfASweepInOrderWhileTheCentreMovesAgainstASlowScan) {
  Antenna antenna({});
  antenna.restart({20.0, 0.0, 6.0});
  until_sweeping(antenna, flying(0.0));
  antenna.aim(-15.0);
  int against = 0;
  for (int tick = 0; tick < 200; ++tick) {
    const AntennaStep step = antenna.step(flying(0.0), Angle());
    ASSERT_EQ(step.phase, Phase::sweeping);
    ASSERT_GE((step.right - step.left).degrees(), 0.0) << tick;
    against += (step.azimuth - step.left).degrees() < 1e-9 && step.direction > 0 ? 1 : 0;
  }
  EXPECT_GT(against, 50) << "the beam moved against the scan";
}

TEST(Antenna, FollowsTheGroundTrackUpToTenDegreesOfDrift) {
  const radar::AntennaConfiguration configuration;
  EXPECT_NEAR((scan_centre(flying(100.0, 7.0), configuration) - Bearing::degrees(107.0)).degrees(), 0.0, 1e-9);
  EXPECT_NEAR((scan_centre(flying(100.0, 25.0), configuration) - Bearing::degrees(110.0)).degrees(), 0.0, 1e-9);
  EXPECT_NEAR((scan_centre(flying(5.0, -25.0), configuration) - Bearing::degrees(355.0)).degrees(), 0.0, 1e-9);
}

TEST(Antenna, ReachesTheEntireSectorAtTheDriftLimitInABank) {
  radar::Platform platform = flying(0.0, 10.0);
  platform.roll = Angle::degrees(60.0);
  Antenna antenna({});
  antenna.restart(100.0);
  EXPECT_TRUE(until_sweeping(antenna, platform).reachable);
  for (int tick = 0; tick < 180; ++tick) EXPECT_TRUE(antenna.step(platform, Angle()).reachable) << tick;
}

TEST(Gimbal, RotatesADirectionIntoAirframeAxes) {
  radar::Platform platform = flying(90.0);
  platform.pitch = Angle::degrees(20.0);
  // With the nose up 20 degrees, the horizon ahead is 20 degrees below the wing plane.
  radar::GimbalAngles gimbal = radar::gimbal_from_space(platform, Bearing::degrees(90.0), Angle());
  EXPECT_NEAR(gimbal.elevation.degrees(), -20.0, 1e-9);
  EXPECT_NEAR(gimbal.azimuth.degrees(), 0.0, 1e-9);
  // In a right bank of 30 degrees, the horizon to the right is 30 degrees above the wing plane.
  platform.pitch = Angle();
  platform.roll = Angle::degrees(30.0);
  gimbal = radar::gimbal_from_space(platform, Bearing::degrees(180.0), Angle());
  EXPECT_NEAR(gimbal.elevation.degrees(), 30.0, 1e-9);
}

TEST(Gimbal, EndsAt60Degrees) {
  const radar::AntennaConfiguration configuration;
  EXPECT_TRUE(radar::within_gimbal(flying(0.0), configuration, Bearing::degrees(60.0), Angle()));
  EXPECT_FALSE(radar::within_gimbal(flying(0.0), configuration, Bearing::degrees(61.0), Angle()));
  EXPECT_FALSE(radar::within_gimbal(flying(0.0), configuration, Bearing::degrees(180.0), Angle()));
}

TEST(Antenna, StepsFourBarsFromTheHighestToTheLowest) {
  radar::AntennaConfiguration configuration;
  configuration.scan_bars = 4;
  Antenna antenna(configuration);
  antenna.restart(50.0);
  const radar::Platform platform = flying(0.0);
  AntennaStep step = until_sweeping(antenna, platform);
  std::vector<double> elevations;
  for (int tick = 0; tick < 400; ++tick) {
    if (tick % 100 == 50) elevations.push_back(step.elevation.degrees());
    step = antenna.step(platform, Angle());
  }
  EXPECT_THAT(elevations, testing::Pointwise(testing::DoubleNear(1e-12), {3.75, 1.25, -1.25, -3.75}));
  EXPECT_TRUE(step.scan_start);
}

TEST(Antenna, StepsToTheNextBarDuringTheTurnAround) {
  radar::AntennaConfiguration configuration;
  configuration.scan_bars = 2;
  Antenna antenna(configuration);
  antenna.restart(100.0);
  const radar::Platform platform = flying(0.0);
  AntennaStep step = until_sweeping(antenna, platform);
  for (int tick = 0; tick < 1000; ++tick) {
    if (tick > 100 && step.phase == Phase::sweeping) {
      ASSERT_NEAR(step.elevation.degrees(), step.bar == 0 ? 1.25 : -1.25, 1e-12) << tick;
    }
    step = antenna.step(platform, Angle());
  }
}

TEST(Antenna, StaysAtItsStartPositionUntilTheFirstRestart) {
  radar::AntennaConfiguration configuration;
  configuration.start_azimuth_deg = -20.0;
  configuration.start_elevation_deg = 5.0;
  Antenna antenna(configuration);
  antenna.step(flying(0.0), Angle());
  EXPECT_EQ(antenna.azimuth_deg(), -20.0);
  EXPECT_EQ(antenna.elevation_deg(), 5.0);
}

TEST(Antenna, ScansACircleWithoutTurnAround) {
  radar::AntennaConfiguration configuration;
  configuration.circular_scan = true;
  Antenna antenna(configuration);
  antenna.restart(100.0);
  AntennaStep before = until_sweeping(antenna, flying(0.0));
  double turned_deg = 0.0;
  for (int tick = 0; tick < 2 * antenna.pattern().scan_ticks(); ++tick) {
    const AntennaStep step = antenna.step(flying(0.0), Angle());
    ASSERT_EQ(step.phase, Phase::sweeping);
    ASSERT_NEAR((step.left - before.right).degrees(), 0.0, 1e-9);
    turned_deg += (step.right - step.left).degrees();
    before = step;
  }
  EXPECT_NEAR(turned_deg, 720.0, 1e-6);
}

TEST(Antenna, HoldsADirectionInSpaceWhileTheAircraftTurns) {
  const radar::AntennaConfiguration configuration;
  Antenna antenna(configuration);
  int ticks = 1;
  while (!antenna.point(flying(0.0), Bearing::degrees(-40.0), Angle::degrees(-20.0)) && ticks < 1000) ++ticks;
  // Time to slew by 40 degrees at the azimuth rate.
  EXPECT_NEAR(ticks * radar::kTickSeconds, 40.0 / configuration.azimuth_rate_dps, 2.0 * radar::kTickSeconds);
  for (double heading_deg = 0.0; heading_deg > -80.0; heading_deg -= 0.1) {
    ASSERT_TRUE(antenna.point(flying(heading_deg), Bearing::degrees(-40.0), Angle::degrees(-20.0)));
    ASSERT_NEAR(heading_deg + antenna.azimuth_deg(), -40.0, 1e-9);
    ASSERT_EQ(antenna.elevation_deg(), -20.0);
  }
  for (int i = 0; i < 500; ++i) antenna.point(flying(30.0), Bearing::degrees(-40.0), Angle::degrees(-75.0));
  EXPECT_EQ(antenna.azimuth_deg(), -configuration.azimuth_limit_deg);
  EXPECT_EQ(antenna.elevation_deg(), -configuration.elevation_limit_deg);
}

TEST(Antenna, ResumesInTheMiddleOfAScan) {
  Antenna first({});
  first.restart(100.0);
  const radar::Platform platform = flying(45.0);
  for (int tick = 0; tick < 333; ++tick) first.step(platform, Angle::degrees(-3.0));
  Antenna second({});
  second.resume(first.state());
  for (int tick = 0; tick < 500; ++tick) {
    const AntennaStep a = first.step(platform, Angle::degrees(-3.0));
    const AntennaStep b = second.step(platform, Angle::degrees(-3.0));
    ASSERT_EQ(a.left, b.left);
    ASSERT_EQ(a.right, b.right);
    ASSERT_EQ(a.elevation, b.elevation);
    ASSERT_EQ(a.phase, b.phase);
  }
}

}  // namespace
}  // namespace yars::model::antenna
