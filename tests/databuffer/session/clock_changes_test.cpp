// Changes of the session's clock that users ask for.
#include <gtest/gtest.h>

#include <cmath>

#include "databuffer/messages/validation.hpp"
#include "databuffer/session/session_changes.hpp"
#include "databuffer/session/session_state.hpp"
#include "lib/radar/modes.hpp"

namespace yars::databuffer {
namespace {

constexpr std::int64_t kWhole_ns = 1'000'000'000;

// A clock that has run since a second, at this rate.
ClockState run_for_a_second(double rate) {
  ClockState clock = first_clock();
  clock.base_monotonic_ns = monotonic_ns() - kWhole_ns;
  clock.base_sim_ns = 100 * kWhole_ns;
  clock.rate = rate;
  clock.running = 1;
  return clock;
}

TEST(ClockChanges, SimTimeDoesNotJumpWhenTheClockIsFrozenOrItsRateChanges) {
  const ClockState clock = run_for_a_second(2.0);
  for (const ClockState& changed : {with_running(clock, false), with_rate(clock, 0.5)}) {
    EXPECT_GE(changed.base_sim_ns, 102 * kWhole_ns);
    EXPECT_LE(changed.base_sim_ns, sim_time_at(clock, monotonic_ns()));
    EXPECT_EQ(changed.epoch, clock.epoch);
    EXPECT_FALSE(validate(changed));
  }
  EXPECT_EQ(with_running(clock, false).running, 0U);
  EXPECT_EQ(with_rate(clock, 0.5).rate, 0.5);
}

TEST(ClockChanges, AStepLeadsToTheBeginOfATick) {
  ClockState clock = run_for_a_second(1.0);
  clock.running = 0;
  clock.base_sim_ns = 7 * radar::kTickNanoseconds + 3;
  EXPECT_EQ(stepped(clock, 1).base_sim_ns, 8 * radar::kTickNanoseconds);
  EXPECT_EQ(stepped(clock, 4).base_sim_ns, 11 * radar::kTickNanoseconds);
  EXPECT_EQ(stepped(clock, 1000).base_sim_ns, (7 + kStepPortion_ticks) * radar::kTickNanoseconds)
      << "a portion at once";
}

TEST(ClockChanges, AResetBeginsAnEpochAtAWholeTickWithoutARepositioning) {
  const ClockState clock = run_for_a_second(1.0);
  const ClockState reset = reset_to(clock, 12.3456);
  EXPECT_EQ(reset.epoch, clock.epoch + 1);
  EXPECT_EQ(reset.base_sim_ns, 2469 * radar::kTickNanoseconds);
  EXPECT_TRUE(std::isnan(reset.reposition_latitude_deg));
  EXPECT_FALSE(validate(reset));
}

TEST(ClockChanges, ARepositioningHasASpeedIfOneIsAskedFor) {
  const ClockState clock = run_for_a_second(1.0);
  Repositioning to{{37.0, -122.0}, geo::AltitudeMsl::feet(10'000.0), geo::Bearing::degrees(90.0)};
  const ClockState without = repositioned(clock, to);
  EXPECT_EQ(without.epoch, clock.epoch + 1);
  EXPECT_EQ(without.reposition_latitude_deg, 37.0);
  EXPECT_EQ(without.reposition_longitude_deg, -122.0);
  EXPECT_DOUBLE_EQ(without.reposition_altitude_m, 3048.0);
  EXPECT_DOUBLE_EQ(without.reposition_heading_deg, 90.0);
  EXPECT_EQ(without.reposition_speed_mps, 0.0);
  to.ground_speed = geo::Speed::knots(300.0);
  EXPECT_NEAR(repositioned(clock, to).reposition_speed_mps, 154.333, 1e-3);
  EXPECT_FALSE(validate(repositioned(clock, to)));
}

TEST(ClockChanges, AnEpochThatBeginsAtTheAircraftEndsTheSpeedOfARepositioning) {
  ClockState clock = repositioned(
      run_for_a_second(1.0),
      {{37.0, -122.0}, geo::AltitudeMsl::feet(10'000.0), geo::Bearing::degrees(90.0), geo::Speed::knots(300.0)});
  Ownship ownship{};
  ownship.latitude_deg = 40.0;
  begin_at_aircraft(clock, ownship, geo::Bearing::degrees(45.0));
  EXPECT_EQ(clock.reposition_latitude_deg, 40.0);
  EXPECT_EQ(clock.reposition_heading_deg, 45.0);
  EXPECT_EQ(clock.reposition_speed_mps, 0.0);
  EXPECT_EQ(clock.followed, 1U);
}

}  // namespace
}  // namespace yars::databuffer
