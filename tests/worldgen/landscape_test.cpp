// The landscape generator: equal edges, repeatability, the default region. The DTED writer: files, zones and errors.
#include "worldgen/terrain/landscape.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/terrain/formats/dted.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"

namespace yars::model::terrain {
namespace {

using namespace worldgen;

constexpr int kRows = 121;  // DTED level 0

// A cell with the posts of DTED level 0.
Cell level_0(const Landscape& landscape, CellCorner corner) {
  return landscape.cell(corner, kRows, dted_columns(corner, 0));
}

// Expects equal posts on the common edge; compares only posts that both cells have.
void expect_equal_north_south(const Cell& south, const Cell& north) {
  const int common = std::min(south.columns(), north.columns()) - 1;
  for (int post = 0; post <= common; ++post)
    ASSERT_EQ(south.post(kRows - 1, post * (south.columns() - 1) / common),
              north.post(0, post * (north.columns() - 1) / common))
        << "post " << post;
}

void expect_equal_west_east(const Cell& west, const Cell& east) {
  for (int row = 0; row < kRows; ++row)
    ASSERT_EQ(west.post(row, west.columns() - 1), east.post(row, 0)) << "row " << row;
}

TEST(Landscape, NeighboursShareTheirEdges) {
  const Landscape landscape(DefaultLandscape::kSeed);
  const Cell here = level_0(landscape, {38, -123});
  ASSERT_GT(here.highest_m() - here.lowest_m(), 500) << "in a flat cell all edges would be equal";
  expect_equal_west_east(here, level_0(landscape, {38, -122}));
  expect_equal_north_south(here, level_0(landscape, {39, -123}));
}

TEST(Landscape, CellsAreEqualAtTheAntimeridian) {
  const Landscape landscape(DefaultLandscape::kSeed);
  expect_equal_west_east(level_0(landscape, {10, 179}), level_0(landscape, {10, -180}));
}

TEST(Landscape, CellsOfDifferentDtedZonesShareTheirEdge) {
  const Landscape landscape(DefaultLandscape::kSeed);
  const Cell south = level_0(landscape, {49, 10});
  const Cell north = level_0(landscape, {50, 10});
  ASSERT_EQ(north.columns(), 61);
  expect_equal_north_south(south, north);
}

TEST(Landscape, OneSeedAlwaysGivesTheSamePostsAndAnotherSeedOthers) {
  const CellCorner corner{37, -122};
  const Cell first = level_0(Landscape(12), corner);
  const Cell again = level_0(Landscape(12), corner);
  const Cell other = level_0(Landscape(13), corner);
  EXPECT_EQ(first.posts(), again.posts());
  EXPECT_NE(first.posts(), other.posts());
}

TEST(Landscape, PolarCellsHaveNoVoids) {
  const Landscape landscape(DefaultLandscape::kSeed);
  EXPECT_EQ(level_0(landscape, {89, 0}).voids(), 0U);
  EXPECT_EQ(level_0(landscape, {-90, -180}).voids(), 0U);
}

TEST(Landscape, TheDefaultRegionHasSeaPlainAndMountains) {
  const Landscape landscape(DefaultLandscape::kSeed);
  std::size_t sea = 0;
  std::size_t plain = 0;
  std::size_t posts = 0;
  int highest_m = 0;
  for (int row = 0; row < DefaultLandscape::kCellsNorth; ++row)
    for (int column = 0; column < DefaultLandscape::kCellsEast; ++column) {
      const Cell cell = level_0(landscape, {DefaultLandscape::kSouth_deg + row, DefaultLandscape::kWest_deg + column});
      const auto heights = cell.posts();
      posts += heights.size();
      sea += cell.sea_posts();
      plain += static_cast<std::size_t>(
          std::count_if(heights.begin(), heights.end(), [](std::int16_t post) { return post > 0 && post < 300; }));
      highest_m = std::max(highest_m, static_cast<int>(cell.highest_m()));
      EXPECT_GE(cell.lowest_m(), 0);
      EXPECT_EQ(cell.voids(), 0U);
    }
  EXPECT_GT(sea, posts / 5);
  EXPECT_LT(sea, posts * 3 / 5);
  EXPECT_GT(plain, posts / 20);
  EXPECT_GT(highest_m, 2000);
  EXPECT_LT(highest_m, 6000);
}

TEST(DtedWriter, TheReaderReadsTheSamePosts) {
  const test::TemporaryFolder folder;
  const CellCorner corner{-54, -70};  // southern and western hemisphere; DTED zone II (half the columns)
  std::vector<std::int16_t> posts;
  for (int i = 0; i < 121 * 61; ++i)
    posts.push_back(static_cast<std::int16_t>(i % 97 == 0 ? kVoidPost : i % 4000 - 400));
  const Cell cell(corner, 121, 61, posts);
  const auto path = write_dted(folder.path(), cell, 0);
  ASSERT_TRUE(path.has_value()) << path.error().message();
  EXPECT_EQ(path->string(), (folder.path() / "w070/s54.dt0").string());
  const auto reading = read_dted(*path, corner);
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  EXPECT_TRUE(reading->warnings.empty());
  EXPECT_EQ(reading->cell.posts(), posts);
}

TEST(DtedWriter, RecordsAreByteExact) {
  std::vector<std::int16_t> posts(121 * 121, 3);
  posts[121] = -2;  // second row, first column
  const auto bytes = dted_bytes(Cell({50, 10}, 121, 121, posts), 0);
  ASSERT_EQ(bytes.size(), 3428U + 121U * (12 + 242));
  // Expected bytes from DtedFile, which is independent of the writer.
  test::DtedFile expected;
  for (int column = 0; column < 121; ++column) {
    expected.columns.push_back({.longitude_index = column, .words = std::vector<std::uint16_t>(121, 3)});
    if (column == 0) expected.columns.back().words[1] = 0x8002;
  }
  const auto records = expected.bytes();
  EXPECT_TRUE(std::equal(records.begin() + 3428, records.end(), bytes.begin() + 3428, bytes.end()));
  const std::string header(reinterpret_cast<const char*>(bytes.data()), 80);
  EXPECT_EQ(header.substr(0, 28), "UHL10100000E0500000N03000300");
  EXPECT_EQ(header.substr(47, 8), "01210121");
}

TEST(DtedWriter, AFolderThatCannotBeMadeIsAnError) {
  const test::TemporaryFolder folder;
  folder.write("blocked", std::vector<std::byte>(1));
  const auto path =
      write_dted(folder.path() / "blocked", Cell({50, 10}, 121, 121, std::vector<std::int16_t>(121 * 121)), 0);
  EXPECT_FALSE(path.has_value());
}

TEST(DtedZones, HaveFewerColumnsTowardThePoles) {
  EXPECT_EQ(dted_columns({49, 0}, 1), 1201);
  EXPECT_EQ(dted_columns({50, 0}, 1), 601);
  EXPECT_EQ(dted_columns({-51, 0}, 1), 601);
  EXPECT_EQ(dted_columns({-50, 0}, 1), 1201);
  EXPECT_EQ(dted_columns({70, 0}, 1), 401);
  EXPECT_EQ(dted_columns({75, 0}, 1), 301);
  EXPECT_EQ(dted_columns({80, 0}, 1), 201);
}

}  // namespace
}  // namespace yars::model::terrain
