// shaped(): deflection -1 to 1 of an axis from its raw value, with dead zone, curve and inversion.
#include <gtest/gtest.h>

#include "inputmonitor/device_decoder.hpp"

namespace yars::inputmonitor {
namespace {

constexpr AxisShape kByte{0, 255, 127.5};

TEST(AxisShape, TheEndsAreMinusOneAndOneAndTheCentreIsZero) {
  EXPECT_EQ(shaped(0, kByte), -1.0);
  EXPECT_EQ(shaped(255, kByte), 1.0);
  AxisShape linear{-100, 100, 0};
  EXPECT_EQ(shaped(0, linear), 0.0);
  EXPECT_EQ(shaped(25, linear), 0.25);
  EXPECT_EQ(shaped(-25, linear), -0.25);
}

TEST(AxisShape, ValuesBeyondTheEndsAreClamped) {
  EXPECT_EQ(shaped(2147483647, kByte), 1.0);
  EXPECT_EQ(shaped(-2147483647 - 1, kByte), -1.0);
}

// A dead zone of 0.2 of the travel 100 ends at 20. 60 is half of the remaining travel.
TEST(AxisShape, TheTravelBeginsAtTheEndOfTheDeadZone) {
  const AxisShape shape{-100, 100, 0, 0.2};
  EXPECT_EQ(shaped(20, shape), 0.0);
  EXPECT_EQ(shaped(-20, shape), 0.0);
  EXPECT_NEAR(shaped(60, shape), 0.5, 1e-12);
  EXPECT_NEAR(shaped(-60, shape), -0.5, 1e-12);
  EXPECT_EQ(shaped(100, shape), 1.0);
}

// The curve c gives (1 - c) t + c t^3 for the linear deflection t. With c = 0.5 and t = 0.5: 0.25 + 0.0625.
TEST(AxisShape, TheCurveAddsAShareOfTheCube) {
  EXPECT_NEAR(shaped(50, {-100, 100, 0, 0.0, 0.5}), 0.3125, 1e-12);
  EXPECT_NEAR(shaped(50, {-100, 100, 0, 0.0, 1.0}), 0.125, 1e-12);
  EXPECT_NEAR(shaped(60, {-100, 100, 0, 0.2, 0.5}), 0.3125, 1e-12);
  EXPECT_EQ(shaped(100, {-100, 100, 0, 0.2, 0.5}), 1.0);
}

TEST(AxisShape, InversionChangesTheSign) {
  EXPECT_EQ(shaped(25, {-100, 100, 0, 0.0, 0.0, true}), -0.25);
  EXPECT_NEAR(shaped(60, {-100, 100, 0, 0.2, 0.0, true}), -0.5, 1e-12);
}

// With the centre at 20 of 0 to 100, 60 is half of the upper travel and 10 is half of the lower travel.
TEST(AxisShape, EachSideOfTheCentreHasItsOwnTravel) {
  const AxisShape shape{0, 100, 20};
  EXPECT_EQ(shaped(60, shape), 0.5);
  EXPECT_EQ(shaped(10, shape), -0.5);
}

}  // namespace
}  // namespace yars::inputmonitor
