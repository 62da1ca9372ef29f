// TileBuilders: conversion of triangles to tiles of 128 m square. Shared vertices, and squares with more than one tile.
#include "model/scene/placement/tile_builder.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "lib/geo/frames.hpp"

namespace yars::model::scene {
namespace {

constexpr geo::GeoPoint kTileOrigin{37.5, -122.0};

// Level right-angled triangle: the right angle is at `position`, the legs point east and north.
std::array<PlacedCorner, 3> triangle_at(Vector3 position, double side_m, const std::array<Vector3, 3>& normals) {
  return {PlacedCorner{position, normals[0], kNone}, PlacedCorner{position + Vector3{side_m, 0, 0}, normals[1], kNone},
          PlacedCorner{position + Vector3{0, side_m, 0}, normals[2], kNone}};
}
constexpr std::array<Vector3, 3> kUp{Vector3{0, 0, 1}, Vector3{0, 0, 1}, Vector3{0, 0, 1}};

TEST(TileBuilders, FlatTrianglesShareVerticesAtOnePosition) {
  TileBuilders builders{geo::AzimuthalEquidistant(kTileOrigin), 0};
  builders.add(triangle_at({10, 10, 5}, 4, kUp), {});
  builders.add(triangle_at({10, 10, 5}, 8, kUp), {});
  builders.add(triangle_at({10, 10, 6}, 4, kUp), {});
  const std::vector<Tile> tiles = builders.take(5);
  ASSERT_EQ(tiles.size(), 1U);
  EXPECT_EQ(tiles[0].triangles(), 3U);
  EXPECT_EQ(tiles[0].east_m.size(), 5U + 3U);
  EXPECT_EQ(tiles[0].first_with_normal, 5U + 3U);
  EXPECT_TRUE(tiles[0].normal_up.empty());
  EXPECT_EQ(tiles[0].corners(0)[0], tiles[0].corners(1)[0]);
  EXPECT_NE(tiles[0].corners(0)[0], tiles[0].corners(2)[0]);
}

TEST(TileBuilders, VerticesOfACurvedTriangleHaveNormals) {
  constexpr Vector3 kLeaning{0.6, 0, 0.8};
  TileBuilders builders{geo::AzimuthalEquidistant(kTileOrigin), 0};
  builders.add(triangle_at({10, 10, 5}, 4, {kLeaning, kUp[1], kUp[2]}), {1, 0, false});
  builders.add(triangle_at({10, 10, 5}, 4, kUp), {2, 0, false});
  const std::vector<Tile> tiles = builders.take(5);
  ASSERT_EQ(tiles.size(), 1U);
  const Tile& tile = tiles[0];
  EXPECT_EQ(tile.kind, (std::vector<std::uint16_t>{1, 2}));
  EXPECT_EQ(tile.first_with_normal, 3U);
  ASSERT_EQ(tile.normal_east.size(), 3U);
  ASSERT_EQ(tile.east_m.size(), 6U);
  for (const std::size_t corner : tile.corners(0)) EXPECT_GE(corner, tile.first_with_normal);
  for (const std::size_t corner : tile.corners(1)) EXPECT_LT(corner, tile.first_with_normal);
  EXPECT_FLOAT_EQ(tile.normal_east[tile.corners(0)[0] - tile.first_with_normal], 0.6F);
  EXPECT_FLOAT_EQ(tile.normal_up[tile.corners(0)[1] - tile.first_with_normal], 1.0F);
}

TEST(TileBuilders, ASquareWithTooManyVerticesForOneTileBecomesSeveralTilesInOrder) {
  constexpr std::uint32_t kTriangles = 50'000;
  TileBuilders builders{geo::AzimuthalEquidistant(kTileOrigin), 0};
  for (std::uint32_t i = 0; i < kTriangles; ++i)
    builders.add(triangle_at({10.0 + 0.01 * (i % 1000), 10.0 + 0.01 * i / 1000, 5}, 1, kUp), {0, i, i % 2 == 0});
  const std::vector<Tile> tiles = builders.take(5);
  EXPECT_GT(tiles.size(), 2U);
  std::uint32_t sum = 0;
  for (const Tile& tile : tiles) {
    EXPECT_LE(tile.east_m.size(), Tile::kMaxVertices);
    EXPECT_EQ(tile.origin.latitude_deg, tiles[0].origin.latitude_deg);
    for (std::size_t t = 0; t < tile.triangles(); ++t) {
      const std::uint32_t number = tile.object[t];
      EXPECT_GE(number, sum);
      const auto expected_east_m = static_cast<double>(10.0 + 0.01 * (number % 1000));
      const auto east_m = static_cast<double>(tile.east_m[tile.corners(t)[0]]);
      const auto first_east_m = static_cast<double>(tile.east_m[tile.corners(0)[0]]);
      const auto expected_first_east_m = static_cast<double>(10.0 + 0.01 * (tile.object[0] % 1000));
      EXPECT_NEAR(east_m - first_east_m, expected_east_m - expected_first_east_m, 1e-4);
    }
    sum += static_cast<std::uint32_t>(tile.triangles());
  }
  EXPECT_EQ(sum, kTriangles);
}

}  // namespace
}  // namespace yars::model::scene
