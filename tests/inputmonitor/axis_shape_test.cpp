#include <gtest/gtest.h>

#include "inputmonitor/device_map.hpp"

namespace yars::inputmonitor {
namespace {

constexpr AxisShape kByte{0, 255, 127.5};

TEST(AxisShape, EndsAreOneAndTheCentreIsNone) {
  EXPECT_EQ(shaped(0, kByte), -1.0);
  EXPECT_EQ(shaped(255, kByte), 1.0);
  AxisShape whole{-100, 100, 0};
  EXPECT_EQ(shaped(0, whole), 0.0);
  EXPECT_EQ(shaped(25, whole), 0.25);
  EXPECT_EQ(shaped(-25, whole), -0.25);
}

TEST(AxisShape, WhatLiesBeyondTheEndsIsTheEnd) {
  EXPECT_EQ(shaped(2147483647, kByte), 1.0);
  EXPECT_EQ(shaped(-2147483647 - 1, kByte), -1.0);
}

// Dead zone 0.2 of a travel of 100: 20 is the border, 60 is half of what is left.
TEST(AxisShape, TheDeadZoneIsTakenOutOfTheTravel) {
  const AxisShape shape{-100, 100, 0, 0.2};
  EXPECT_EQ(shaped(20, shape), 0.0);
  EXPECT_EQ(shaped(-20, shape), 0.0);
  EXPECT_NEAR(shaped(60, shape), 0.5, 1e-12);
  EXPECT_NEAR(shaped(-60, shape), -0.5, 1e-12);
  EXPECT_EQ(shaped(100, shape), 1.0);
}

// 0.5 t + 0.5 t^3 of t = 0.5: 0.25 + 0.0625.
TEST(AxisShape, TheCurveMixesTheCube) {
  EXPECT_NEAR(shaped(50, {-100, 100, 0, 0.0, 0.5}), 0.3125, 1e-12);
  EXPECT_NEAR(shaped(50, {-100, 100, 0, 0.0, 1.0}), 0.125, 1e-12);
  EXPECT_NEAR(shaped(60, {-100, 100, 0, 0.2, 0.5}), 0.3125, 1e-12);
  EXPECT_EQ(shaped(100, {-100, 100, 0, 0.2, 0.5}), 1.0);
}

TEST(AxisShape, InversionTurnsItRound) {
  EXPECT_EQ(shaped(25, {-100, 100, 0, 0.0, 0.0, true}), -0.25);
  EXPECT_NEAR(shaped(60, {-100, 100, 0, 0.2, 0.0, true}), -0.5, 1e-12);
}

// A centre at 20 of 0 to 100: 60 is half way up, 10 half way down.
TEST(AxisShape, EitherSideOfACentreHasItsOwnTravel) {
  const AxisShape shape{0, 100, 20};
  EXPECT_EQ(shaped(60, shape), 0.5);
  EXPECT_EQ(shaped(10, shape), -0.5);
}

}  // namespace
}  // namespace yars::inputmonitor
