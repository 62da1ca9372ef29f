// The power series of positions along a geodesic (GeodesicSeries) against the exact geodesic (GeodesicRay).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "lib/geo/geodesy.hpp"

namespace yars::geo {
namespace {

// Value of the polynomial.
double at(const GeodesicSeries::Coefficients& coefficients, double distance_m) {
  double sum = 0.0;
  for (std::size_t k = coefficients.size(); k-- > 0;) sum = sum * distance_m + coefficients[k];
  return sum;
}

// Greatest distance of the series from the exact position, at four distances along the ray.
double error_m(const GeodesicSeries& series, GeoPoint start, Bearing azimuth, Length range) {
  const GeodesicRay ray(start, azimuth);
  double worst_m = 0.0;
  for (const double fraction : {0.0, 0.3, 0.8, 1.0}) {
    const Length distance = fraction * range;
    const GeoPoint found{at(series.latitude_deg, distance.metres()),
                         wrapped_degrees(at(series.longitude_deg, distance.metres()))};
    worst_m = std::max(worst_m, geodesic_inverse(ray.position(distance), found).distance.metres());
  }
  return worst_m;
}

TEST(GeodesicSeries, IsWithinAMillimetreWhereverAnOrderSuffices) {
  constexpr std::uint64_t kSeed = 1996;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> any_latitude(-90.0, 90.0), any_azimuth(0.0, 360.0), log_range(-1.0, 2.5);
  double worst_m = 0.0;
  int trials_with_order = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const GeoPoint start{any_latitude(random), 179.9};
    const Bearing azimuth = Bearing::degrees(trial % 3 == 0 ? 90.0 * (trial % 4) : any_azimuth(random));
    const Length range = Length::nautical_miles(std::pow(10.0, log_range(random)));
    const int order = GeodesicSeries::order_for(start.latitude_deg, range);
    if (order == 0) continue;
    ++trials_with_order;
    const double found_m = error_m(GeodesicFan(start, order).series(azimuth), start, azimuth, range);
    worst_m = std::max(worst_m, found_m);
    ASSERT_LT(found_m, 1e-3) << "latitude " << start.latitude_deg << ", azimuth " << azimuth.degrees() << ", "
                             << range.nautical_miles() << " NM, order " << order;
  }
  EXPECT_GT(trials_with_order, 15000);
  RecordProperty("worst_m", std::to_string(worst_m));
}

TEST(GeodesicSeries, HasAnOrderForAllRangesAtMiddleLatitudesAndNoneNearThePoles) {
  for (const double latitude : {0.0, 37.0, -60.0})
    EXPECT_GT(GeodesicSeries::order_for(latitude, Length::nautical_miles(160.0)), 0) << latitude;
  EXPECT_LE(GeodesicSeries::order_for(37.0, Length::nautical_miles(10.0)), 3);
  EXPECT_EQ(GeodesicSeries::order_for(90.0, Length::nautical_miles(10.0)), 0);
  EXPECT_EQ(GeodesicSeries::order_for(-89.9, Length::nautical_miles(160.0)), 0);
}

}  // namespace
}  // namespace yars::geo
