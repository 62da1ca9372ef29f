// PVU and IPVU: measured velocities correct the mission navigator, and the differences are shown.
// Source: docs/pilots_manual.md#rule-16.
#include <gtest/gtest.h>

#include "databuffer/messages/validation.hpp"
#include "lib/random/counter_rng.hpp"
#include "tests/statemachine/pilot.hpp"

namespace yars::statemachine::testing {
namespace {

constexpr int kTicksPerSecond = 200;

class VelocityUpdate : public ::testing::Test {
 protected:
  VelocityUpdate() {
    pilot.around.nav.velocity_north_mps = pilot.around.ownship.velocity_north_mps;
    pilot.press("power opr");
  }
  // The model reports a measured velocity.
  void measure(double north_mps, double east_mps, double down_mps) {
    databuffer::ModelStatus& model = pilot.around.model;
    model.velocity_north_mps = north_mps;
    model.velocity_east_mps = east_mps;
    model.velocity_down_mps = down_mps;
    ++model.velocity_count;
    pilot.wait();
  }
  bool shown() const { return pilot.is(databuffer::kVelocityShown); }
  double error_mps() const {
    const databuffer::NavigatorError& error = pilot.state.mission;
    return std::hypot(error.velocity_north_mps, error.velocity_east_mps, error.velocity_down_mps);
  }

  Pilot pilot;
};

TEST_F(VelocityUpdate, IpvuShowsTheDifferencesAndCorrectsTheNavigator) {
  pilot.press("nav drift mn 10 -5");
  pilot.press("pb 16");
  measure(200.0, 0.0, 0.0);
  ASSERT_TRUE(shown());
  EXPECT_NEAR(pilot.state.velocity_along_mps, geo::Length::feet(-10.0).metres(), 1e-9);
  EXPECT_NEAR(pilot.state.velocity_across_mps, geo::Length::feet(5.0).metres(), 1e-9);
  EXPECT_NEAR(error_mps(), 0.0, 1e-12);
}

TEST_F(VelocityUpdate, DifferencesAreAlongAndAcrossTheTrackAndVertical) {
  pilot.around.ownship.velocity_north_mps = 0.0;
  pilot.around.ownship.velocity_east_mps = 200.0;
  pilot.around.nav.velocity_north_mps = 1.0;
  pilot.around.nav.velocity_east_mps = 197.0;
  pilot.around.nav.velocity_down_mps = 0.5;
  pilot.press("pb 16");
  measure(0.0, 200.0, 0.0);
  EXPECT_NEAR(pilot.state.velocity_along_mps, 3.0, 1e-9);
  EXPECT_NEAR(pilot.state.velocity_across_mps, 1.0, 1e-9) << "radar minus navigator: 1 m/s south, to the right";
  EXPECT_NEAR(pilot.state.velocity_vertical_mps, 0.5, 1e-9) << "radar minus navigator, positive up";
}

TEST_F(VelocityUpdate, RepeatedCorrectionsKeepTheStateValid) {
  pilot.press("pb 16");
  pilot.around.nav.velocity_north_mps = -9000.0;
  for (double north_mps = -9000.0; north_mps < 9000.0; north_mps += 1500.0) {
    measure(north_mps, 0.0, 0.0);
    pilot.wait(20 * kTicksPerSecond);
    EXPECT_FALSE(databuffer::validate(pilot.state)) << *databuffer::validate(pilot.state) << " at " << north_mps;
  }
}

TEST_F(VelocityUpdate, TheInsKeepsItsOwnVelocity) {
  pilot.press("nav drift ins 10 0");
  pilot.press("pb 16");
  measure(200.0, 0.0, 0.0);
  EXPECT_NEAR(pilot.state.ins.velocity_north_mps, geo::Length::feet(10.0).metres(), 1e-12);
}

TEST_F(VelocityUpdate, IpvuShowsTheDifferencesForTenSeconds) {
  pilot.press("pb 16");
  measure(201.0, 0.0, 0.0);
  pilot.wait(9 * kTicksPerSecond);
  EXPECT_TRUE(shown());
  pilot.wait(2 * kTicksPerSecond);
  EXPECT_FALSE(shown());
}

TEST_F(VelocityUpdate, PvuShowsTheDifferencesAlwaysAndCorrectsOncePerMinute) {
  pilot.press("radar pvu");
  measure(201.0, 0.0, 0.0);
  EXPECT_NEAR(pilot.state.mission.velocity_north_mps, 1.0, 1e-12) << "the first measurement corrects";
  measure(203.0, 0.0, 0.0);
  EXPECT_NEAR(pilot.state.mission.velocity_north_mps, 1.0, 1e-12) << "within the minute a measurement is only shown";
  EXPECT_NEAR(pilot.state.velocity_along_mps, 2.0, 1e-12);
  pilot.wait(30 * kTicksPerSecond);
  EXPECT_TRUE(shown());
  pilot.wait(30 * kTicksPerSecond);
  measure(203.0, 0.0, 0.0);
  EXPECT_NEAR(pilot.state.mission.velocity_north_mps, 3.0, 1e-12);
  pilot.press("radar rbm");
  pilot.wait(11 * kTicksPerSecond);
  EXPECT_FALSE(shown());
}

// A measurement takes some 2.4 s. The corrections do not wait for 60 s and then for a measurement each time.
TEST_F(VelocityUpdate, PvuCorrectsEverySixtySecondsOnAverage) {
  pilot.press("radar pvu");
  int corrections = 0;
  std::int64_t last = pilot.state.velocity_updated_tick;
  constexpr int kMinutes = 30, kRound = 12 * kTicksPerSecond / 5;
  for (int tick = 0; tick < kMinutes * 60 * kTicksPerSecond; tick += kRound) {
    measure(201.0, 0.0, 0.0);
    pilot.wait(kRound - 1);
    corrections += pilot.state.velocity_updated_tick != last ? 1 : 0;
    last = pilot.state.velocity_updated_tick;
  }
  EXPECT_EQ(corrections, kMinutes);
}

TEST_F(VelocityUpdate, WithoutPvuAndIpvuAMeasurementHasNoEffect) {
  measure(250.0, 0.0, 0.0);
  EXPECT_FALSE(shown());
  EXPECT_EQ(error_mps(), 0.0);
  pilot.press("pb 16");
  pilot.wait();
  EXPECT_FALSE(shown()) << "an old measurement is not used later";
}

TEST_F(VelocityUpdate, AnInvalidMeasurementIsNotUsed) {
  pilot.press("pb 16");
  measure(kNaN, 0.0, 0.0);
  measure(1e9, 0.0, 0.0);
  EXPECT_FALSE(shown());
  EXPECT_EQ(error_mps(), 0.0);
}

TEST_F(VelocityUpdate, WithIpvuTheVelocityErrorStaysWithin2FeetPerSecondForAnHour) {
  pilot.configuration.navigation.walk_mps = geo::Length::feet(2.0).metres();
  pilot.press("nav drift mn 6 -6");
  pilot.press("pb 16");
  const double sigma_mps = pilot.configuration.navigation.velocity_noise_mps;
  const double most_mps = geo::Length::feet(2.0).metres();
  for (int minute = 0; minute < 60; ++minute) {
    const auto noise = [&](std::uint64_t draw) {
      return sigma_mps * random::standard_normal(1, static_cast<std::uint64_t>(minute), draw);
    };
    measure(200.0 + noise(0), noise(1), noise(2));
    for (int second = 0; second < 60; ++second) {
      pilot.wait(kTicksPerSecond);
      const databuffer::NavigatorError& error = pilot.state.mission;
      for (const double component : {error.velocity_north_mps, error.velocity_east_mps, error.velocity_down_mps})
        ASSERT_LT(std::abs(component), most_mps) << minute << " min " << second << " s";
    }
  }
}

}  // namespace
}  // namespace yars::statemachine::testing
