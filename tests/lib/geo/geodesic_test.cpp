// Geodesics and coordinate frames against results that follow from the definition of the WGS84 ellipsoid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "lib/geo/frames.hpp"
#include "lib/geo/geodesy.hpp"

namespace yars::geo {
namespace {

constexpr double kSemiMajor_m = 6378137.0;           // WGS84
constexpr double kFlattening = 1.0 / 298.257223563;  // WGS84
constexpr double kSemiMinor_m = kSemiMajor_m * (1.0 - kFlattening);

// The quarter meridian of WGS84: 10,001,965.729 m (Karney 2013, and every table of the ellipsoid).
TEST(Geodesic, FromEquatorToPoleIsTheQuarterMeridian) {
  const auto inverse = geodesic_inverse({0.0, 7.0}, {90.0, 7.0});
  EXPECT_NEAR(inverse.distance.metres(), 10001965.729, 1e-3);
  EXPECT_NEAR(inverse.azimuth_at_start.degrees(), 0.0, 1e-12);
}

TEST(Geodesic, ADegreeAlongTheEquatorIsADegreeOfTheSemiMajorAxis) {
  const auto inverse = geodesic_inverse({0.0, 0.0}, {0.0, 1.0});
  EXPECT_NEAR(inverse.distance.metres(), kSemiMajor_m * kRadiansPerDegree, 1e-6);
  EXPECT_NEAR(inverse.azimuth_at_start.degrees(), 90.0, 1e-9);
}

TEST(Geodesic, DirectUndoesInverse) {
  constexpr std::uint64_t kSeed = 1996;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> latitude(-89.0, 89.0);
  std::uniform_real_distribution<double> longitude(-180.0, 180.0);
  std::uniform_real_distribution<double> offset(-4.0, 4.0);
  for (int trial = 0; trial < 1000; ++trial) {
    const GeoPoint from{latitude(random), longitude(random)};
    const GeoPoint to{std::clamp(from.latitude_deg + offset(random), -90.0, 90.0),
                      wrapped_degrees(from.longitude_deg + offset(random))};
    const auto inverse = geodesic_inverse(from, to);
    const GeoPoint reached = geodesic_direct(from, inverse.azimuth_at_start, inverse.distance);
    EXPECT_LT(geodesic_inverse(reached, to).distance.metres(), 1e-6);
  }
}

TEST(GeodesicRay, EqualsTheDirectSolutions) {
  const GeoPoint start{36.6, -121.9};
  const Bearing azimuth = Bearing::degrees(217.0);
  const GeodesicRay ray(start, azimuth);
  for (const double distance_nm : {0.0, 4.7, 40.0, 160.0}) {
    const Length distance = Length::nautical_miles(distance_nm);
    const GeoPoint direct = geodesic_direct(start, azimuth, distance);
    EXPECT_LT(geodesic_inverse(ray.position(distance), direct).distance.metres(), 1e-6);
    EXPECT_LT(geodesic_inverse(ray.position_and_azimuth(distance).point, direct).distance.metres(), 1e-6);
  }
  EXPECT_NEAR(ray.position_and_azimuth(Length()).azimuth.degrees(), 217.0, 1e-9);
}

TEST(GeodesicRay, ARayAlongAMeridianKeepsItsAzimuth) {
  const GeodesicRay ray({10.0, 20.0}, Bearing::degrees(0.0));
  const auto position = ray.position_and_azimuth(Length::nautical_miles(160.0));
  EXPECT_NEAR(position.point.longitude_deg, 20.0, 1e-12);
  EXPECT_NEAR((position.azimuth - Bearing::degrees(0.0)).degrees(), 0.0, 1e-12);
}

// a and b are the semi-axes. On the equator the radius is b^2/a along the meridian and a along the equator. At the pole
// it is a^2/b in every direction.
TEST(RadiusOfCurvature, HasItsKnownValuesAtEquatorAndPole) {
  const double b2_over_a_m = kSemiMinor_m * kSemiMinor_m / kSemiMajor_m;
  const double a2_over_b_m = kSemiMajor_m * kSemiMajor_m / kSemiMinor_m;
  EXPECT_NEAR(radius_of_curvature(0.0, Bearing::degrees(0.0)).metres(), b2_over_a_m, 1e-6);
  EXPECT_NEAR(radius_of_curvature(0.0, Bearing::degrees(90.0)).metres(), kSemiMajor_m, 1e-6);
  EXPECT_NEAR(radius_of_curvature(90.0, Bearing::degrees(33.0)).metres(), a2_over_b_m, 1e-6);
}

TEST(Ecef, HasItsAxesThroughTheEquatorAndThePole) {
  const Vector3 greenwich = ecef_from_geodetic({0.0, 0.0}, HeightAboveEllipsoid::metres(10.0));
  EXPECT_NEAR(greenwich.x, kSemiMajor_m + 10.0, 1e-6);
  EXPECT_NEAR(greenwich.y, 0.0, 1e-6);
  const Vector3 east = ecef_from_geodetic({0.0, 90.0}, HeightAboveEllipsoid::metres(0.0));
  EXPECT_NEAR(east.y, kSemiMajor_m, 1e-6);
  const Vector3 pole = ecef_from_geodetic({90.0, 0.0}, HeightAboveEllipsoid::metres(0.0));
  EXPECT_NEAR(pole.z, kSemiMinor_m, 1e-6);
}

TEST(LocalTangentFrame, PointsEastNorthAndUp) {
  const GeoPoint origin{36.0, -121.0};
  const LocalTangentFrame frame(origin, HeightAboveEllipsoid::metres(100.0));
  const auto enu = [&](GeoPoint point, double height_m) {
    return frame.enu_from_geodetic(point, HeightAboveEllipsoid::metres(height_m));
  };
  EXPECT_NEAR(enu(origin, 350.0).z, 250.0, 1e-6);
  const Vector3 north = enu(geodesic_direct(origin, Bearing::degrees(0.0), Length::metres(100.0)), 100.0);
  EXPECT_NEAR(north.y, 100.0, 0.01);
  EXPECT_NEAR(north.x, 0.0, 1e-6);
  const Vector3 east = enu(geodesic_direct(origin, Bearing::degrees(90.0), Length::metres(100.0)), 100.0);
  EXPECT_NEAR(east.x, 100.0, 0.01);
  EXPECT_NEAR(east.y, 0.0, 0.01);
}

TEST(LocalTangentFrame, ConvertsDirectionsToEcefAndBack) {
  const LocalTangentFrame frame({52.0, 13.0}, HeightAboveEllipsoid::metres(0.0));
  const Vector3 back = frame.enu_from_ecef_direction(frame.ecef_from_enu_direction({0.6, -0.48, 0.64}));
  EXPECT_NEAR(back.x, 0.6, 1e-15);
  EXPECT_NEAR(back.y, -0.48, 1e-15);
  EXPECT_NEAR(back.z, 0.64, 1e-15);
  // Up at the north pole is the earth's axis.
  const LocalTangentFrame pole({90.0, 0.0}, HeightAboveEllipsoid::metres(0.0));
  EXPECT_NEAR(pole.ecef_from_enu_direction({0, 0, 1}).z, 1.0, 1e-15);
}

// At distance d the surface is d^2 / (2 R) below the tangent plane. R is the radius of curvature along the azimuth.
TEST(LocalTangentFrame, HasTheCurvedEarthBelowItsTangentPlane) {
  const GeoPoint origin{36.0, -121.0};
  const LocalTangentFrame frame(origin, HeightAboveEllipsoid::metres(0.0));
  const Length distance = Length::nautical_miles(20.0);
  const Bearing azimuth = Bearing::degrees(70.0);
  const Vector3 point = frame.enu_from_geodetic(geodesic_direct(origin, azimuth, distance), HeightAboveEllipsoid());
  const double radius_m = radius_of_curvature(origin.latitude_deg, azimuth).metres();
  EXPECT_NEAR(-point.z, distance.metres() * distance.metres() / (2.0 * radius_m), 0.5);
}

}  // namespace
}  // namespace yars::geo
