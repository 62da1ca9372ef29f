// Tests of Leg, the geodesic between two waypoints. Leg::fix() gives the position of a point relative to it: the
// distance along the leg, and the distance across it, positive to the right.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "flightmodel/motion.hpp"

namespace yars::flightmodel {
namespace {

TEST(Leg, APositionOnTheLegHasNoCrossTrack) {
  const Leg leg({38.0, -123.0}, {40.0, -100.0});
  for (const double along_m : {-50'000.0, 0.0, 1'000'000.0, leg.length().metres(), 3'000'000.0}) {
    const auto fix = leg.fix(leg.point(geo::Length::metres(along_m)), {});
    EXPECT_NEAR(fix.along.metres(), along_m, 1e-3);
    EXPECT_NEAR(fix.across.metres(), 0.0, 1e-3);
  }
}

TEST(Leg, OnTheEquatorAcrossIsTheDistanceAlongTheMeridian) {
  const Leg leg({0.0, 0.0}, {0.0, 10.0});
  const auto north = leg.fix({0.5, 3.0}, {});
  EXPECT_NEAR(north.along.metres(), 6'378'137.0 * 3.0 * geo::kRadiansPerDegree, 1e-2);
  EXPECT_NEAR(north.across.metres(), -geo::geodesic_inverse({0.5, 3.0}, {0.0, 3.0}).distance.metres(), 1e-2);
  EXPECT_GT(leg.fix({-0.5, 3.0}, {}).across.metres(), 0.0);
}

TEST(Leg, WorksAcrossThePoleAndTheAntimeridian) {
  const Leg across_pole({89.0, 0.0}, {89.0, 180.0});
  EXPECT_NEAR(across_pole.fix({90.0, 77.0}, {}).along.metres(), across_pole.length().metres() / 2.0, 1e-2);
  const Leg across_antimeridian({0.0, 179.0}, {0.0, -179.0});
  const auto fix = across_antimeridian.fix({0.1, 180.0}, {});
  EXPECT_NEAR(fix.along.metres(), across_antimeridian.length().metres() / 2.0, 1e-2);
  EXPECT_LT(fix.across.metres(), 0.0);
}

TEST(Leg, NoPositionOnTheLegIsNearerThanThatOfTheFix) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> latitude(-89.0, 89.0);
  std::uniform_real_distribution<double> longitude(-180.0, 180.0);
  std::uniform_real_distribution<double> azimuth(0.0, 360.0);
  std::uniform_real_distribution<double> distance(10e3, 500e3);
  for (int round = 0; round < 200; ++round) {
    const geo::GeoPoint from{latitude(random), longitude(random)};
    const auto length = geo::Length::metres(distance(random));
    const Leg leg(from, geo::geodesic_direct(from, geo::Bearing::degrees(azimuth(random)), length));
    const auto position =
        geo::geodesic_direct(from, geo::Bearing::degrees(azimuth(random)), geo::Length::metres(distance(random)));
    const auto fix = leg.fix(position, {});
    const auto distance_m = [&](double offset_m) {
      return geo::geodesic_inverse(position, leg.point(fix.along + geo::Length::metres(offset_m))).distance.metres();
    };
    ASSERT_NEAR(distance_m(0.0), std::abs(fix.across.metres()), 1e-2);
    ASSERT_LE(distance_m(0.0), distance_m(100.0) + 1e-6);
    ASSERT_LE(distance_m(0.0), distance_m(-100.0) + 1e-6);
  }
}

}  // namespace
}  // namespace yars::flightmodel
