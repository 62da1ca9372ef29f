// Tests of JumpGuard. It accepts a jump of position together with a new epoch of the session, or after one second.
#include <gtest/gtest.h>

#include "databuffer/session/receivers.hpp"

namespace yars::databuffer {
namespace {

constexpr std::int64_t kTick_ns = 5'000'000;

class JumpGuardTest : public ::testing::Test {
 protected:
  // Record with this position, sea level, and a velocity of 200 m/s north.
  Ownship at(double latitude_deg, double longitude_deg, std::uint32_t epoch = 0) const {
    Ownship ownship{};
    ownship.latitude_deg = latitude_deg;
    ownship.longitude_deg = longitude_deg;
    ownship.velocity_north_mps = 200.0;
    ownship.epoch = epoch;
    return ownship;
  }
  // Presents a record one tick after the last one; `epoch` is the session's.
  bool accepts(const Ownship& ownship, std::uint32_t epoch = 0) {
    now_ns_ += kTick_ns;
    return guard_.accepts(ownship, now_ns_, now_ns_, epoch);
  }
  int ticks_until_proven(const Ownship& ownship) {
    int ticks = 0;
    while (!guard_.is_proven() && ticks < 1000) {
      EXPECT_FALSE(accepts(ownship));
      ++ticks;
    }
    return ticks;
  }

  JumpGuard guard_;
  std::int64_t now_ns_ = 0;
};

TEST_F(JumpGuardTest, TheFirstPositionIsAccepted) {
  EXPECT_TRUE(accepts(at(10.0, 20.0)));
}

TEST_F(JumpGuardTest, FlightAndNoiseOfFiftyMetresAreNoJump) {
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(accepts(at(10.0 + 1e-5 * i + (i % 2) * 4e-4, 20.0)));
}

TEST_F(JumpGuardTest, AfterAGapTheAircraftMayBeAsFarAsItFlies) {
  ASSERT_TRUE(accepts(at(10.0, 20.0)));
  now_ns_ += 10'000'000'000;
  EXPECT_TRUE(accepts(at(10.0 + 2000.0 / 110'600.0, 20.0))) << "2 km in 10 s";
  now_ns_ += 10'000'000'000;
  EXPECT_FALSE(accepts(at(10.1, 20.0))) << "another 9 km in 10 s";
}

TEST_F(JumpGuardTest, CrossingTheAntimeridianOrThePoleIsNoJump) {
  ASSERT_TRUE(accepts(at(10.0, 179.9999)));
  EXPECT_TRUE(accepts(at(10.0, -179.9999)));
  JumpGuard pole;
  EXPECT_TRUE(pole.accepts(at(89.99999, 10.0), 0, 0, 0));
  EXPECT_TRUE(pole.accepts(at(89.99999, -170.0), kTick_ns, kTick_ns, 0));
}

TEST_F(JumpGuardTest, OneBadRecordIsRefusedAndCounted) {
  ASSERT_TRUE(accepts(at(10.0, 20.0)));
  EXPECT_FALSE(accepts(at(40.0, 20.0)));
  EXPECT_FALSE(guard_.is_proven());
  EXPECT_TRUE(accepts(at(10.00001, 20.0)));
  EXPECT_EQ(guard_.abandoned(), 1U);
}

TEST_F(JumpGuardTest, AJumpInAltitudeIsRefusedToo) {
  ASSERT_TRUE(accepts(at(10.0, 20.0)));
  Ownship high = at(10.0, 20.0);
  high.altitude_msl_m = 60.0;
  EXPECT_FALSE(accepts(high));
}

TEST_F(JumpGuardTest, ASteadyPositionIsProvenAfterATenthOfASecondAndAcceptedWithTheNextEpoch) {
  ASSERT_TRUE(accepts(at(10.0, 20.0)));
  const Ownship there = at(11.0, 20.0);
  EXPECT_EQ(ticks_until_proven(there), 21);
  EXPECT_TRUE(accepts(there, 1)) << "the source still writes epoch 0";
  EXPECT_FALSE(guard_.is_proven());
  EXPECT_EQ(guard_.abandoned(), 0U);
}

TEST_F(JumpGuardTest, ARepositioningIsAcceptedAtOnce) {
  ASSERT_TRUE(accepts(at(10.0, 20.0, 3), 3));
  EXPECT_TRUE(accepts(at(10.0, 20.0, 3), 4)) << "the source still writes the old epoch";
  EXPECT_TRUE(accepts(at(50.0, 20.0, 4), 4));
  EXPECT_FALSE(accepts(at(10.0, 20.0, 4), 4)) << "a second jump in the same epoch";
}

TEST_F(JumpGuardTest, AnEpochThatTheSessionDoesNotHaveAllowsNoJump) {
  ASSERT_TRUE(accepts(at(10.0, 20.0, 0), 0));
  EXPECT_FALSE(accepts(at(50.0, 20.0, 99), 0));
}

TEST_F(JumpGuardTest, WithoutANewEpochAJumpIsAcceptedAfterOneSecond) {
  ASSERT_TRUE(accepts(at(10.0, 20.0)));
  int refused = 0;
  while (!accepts(at(11.0, 20.0)) && refused < 1000) ++refused;
  EXPECT_EQ(refused, 200);
}

}  // namespace
}  // namespace yars::databuffer
