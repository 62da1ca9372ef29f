// Edges of triangles seen from above: the cheap check agrees with the length of the longest edge.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "model/scene/placement/geometry.hpp"

namespace yars::model::scene {
namespace {

TEST(PlanGeometry, HasNoLongerEdgeNeverMissesALongerEdge) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> metres(-50.0, 50.0);
  std::uniform_int_distribution<int> units(-3, 3);
  for (int i = 0; i < 100'000; ++i) {
    Corners3 corners;
    for (geo::Vector3& corner : corners) corner = {metres(random), metres(random), metres(random)};
    const double longest_m = longest_plan_edge(corners).length_m;
    // A limit at, or some roundings beside, the longest edge.
    double limit_m = longest_m;
    for (int step = units(random); step != 0; step += step < 0 ? 1 : -1)
      limit_m = std::nextafter(limit_m, step < 0 ? 0.0 : std::numeric_limits<double>::infinity());
    if (has_no_longer_edge(corners, limit_m)) {
      EXPECT_LE(longest_m, limit_m);
    }
    EXPECT_FALSE(has_no_longer_edge(corners, longest_m * (1.0 - 1e-9)));
    EXPECT_TRUE(has_no_longer_edge(corners, longest_m * (1.0 + 1e-9)));
  }
}

TEST(PlanGeometry, HasNoLongerEdgeIsFalseForNumbersThatAreNotKnown) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(has_no_longer_edge({geo::Vector3{unknown, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 100.0));
}

}  // namespace
}  // namespace yars::model::scene
