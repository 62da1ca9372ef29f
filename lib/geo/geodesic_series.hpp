// A short ray of WGS84 as two polynomials in the distance: Taylor's series about its start, tens of nanoseconds where
// the exact geodesic takes hundreds for each place. Within 1 mm of GeodesicRay up to the range that the order was
// asked for (tests/lib/geodesic_series_test.cpp). Short means against the way to the nearer pole, where longitude
// turns without bound.
#pragma once

#include <array>
#include <cstddef>

#include "lib/geo/bearing.hpp"
#include "lib/geo/geodesic.hpp"

namespace yars::geo {

struct GeodesicSeries {
  static constexpr int kMostOrder = 8;

  // The lowest order that holds within 1 mm for every azimuth; 0: none up to kMostOrder does.
  static int order_for(double latitude_deg, Length range);

  // Order in [1, kMostOrder]; no start on a pole.
  GeodesicSeries(GeoPoint start, Bearing azimuth, int order);

  // Coefficients [deg/m^k] of the distance's powers 0..order. Longitude runs on across the antimeridian.
  using Coefficients = std::array<double, kMostOrder + 1>;
  int order;
  Coefficients latitude_deg{};
  Coefficients longitude_deg{};
};

}  // namespace yars::geo
