// Quantities with units, bearings and heights: conversions by definition, and combinations that do not compile.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <type_traits>

#include "lib/geo/quantity.hpp"

namespace yars::geo {
namespace {

template <class Left, class Right>
concept Addable = requires(Left left, Right right) { left + right; };
template <class Left, class Right>
concept Subtractable = requires(Left left, Right right) { left - right; };

TEST(Length, OneNauticalMileIs1852Metres) {
  EXPECT_EQ(Length::nautical_miles(1.0).metres(), 1852.0);
}
TEST(Length, OneFootIs0Point3048Metres) {
  EXPECT_EQ(Length::feet(1.0).metres(), 0.3048);
}
TEST(Length, OneNauticalMileIs6076Feet) {
  EXPECT_NEAR(Length::nautical_miles(1.0).feet(), 6076.11549, 1e-5);
}
TEST(Speed, OneKnotIsOneNauticalMileAnHour) {
  EXPECT_NEAR(Speed::knots(3600.0).metres_per_second(), 1852.0, 1e-9);
}
TEST(Angle, HalfATurnIsPi) {
  EXPECT_EQ(Angle::degrees(180.0).radians(), std::numbers::pi);
}
TEST(Angle, IsNotWrapped) {
  EXPECT_NEAR((Angle::degrees(300.0) + Angle::degrees(70.0)).degrees(), 370.0, 1e-12);
}

TEST(Quantity, ScalesComparesAndDividesToANumber) {
  EXPECT_EQ((Length::metres(3.0) * 2.0).metres(), 6.0);
  EXPECT_EQ((2.0 * Length::metres(3.0)).metres(), 6.0);
  EXPECT_EQ((Length::metres(3.0) / 2.0).metres(), 1.5);
  EXPECT_EQ(Length::metres(3.0) / Length::metres(2.0), 1.5);
  EXPECT_EQ((-Length::metres(3.0)).metres(), -3.0);
  EXPECT_LT(Length::metres(1.0), Length::feet(4.0));
}

TEST(Quantity, DifferentKindsDoNotMix) {
  static_assert(Addable<Length, Length>);
  static_assert(!Addable<Length, Angle>);
  static_assert(!Addable<Length, Duration>);
  static_assert(!std::is_convertible_v<double, Length>);
  static_assert(sizeof(Length) == sizeof(double));
}

TEST(Height, OfDifferentDatumsDoNotMix) {
  static_assert(Subtractable<AltitudeMsl, AltitudeMsl>);
  static_assert(!Subtractable<AltitudeMsl, HeightAboveGround>);
  static_assert(!Subtractable<AltitudeMsl, HeightAboveEllipsoid>);
  static_assert(!Addable<AltitudeMsl, AltitudeMsl>);
  EXPECT_NEAR((AltitudeMsl::feet(1000.0) - AltitudeMsl::metres(0.0)).feet(), 1000.0, 1e-12);
}

TEST(Bearing, IsFrom0UpToBelow360Degrees) {
  EXPECT_EQ(Bearing::degrees(360.0).degrees(), 0.0);
  EXPECT_EQ(Bearing::degrees(-90.0).degrees(), 270.0);
  EXPECT_EQ(Bearing::degrees(725.0).degrees(), 5.0);
  EXPECT_EQ(Bearing::degrees(-1e-20).degrees(), 0.0);
}

TEST(Bearing, DifferencesAreFromMinus180UpToBelow180Degrees) {
  EXPECT_NEAR((Bearing::degrees(10.0) - Bearing::degrees(350.0)).degrees(), 20.0, 1e-12);
  EXPECT_NEAR((Bearing::degrees(350.0) - Bearing::degrees(10.0)).degrees(), -20.0, 1e-12);
  EXPECT_NEAR((Bearing::degrees(180.0) - Bearing::degrees(0.0)).degrees(), -180.0, 1e-12);
}

TEST(Bearing, AnAngleCanBeAddedButNotABearing) {
  static_assert(!Addable<Bearing, Bearing>);
  static_assert(Addable<Bearing, Angle>);
  EXPECT_NEAR((Bearing::degrees(350.0) + Angle::degrees(20.0)).degrees(), 10.0, 1e-12);
  EXPECT_NEAR((Bearing::degrees(10.0) - Angle::degrees(20.0)).degrees(), 350.0, 1e-12);
}

TEST(Bearing, ABearingPlusADifferenceIsTheOtherBearing) {
  constexpr std::uint64_t kSeed = 20240611;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> any(-1000.0, 1000.0);
  for (int trial = 0; trial < 1000; ++trial) {
    const Bearing from = Bearing::degrees(any(random));
    const Bearing to = Bearing::degrees(any(random));
    EXPECT_NEAR((from + (to - from) - to).degrees(), 0.0, 1e-9);
  }
}

TEST(WrappedDegrees, AreFromMinus180UpToBelow180) {
  EXPECT_EQ(wrapped_degrees(180.0), -180.0);
  EXPECT_EQ(wrapped_degrees(-180.0), -180.0);
  EXPECT_EQ(wrapped_degrees(540.0), -180.0);
  EXPECT_EQ(wrapped_degrees(179.0), 179.0);
  EXPECT_EQ(wrapped_degrees(361.0), 1.0);
}

}  // namespace
}  // namespace yars::geo
