// The algebra of vectors: facts by hand.
#include <gtest/gtest.h>

#include "lib/geo/geodesy.hpp"

namespace yars::geo {
namespace {

constexpr Vector3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

void expect_equal(Vector3 a, Vector3 b) {
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
  EXPECT_EQ(a.z, b.z);
}

TEST(Vector3, XCrossYIsZ) {
  expect_equal(cross(kX, kY), kZ);
  expect_equal(cross(kY, kZ), kX);
  expect_equal(cross(kZ, kX), kY);
}
TEST(Vector3, TheCrossProductStandsOnBoth) {
  const Vector3 a{1, -2, 3}, b{4, 0.5, -1};
  EXPECT_EQ(dot(cross(a, b), a), 0.0);
  EXPECT_EQ(dot(cross(a, b), b), 0.0);
}
TEST(Vector3, ThreeFourTwelveIsThirteenLong) {
  EXPECT_EQ(length({3, 4, 12}), 13.0);
}
TEST(Vector3, AddsAndScalesAxisByAxis) {
  expect_equal(2.0 * (kX + kY) - kZ, {2, 2, -1});
}

}  // namespace
}  // namespace yars::geo
