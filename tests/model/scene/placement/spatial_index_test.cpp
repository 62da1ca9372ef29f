// GridIndex against a test of every disc: at middle latitudes, at the antimeridian and about both poles.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/random/counter_rng.hpp"
#include "model/scene/placement/geometry.hpp"

namespace yars::model::scene {
namespace {

// 2,000 discs within 3 degrees of a centre, so that a search does not fall back to testing every disc.
std::vector<Disc> discs_about(geo::GeoPoint centre) {
  random::CounterRng rng(5);
  std::vector<Disc> discs;
  for (int i = 0; i < 2000; ++i)
    discs.push_back({geo::geodesic_direct(centre, geo::Bearing::degrees(rng.uniform(0.0, 360.0)),
                                          geo::Length::metres(rng.uniform(0.0, 330e3))),
                     rng.uniform(0.0, 3000.0)});
  return discs;
}

class GridIndexAbout : public ::testing::TestWithParam<geo::GeoPoint> {};
INSTANTIATE_TEST_SUITE_P(Earth, GridIndexAbout,
                         ::testing::Values(geo::GeoPoint{37.0, -122.0}, geo::GeoPoint{-17.0, 179.9},
                                           geo::GeoPoint{89.0, 30.0}, geo::GeoPoint{-89.7, -100.0},
                                           geo::GeoPoint{86.0, -179.0}));

TEST_P(GridIndexAbout, FindsAllDiscsThatOverlapTheCircleAndNoOther) {
  const std::vector<Disc> discs = discs_about(GetParam());
  const GridIndex index(discs, 0.2);
  random::CounterRng rng(6);
  std::size_t found = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const geo::GeoPoint position = geo::geodesic_direct(GetParam(), geo::Bearing::degrees(rng.uniform(0.0, 360.0)),
                                                        geo::Length::metres(rng.uniform(0.0, 200e3)));
    const double radius_m = rng.uniform(1e3, 200e3);
    std::vector<GridIndex::Hit> hits;
    index.find(position, radius_m, hits);
    std::sort(hits.begin(), hits.end());
    for (std::uint32_t number = 0; number < discs.size(); ++number) {
      const double distance_m = geo::geodesic_inverse(position, discs[number].middle).distance.metres();
      const double overlap_m = radius_m + discs[number].radius_m - distance_m;
      if (std::abs(overlap_m) < 1.0) continue;  // accuracy of the distances
      const bool is_hit = std::binary_search(hits.begin(), hits.end(), GridIndex::Hit{number, 0.0});
      ASSERT_EQ(is_hit, overlap_m > 0.0) << "disc " << number << " at " << discs[number].middle.latitude_deg << ", "
                                         << discs[number].middle.longitude_deg << ", " << distance_m << " m away";
      found += is_hit ? 1U : 0U;
    }
  }
  EXPECT_GT(found, 10000U);
}

}  // namespace
}  // namespace yars::model::scene
