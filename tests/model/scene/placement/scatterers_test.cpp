// Scatterers: the faces in each ground square, summed to one scatterer. At each size of square (level) the areas add up
// to the area of the scene's faces.
// SphereTree: a search finds all balls that satisfy its condition.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "lib/geo/frames.hpp"
#include "model/scene/placement/placed_scene.hpp"
#include "model/scene/placement/scene_view.hpp"
#include "tests/model/scene/support.hpp"
#include "tests/model/terrain/shapes.hpp"

namespace yars::model::scene {
namespace {

constexpr geo::GeoPoint kScattererOrigin{37.5, -122.3};

std::shared_ptr<const Scatterers> scatterers_of(worldgen::OpenFlightWriter& writer,
                                                double max_reach_m = std::numeric_limits<double>::infinity()) {
  KindTable kinds;
  const terrain::AnalyticTerrain ground(terrain::flat(100.0));
  return place_model(read(writer), {.position = kScattererOrigin}, ground, 0, kinds, SceneUse::scatterers, max_reach_m)
      .scatterers;
}

double up_area(const ScattererLevel& level) {
  double sum = 0.0;
  for (const Scatterer& scatterer : level.scatterers)
    for (const Facing& facing : level.facings_of(scatterer)) sum += static_cast<double>(facing.up_m2);
  return sum;
}

double wall_area(const ScattererLevel& level) {
  double sum = 0.0;
  for (const Scatterer& scatterer : level.scatterers)
    for (const Facing& facing : level.facings_of(scatterer))
      sum += std::hypot(static_cast<double>(facing.east_m2), static_cast<double>(facing.north_m2));
  return sum;
}

TEST(Scatterers, OfALargeHallKeepItsArea) {
  worldgen::OpenFlightWriter writer(std::nullopt);
  worldgen::MeshBuilder mesh_builder(writer);
  writer.begin_object("hall");
  mesh_builder.kind = {1, 0, 0};
  mesh_builder.box({500, -300, 0}, 400, 200, 25);
  writer.end();
  const auto made = scatterers_of(writer);
  ASSERT_TRUE(made);
  for (std::size_t level = 0; level < kScattererSides_m.size(); ++level) {
    EXPECT_NEAR(up_area(made->levels[level]), 400.0 * 200.0, 1.0) << level;
    EXPECT_NEAR(wall_area(made->levels[level]), 2.0 * (400.0 + 200.0) * 25.0, 1.0) << level;
    for (const Scatterer& scatterer : made->levels[level].scatterers) {
      EXPECT_GE(scatterer.min_msl_m, 99.9F);
      EXPECT_LE(scatterer.max_msl_m, 125.1F);
      EXPECT_LE(scatterer.extent_m, static_cast<float>(kScattererSides_m[level]));
    }
  }
  EXPECT_GT(made->levels[0].scatterers.size(), 60U);
  EXPECT_LT(made->levels[3].scatterers.size(), 10U);
}

TEST(Scatterers, OfFlatFacesAreCovers) {
  worldgen::OpenFlightWriter writer(std::nullopt);
  writer.begin_object("apron");
  writer.face(square(0, 0, 320, 0.1), {9, 0, 0});
  writer.end();
  const auto made = scatterers_of(writer);
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->levels[0].scatterers.empty());
  double covered_m2 = 0.0;
  for (const auto& [key, cover] : made->levels[0].covers) covered_m2 += static_cast<double>(cover.share) * 32.0 * 32.0;
  EXPECT_NEAR(covered_m2, 320.0 * 320.0, 0.02 * 320.0 * 320.0);
  EXPECT_TRUE(made->levels[0].covers.contains(square_key(160.0, 160.0, 32.0)));
  EXPECT_FALSE(made->levels[0].covers.contains(square_key(-10.0, 160.0, 32.0)));
}

TEST(Scatterers, OfAFaceOfTwentyKilometresAreBoundedInNumber) {
  worldgen::OpenFlightWriter writer(std::nullopt);
  writer.begin_object("plate");
  writer.face(square(-10000, -10000, 20000, 50.0), {7, 0, 0});
  writer.end();
  const auto made = scatterers_of(writer);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->finest, 1U);
  EXPECT_NEAR(up_area(made->levels[1]), 4e8, 4e3);
  EXPECT_LT(made->levels[1].scatterers.size(), 1U << 18U);
}

TEST(Scatterers, OfAFlatFaceOf6000KilometresAreBoundedInNumber) {
  ScatterBuilder builder(std::numeric_limits<double>::infinity());
  builder.add_lying({geo::Vector3{-3e6, -3e6, 0}, geo::Vector3{3e6, -3e6, 0}, geo::Vector3{0, 3e6, 0}}, 7);
  for (double north_m = -1e6; north_m < 1e6; north_m += 16'000.0)
    for (double east_m = -1e6; east_m < 1e6; east_m += 16'000.0)
      builder.add_lying({geo::Vector3{east_m, north_m, 0}, geo::Vector3{east_m + 2000.0, north_m, 0},
                         geo::Vector3{east_m, north_m + 2000.0, 0}},
                        7);
  const auto made = builder.take(geo::AzimuthalEquidistant(kScattererOrigin));
  ASSERT_TRUE(made);
  EXPECT_EQ(made->finest, 3U);
  EXPECT_LE(made->levels[3].covers.size(), 1U << 18U);
}

TEST(Scatterers, BeyondTheMaximumReachAreLeftOut) {
  worldgen::OpenFlightWriter writer(std::nullopt);
  worldgen::MeshBuilder mesh_builder(writer);
  writer.begin_object("near and far");
  mesh_builder.box({112, 16, 0}, 10, 10, 10);
  mesh_builder.box({5000, 0, 0}, 10, 10, 10);
  writer.end();
  const auto made = scatterers_of(writer, 1000.0);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->levels[0].scatterers.size(), 1U);
  EXPECT_LT(made->reach_m, 500.0);
}

TEST(SphereTree, FindsEveryBallThatSatisfiesTheSearch) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> position(-4000.0, 4000.0);
  std::vector<Ball> balls;
  for (int i = 0; i < 3000; ++i) balls.push_back({{position(random), position(random), 0.0}, 5.0});
  std::vector<std::uint32_t> order;
  const SphereTree tree(balls, order);
  const geo::Vector3 here{1000.0, -500.0, 0.0};
  const auto meets = [&](const Ball& ball) { return length(ball.middle - here) <= 300.0 + ball.radius_m; };
  std::set<std::uint32_t> found;
  std::size_t visited = 0;
  tree.search(meets, [&](std::uint32_t first, std::uint32_t end) {
    visited += end - first;
    for (std::uint32_t i = first; i < end; ++i)
      if (meets(balls[order[i]])) found.insert(order[i]);
  });
  std::set<std::uint32_t> expected;
  for (std::uint32_t i = 0; i < balls.size(); ++i)
    if (meets(balls[i])) expected.insert(i);
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(found, expected);
  EXPECT_LT(visited, 8 * expected.size());
}

}  // namespace
}  // namespace yars::model::scene
