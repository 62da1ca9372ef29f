// PVU and IPVU: measurements of the beams, their times, and the scan meanwhile.
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
constexpr int kMaxTicksARound = 1000;  // 5 s: four beams of 0.4 s and the ways between them

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
    use(mode);
  }
  void use(Mode mode) { tick.command.mode = static_cast<std::uint8_t>(mode); }
  // Ticks until the next measurement; the limit if none comes.
  int ticks_until_measured(int limit = 4 * kMaxTicksARound) {
    const std::uint32_t before = status().velocity_count;
    for (int ticks = 1; ticks < limit; ++ticks) {
      step();
      if (status().velocity_count != before) return ticks;
    }
    return limit;
  }
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
    ASSERT_LT(cockpit.ticks_until_measured(), kMaxTicksARound);
    EXPECT_EQ(cockpit.status().velocity_count, round);
    // The vertical component has the largest share of the noise, 1.4 times the configured.
    const double most_mps = 6.0 * radar::NavigationConfiguration{}.velocity_noise_mps;
    EXPECT_LT(length(cockpit.error()), most_mps);
    EXPECT_GT(length(cockpit.error()), 1e-6);
    cockpit.tick.ownship.velocity_north_mps -= 20.0;
    cockpit.tick.ownship.velocity_down_mps += 5.0;
  }
}

TEST(Pvu, NoiseOfAHorizontalComponentIsTheConfiguredOne) {
  radar::RadarConfiguration configuration = quick();
  configuration.navigation.beam_dwell_s = 0.05;
  VelocityCockpit cockpit(Mode::pvu, configuration);
  double horizontal = 0.0, along = 0.0, vertical = 0.0;
  constexpr int kRounds = 200;
  for (int round = 0; round < kRounds; ++round) {
    ASSERT_LT(cockpit.ticks_until_measured(), kMaxTicksARound);
    const geo::Vector3 error = cockpit.error();
    horizontal += 0.5 * (error.x * error.x + error.y * error.y) / kRounds;
    along += 0.5 * (error.x + error.y) * (error.x + error.y) / kRounds;  // the track is 45 degrees
    vertical += error.z * error.z / kRounds;
  }
  const double noise = configuration.navigation.velocity_noise_mps;
  // 400 numbers tell a standard deviation within 3.5 %, 200 within 5 %; three times that.
  EXPECT_NEAR(std::sqrt(horizontal) / noise, 1.0, 0.11);
  // Of the geometry: see DilutionIsThatOfTheCovarianceWorkedOutByHand.
  EXPECT_NEAR(std::sqrt(along) / noise, 1.02, 0.16);
  EXPECT_NEAR(std::sqrt(vertical) / noise, 1.40, 0.21);
}

TEST(Pvu, StandsOnEachBeamOfTheRoundInItsOrder) {
  const radar::RadarConfiguration configuration = quick();
  const radar::NavigationConfiguration& navigation = configuration.navigation;
  VelocityCockpit cockpit(Mode::pvu, configuration);
  std::vector<int> order;
  for (int i = 0; i < kMaxTicksARound && cockpit.status().velocity_count == 0; ++i) {
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

TEST(Pvu, MeasuresInAnyBankAndNotWhereTheGimbalEnds) {
  for (const double roll_deg : {-90.0, -50.0, 30.0, 75.0}) {
    VelocityCockpit banked(Mode::pvu);
    banked.tick.ownship.roll_deg = roll_deg;
    EXPECT_LT(banked.ticks_until_measured(), kMaxTicksARound) << roll_deg;
  }
  VelocityCockpit climbing(Mode::pvu);
  climbing.tick.ownship.pitch_deg = 40.0;
  EXPECT_EQ(climbing.ticks_until_measured(), 4 * kMaxTicksARound);
  climbing.tick.ownship.pitch_deg = 5.0;
  EXPECT_LT(climbing.ticks_until_measured(), kMaxTicksARound);
}

TEST(Pvu, AJumpBeginsTheRoundAnew) {
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
  // A scan of a second may be under way.
  EXPECT_LT(cockpit.ticks_until_measured(), 200 + kMaxTicksARound);
  for (int i = 0; i < 3; ++i) {
    const int ticks = cockpit.ticks_until_measured();
    EXPECT_GT(ticks, kPeriodTicks);
    EXPECT_LT(ticks, kPeriodTicks + 200 + kMaxTicksARound);
  }
  cockpit.set_flag(databuffer::kIpvu, false);
  cockpit.step();
  EXPECT_EQ(cockpit.status().velocity_due_tick, -1);
  EXPECT_EQ(cockpit.ticks_until_measured(2 * kPeriodTicks), 2 * kPeriodTicks);
}

TEST(Ipvu, TakesItsRoundBetweenTwoWholeScans) {
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
  EXPECT_EQ(*scans.rbegin() - *scans.begin() + 1, scans.size()) << "no scan was broken off";
}

TEST(Ipvu, WorksInEachModeOfTheGroundMapAndInNoOther) {
  for (const Mode mode : {Mode::rbm, Mode::hrm, Mode::beacon}) {
    VelocityCockpit cockpit(mode);
    cockpit.set_flag(databuffer::kIpvu, true);
    EXPECT_LT(cockpit.ticks_until_measured(), 4 * kMaxTicksARound) << radar::name_of(mode);
  }
  for (const Mode mode : {Mode::air_to_air, Mode::ranging}) {
    VelocityCockpit cockpit(mode);
    cockpit.set_flag(databuffer::kIpvu, true);
    EXPECT_EQ(cockpit.ticks_until_measured(), 4 * kMaxTicksARound) << radar::name_of(mode);
  }
}

TEST(Ipvu, MeasuresOverAFrozenPictureWhenItIsDueAndLeavesItFrozen) {
  VelocityCockpit cockpit(Mode::rbm);
  cockpit.run(300);
  cockpit.set_flag(databuffer::kFreeze, true);
  cockpit.run(300);
  cockpit.set_flag(databuffer::kIpvu, true);
  EXPECT_LT(cockpit.ticks_until_measured(), kMaxTicksARound);
  EXPECT_LT(cockpit.ticks_until_measured(), kPeriodTicks + kMaxTicksARound);
  EXPECT_TRUE(cockpit.run(400).empty());
  EXPECT_NE(cockpit.status().flags & databuffer::kModelFrozen, 0U);
}

TEST(DopplerVelocityUpdate, IsNotFlownInSniffNorWithoutPower) {
  for (const Mode mode : {Mode::pvu, Mode::rbm}) {
    VelocityCockpit cockpit(mode);
    cockpit.set_flag(databuffer::kIpvu, true);
    while (cockpit.status().velocity_beam < 2) cockpit.step();
    cockpit.set_flag(databuffer::kSniff, true);
    EXPECT_EQ(cockpit.ticks_until_measured(), 4 * kMaxTicksARound);
    EXPECT_EQ(cockpit.status().velocity_beam, 0);
    for (const auto power : {radar::Power::standby, radar::Power::off}) {
      cockpit.set_flag(databuffer::kSniff, false);
      cockpit.tick.command.power = static_cast<std::uint8_t>(power);
      EXPECT_EQ(cockpit.ticks_until_measured(), 4 * kMaxTicksARound);
    }
    cockpit.tick.command.power = static_cast<std::uint8_t>(radar::Power::operate);
    EXPECT_LT(cockpit.ticks_until_measured(), 200 + kMaxTicksARound);
  }
}

// What a glass, a state machine and a successor see of it.
void expect_same(const ModelStatus& one, const ModelStatus& other) {
  ASSERT_EQ(one.velocity_count, other.velocity_count);
  ASSERT_EQ(one.velocity_beam, other.velocity_beam);
  ASSERT_EQ(one.velocity_dwell, other.velocity_dwell);
  ASSERT_EQ(one.velocity_due_tick, other.velocity_due_tick);
  ASSERT_EQ(one.velocity_north_mps, other.velocity_north_mps);
  ASSERT_EQ(one.velocity_east_mps, other.velocity_east_mps);
  ASSERT_EQ(one.velocity_down_mps, other.velocity_down_mps);
  ASSERT_EQ(one.antenna_azimuth_deg, other.antenna_azimuth_deg);
  ASSERT_EQ(one.antenna_elevation_deg, other.antenna_elevation_deg);
  ASSERT_EQ(one.scan, other.scan);
}

TEST(DopplerVelocityUpdate, ARestartedModelGoesOnWithTheVeryTick) {
  for (const Mode mode : {Mode::pvu, Mode::rbm}) {
    VelocityCockpit cockpit(mode);
    VelocityCockpit successor(mode);
    for (int i = 0; i < 1500; ++i) {
      cockpit.set_flag(databuffer::kIpvu, i > 300);
      // Killed and started again every 37 ticks.
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

TEST(DopplerVelocityUpdate, IsTheSameEveryTimeAndAnotherWithAnotherSeed) {
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
