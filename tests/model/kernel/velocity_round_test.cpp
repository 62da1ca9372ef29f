// PVU and IPVU: the velocity measured by Doppler beams, the times of the measurements, and the scan between them.
// A round dwells once on each of the four beams and gives one measurement.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "lib/geo/frames.hpp"
#include "lib/radar/configuration.hpp"
#include "model/kernel/doppler_modes.hpp"
#include "tests/model/kernel/cockpit.hpp"

namespace yars::test {
namespace {

using databuffer::ModelStatus;
using databuffer::Sweep;
using radar::Mode;

constexpr double kPeriod_s = 8.0;
constexpr int kPeriodTicks = static_cast<int>(kPeriod_s / radar::kTickSeconds);
constexpr int kMaxRoundTicks = 1000;  // 5 s: limit for four dwells of 0.4 s and the slewing between them

// Period of IPVU: 8 s. Few samples make the test fast.
radar::RadarConfiguration quick() {
  radar::RadarConfiguration configuration;
  configuration.fidelity.samples = 32;
  configuration.navigation.velocity_period_s = kPeriod_s;
  return configuration;
}

class VelocityCockpit : public Cockpit {
 public:
  explicit VelocityCockpit(Mode mode, const radar::RadarConfiguration& configuration = quick())
      : Cockpit(configuration) {
    tick.ownship.velocity_down_mps = -3.0;
    set_mode(mode);
  }
  void set_mode(Mode mode) { tick.command.mode = static_cast<std::uint8_t>(mode); }
  // Steps until the next measurement. Returns the number of ticks, or `limit` without a measurement.
  int ticks_until_measured(int limit = 4 * kMaxRoundTicks) {
    const std::uint32_t before = status().velocity_count;
    for (int ticks = 1; ticks < limit; ++ticks) {
      step();
      if (status().velocity_count != before) return ticks;
    }
    return limit;
  }
  // Measured minus true velocity [m/s]: north, east, down.
  geo::Vector3 error() const {
    const ModelStatus now = status();
    return geo::Vector3{now.velocity_north_mps, now.velocity_east_mps, now.velocity_down_mps} -
           geo::Vector3{tick.ownship.velocity_north_mps, tick.ownship.velocity_east_mps,
                        tick.ownship.velocity_down_mps};
  }
};

TEST(Pvu, MeasuresTheVelocityOverGroundAfterEachRound) {
  VelocityCockpit cockpit(Mode::pvu);
  EXPECT_EQ(cockpit.status().velocity_count, 0U);
  EXPECT_EQ(cockpit.status().velocity_beam, 0);
  for (std::uint32_t round = 1; round <= 5; ++round) {
    ASSERT_LT(cockpit.ticks_until_measured(), kMaxRoundTicks);
    EXPECT_EQ(cockpit.status().velocity_count, round);
    // The vertical component has the largest noise, 1.4 times the configured standard deviation.
    const double max_error_mps = 6.0 * radar::NavigationConfiguration{}.velocity_noise_mps;
    EXPECT_LT(length(cockpit.error()), max_error_mps);
    EXPECT_GT(length(cockpit.error()), 1e-6);
    cockpit.tick.ownship.velocity_north_mps -= 20.0;
    cockpit.tick.ownship.velocity_down_mps += 5.0;
  }
}

TEST(Pvu, HasTheConfiguredNoiseInAHorizontalComponent) {
  radar::RadarConfiguration configuration = quick();
  configuration.navigation.beam_dwell_s = 0.05;
  VelocityCockpit cockpit(Mode::pvu, configuration);
  double horizontal = 0.0, along = 0.0, vertical = 0.0;
  constexpr int kRounds = 200;
  for (int round = 0; round < kRounds; ++round) {
    ASSERT_LT(cockpit.ticks_until_measured(), kMaxRoundTicks);
    const geo::Vector3 error = cockpit.error();
    horizontal += 0.5 * (error.x * error.x + error.y * error.y) / kRounds;
    along += 0.5 * (error.x + error.y) * (error.x + error.y) / kRounds;  // the track is 45 degrees
    vertical += error.z * error.z / kRounds;
  }
  const double noise = configuration.navigation.velocity_noise_mps;
  // The standard error of a standard deviation is 3.5 % for 400 values and 5 % for 200. Tolerance: three standard
  // errors.
  EXPECT_NEAR(std::sqrt(horizontal) / noise, 1.0, 0.11);
  // The factors follow from the directions of the default beams, as in the test DilutionEqualsTheClosedForm.
  EXPECT_NEAR(std::sqrt(along) / noise, 1.02, 0.16);
  EXPECT_NEAR(std::sqrt(vertical) / noise, 1.40, 0.21);
}

TEST(Pvu, DwellsOnEachBeamInOrder) {
  const radar::RadarConfiguration configuration = quick();
  const radar::NavigationConfiguration& navigation = configuration.navigation;
  VelocityCockpit cockpit(Mode::pvu, configuration);
  std::vector<int> order;
  for (int i = 0; i < kMaxRoundTicks && cockpit.status().velocity_count == 0; ++i) {
    EXPECT_EQ(cockpit.step(), nullptr);
    const ModelStatus status = cockpit.status();
    if (status.velocity_dwell == 0) continue;
    const std::size_t beam = status.velocity_beam - 1U;
    if (order.empty() || order.back() != status.velocity_beam) order.push_back(status.velocity_beam);
    ASSERT_NEAR(status.antenna_azimuth_deg, navigation.beam_azimuths_deg[beam], configuration.antenna.tolerance_deg);
    ASSERT_NEAR(status.antenna_elevation_deg, -navigation.beam_depressions_deg[beam],
                configuration.antenna.tolerance_deg);
  }
  EXPECT_EQ(order, (std::vector{1, 2, 3, 4}));
  EXPECT_FALSE(cockpit.kernel.need(cockpit.tick).ground);
}

TEST(Pvu, MeasuresInAnyBankButNotBeyondTheGimbal) {
  for (const double roll_deg : {-90.0, -50.0, 30.0, 75.0}) {
    VelocityCockpit banked(Mode::pvu);
    banked.tick.ownship.roll_deg = roll_deg;
    EXPECT_LT(banked.ticks_until_measured(), kMaxRoundTicks) << roll_deg;
  }
  VelocityCockpit climbing(Mode::pvu);
  climbing.tick.ownship.pitch_deg = 40.0;
  EXPECT_EQ(climbing.ticks_until_measured(), 4 * kMaxRoundTicks);
  climbing.tick.ownship.pitch_deg = 5.0;
  EXPECT_LT(climbing.ticks_until_measured(), kMaxRoundTicks);
}

TEST(Pvu, AJumpOfPositionRestartsTheRound) {
  VelocityCockpit cockpit(Mode::pvu);
  while (cockpit.status().velocity_beam < 3) cockpit.step();
  ++cockpit.tick.epoch;
  cockpit.step();
  EXPECT_EQ(cockpit.status().velocity_beam, 1);
}

TEST(Ipvu, MeasuresRightAfterItIsSelectedAndThenOnceAPeriod) {
  VelocityCockpit cockpit(Mode::rbm);
  cockpit.run(450);
  EXPECT_EQ(cockpit.status().velocity_due_tick, -1);
  EXPECT_EQ(cockpit.status().velocity_count, 0U);
  cockpit.set_flag(databuffer::kIpvu, true);
  // The current scan, up to 1 s, ends first.
  EXPECT_LT(cockpit.ticks_until_measured(), 200 + kMaxRoundTicks);
  // Neither the rest of the scan nor the round adds to the period.
  constexpr int kRounds = 12, kScanTicks = 230;  // a scan, and the way of the dish from the last beam to its start
  int all_ticks = 0;
  for (int i = 0; i < kRounds; ++i) {
    const int ticks = cockpit.ticks_until_measured();
    EXPECT_NEAR(ticks, kPeriodTicks, kScanTicks);
    all_ticks += ticks;
  }
  EXPECT_NEAR(all_ticks, kRounds * kPeriodTicks, kScanTicks);
  cockpit.set_flag(databuffer::kIpvu, false);
  cockpit.step();
  EXPECT_EQ(cockpit.status().velocity_due_tick, -1);
  EXPECT_EQ(cockpit.ticks_until_measured(2 * kPeriodTicks), 2 * kPeriodTicks);
}

TEST(Ipvu, RunsBetweenTwoCompleteScans) {
  VelocityCockpit cockpit(Mode::rbm);
  ASSERT_TRUE(cockpit.run_until(is_scan_start));
  cockpit.run(50);
  cockpit.set_flag(databuffer::kIpvu, true);
  int swept_in_round = 0, starts = 0, ends = 0;
  std::set<std::uint32_t> scans;
  for (int i = 0; i < 2000; ++i) {
    const Sweep* sweep = cockpit.step();
    if (sweep == nullptr) continue;
    ASSERT_NEAR(sweep->elevation_deg, cockpit.tick.command.antenna_elevation_deg, 0.1);
    swept_in_round += cockpit.status().velocity_beam > 0 ? 1 : 0;
    starts += is_scan_start(*sweep) ? 1 : 0;
    ends += is_scan_end(*sweep) ? 1 : 0;
    scans.insert(sweep->scan);
  }
  EXPECT_EQ(swept_in_round, 0);
  EXPECT_GE(cockpit.status().velocity_count, 1U);
  EXPECT_LE(starts - ends, 1);
  EXPECT_GE(ends, 3);
  EXPECT_EQ(*scans.rbegin() - *scans.begin() + 1, scans.size()) << "no scan was interrupted";
}

TEST(Ipvu, WorksInEachMapModeAndInNoOther) {
  for (const Mode mode : {Mode::rbm, Mode::hrm, Mode::beacon}) {
    VelocityCockpit cockpit(mode);
    cockpit.set_flag(databuffer::kIpvu, true);
    EXPECT_LT(cockpit.ticks_until_measured(), 4 * kMaxRoundTicks) << radar::name_of(mode);
  }
  for (const Mode mode : {Mode::air_to_air, Mode::ranging}) {
    VelocityCockpit cockpit(mode);
    cockpit.set_flag(databuffer::kIpvu, true);
    EXPECT_EQ(cockpit.ticks_until_measured(), 4 * kMaxRoundTicks) << radar::name_of(mode);
  }
}

TEST(Ipvu, MeasuresWhileThePictureIsFrozen) {
  VelocityCockpit cockpit(Mode::rbm);
  cockpit.run(300);
  cockpit.set_flag(databuffer::kFreeze, true);
  cockpit.run(300);
  cockpit.set_flag(databuffer::kIpvu, true);
  EXPECT_LT(cockpit.ticks_until_measured(), kMaxRoundTicks);
  EXPECT_LT(cockpit.ticks_until_measured(), kPeriodTicks + kMaxRoundTicks);
  EXPECT_TRUE(cockpit.run(400).empty());
  EXPECT_NE(cockpit.status().flags & databuffer::kModelFrozen, 0U);
}

TEST(DopplerVelocityUpdate, StopsInSniffAndWithoutPower) {
  for (const Mode mode : {Mode::pvu, Mode::rbm}) {
    VelocityCockpit cockpit(mode);
    cockpit.set_flag(databuffer::kIpvu, true);
    while (cockpit.status().velocity_beam < 2) cockpit.step();
    cockpit.set_flag(databuffer::kSniff, true);
    EXPECT_EQ(cockpit.ticks_until_measured(), 4 * kMaxRoundTicks);
    EXPECT_EQ(cockpit.status().velocity_beam, 0);
    for (const auto power : {radar::Power::standby, radar::Power::off}) {
      cockpit.set_flag(databuffer::kSniff, false);
      cockpit.tick.command.power = static_cast<std::uint8_t>(power);
      EXPECT_EQ(cockpit.ticks_until_measured(), 4 * kMaxRoundTicks);
    }
    cockpit.tick.command.power = static_cast<std::uint8_t>(radar::Power::operate);
    EXPECT_LT(cockpit.ticks_until_measured(), 200 + kMaxRoundTicks);
  }
}

// Compares the fields that radar-display, state-machine and a restarted radar-model read.
void expect_same(const ModelStatus& actual, const ModelStatus& expected) {
  ASSERT_EQ(actual.velocity_count, expected.velocity_count);
  ASSERT_EQ(actual.velocity_beam, expected.velocity_beam);
  ASSERT_EQ(actual.velocity_dwell, expected.velocity_dwell);
  ASSERT_EQ(actual.velocity_due_tick, expected.velocity_due_tick);
  ASSERT_EQ(actual.velocity_north_mps, expected.velocity_north_mps);
  ASSERT_EQ(actual.velocity_east_mps, expected.velocity_east_mps);
  ASSERT_EQ(actual.velocity_down_mps, expected.velocity_down_mps);
  ASSERT_EQ(actual.antenna_azimuth_deg, expected.antenna_azimuth_deg);
  ASSERT_EQ(actual.antenna_elevation_deg, expected.antenna_elevation_deg);
  ASSERT_EQ(actual.scan, expected.scan);
}

TEST(DopplerVelocityUpdate, ARestartedModelContinuesAtTheNextTick) {
  for (const Mode mode : {Mode::pvu, Mode::rbm}) {
    VelocityCockpit cockpit(mode);
    VelocityCockpit successor(mode);
    for (int i = 0; i < 1500; ++i) {
      cockpit.set_flag(databuffer::kIpvu, i > 300);
      // The successor restarts from the status every 37 ticks.
      if (i % 37 == 0) successor.kernel = model::kernel::RadarKernel(quick());
      if (i % 37 == 0 && i > 0) successor.kernel.resume(cockpit.status());
      successor.tick = cockpit.tick;
      cockpit.step();
      successor.step();
      expect_same(successor.status(), cockpit.status());
    }
    EXPECT_GT(cockpit.status().velocity_count, 0U);
  }
}

TEST(DopplerVelocityUpdate, IsRepeatableAndDependsOnTheSeed) {
  const auto measured = [](std::uint64_t seed) {
    radar::RadarConfiguration configuration = quick();
    configuration.seed = seed;
    VelocityCockpit cockpit(Mode::pvu, configuration);
    cockpit.run(2000);
    return cockpit.status();
  };
  EXPECT_EQ(measured(1).velocity_north_mps, measured(1).velocity_north_mps);
  EXPECT_NE(measured(1).velocity_north_mps, measured(2).velocity_north_mps);
}

}  // namespace
}  // namespace yars::test
