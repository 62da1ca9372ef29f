// Classes of posts from rasters of land cover: the class of most pixels, shares of water, other systems, gaps.
#include "model/terrain/gdal/land_cover.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/gdal/raster_builder.hpp"

namespace yars::model::terrain {
namespace {

using test::RasterFields;
using test::write_raster;
using ::testing::HasSubstr;

const std::vector<gdal::PixelClass> kLegend{{{10}}, {{20}}, {{80, 81}, true}};

// Raster of a degree whose pixels fill it, `pixels` on each side.
RasterFields filled_degree(int south_deg, int west_deg, int pixels) {
  const double step = 1.0 / pixels;
  RasterFields fields{pixels, pixels, {static_cast<double>(west_deg), step, 0, south_deg + 1.0, 0, -step}};
  fields.type = GDT_Byte;
  return fields;
}

// A class for each pixel without any order.
int mixed(int row, int column) {
  const unsigned bits = static_cast<unsigned>(row) * 0x9e3779b1U + static_cast<unsigned>(column) * 0x85ebca6bU;
  return std::vector<int>{10, 20, 80}[(bits ^ bits >> 15U) % 3U];
}

gdal::CoverPosts read(const std::vector<std::filesystem::path>& paths, int south, int west, int north, int east) {
  auto posts = gdal::read_cover(paths, kLegend, south, west, north, east);
  if (!posts) ADD_FAILURE() << posts.error().message();
  return posts ? *std::move(posts) : gdal::CoverPosts{};
}

// Votes of the pixels whose centres are in the square of a post.
struct Votes {
  std::map<int, int> of;
  int all = 0;
  void add(int value) {
    ++of[value];
    ++all;
  }
  // Of equally many the first of the legend, which has ascending values here.
  int winner() const {
    int best = 0, most = 0;
    for (const auto& [value, votes] : of)
      if (votes > most) best = value, most = votes;
    return best;
  }
  double water() const { return of.contains(80) ? of.at(80) / static_cast<double>(all) : 0.0; }
};

TEST(LandCover, APostHasTheClassOfMostPixelsAroundIt) {
  const test::TemporaryFolder folder;
  constexpr int kPixels = 720, kPosts = 121;
  write_raster(folder.path() / "a.tif", filled_degree(0, 6, kPixels), mixed);
  const gdal::CoverPosts posts = read({folder.path() / "a.tif"}, 0, 6, kPosts - 1, kPosts - 1);
  std::vector<Votes> votes(kPosts * kPosts);
  for (int row = 0; row < kPixels; ++row)
    for (int column = 0; column < kPixels; ++column) {
      const auto post = [](double pixel) { return static_cast<std::size_t>(std::floor(pixel / 6.0 + 0.5)); };
      const std::size_t north = post(kPixels - 1 - row + 0.5), east = post(column + 0.5);
      votes[north * kPosts + east].add(mixed(row, column));
    }
  for (std::size_t i = 0; i < votes.size(); ++i) {
    ASSERT_EQ(kLegend[posts.classes[i]].values.front(), votes[i].winner()) << i;
    ASSERT_NEAR(posts.water[i] / 255.0, votes[i].water(), 0.002) << i;
    if (posts.land[i] == gdal::kNoClass)
      ASSERT_EQ(posts.water[i], 255) << i;
    else
      ASSERT_FALSE(kLegend[posts.land[i]].water) << i;
  }
}

TEST(LandCover, BetweenPixelsAPostHasThePixelAtIt) {
  const test::TemporaryFolder folder;
  write_raster(folder.path() / "a.tif", filled_degree(50, -3, 40), mixed);
  const gdal::CoverPosts posts = read({folder.path() / "a.tif"}, 50, -3, 330, 330);
  for (int row = 1; row < 330; ++row)
    for (int column = 1; column < 330; ++column) {
      const double down = 40.0 * (330 - row) / 330, right = 40.0 * column / 330;
      if (std::abs(down - std::round(down)) < 1e-6 || std::abs(right - std::round(right)) < 1e-6) continue;
      ASSERT_EQ(
          kLegend[posts.classes[static_cast<std::size_t>(row) * 331 + static_cast<std::size_t>(column)]].values[0],
          mixed(static_cast<int>(down), static_cast<int>(right)))
          << row << ", " << column;
    }
}

TEST(LandCover, OfAnotherSystemIsThatOfItsPixels) {
  const test::TemporaryFolder folder;
  // 100 m pixels of ETRS89-LAEA over Denmark, whose rows are not parallels there.
  RasterFields fields{1500, 1500, {4250000, 100, 0, 3700000, 0, -100}};
  fields.epsg = 3035;
  fields.type = GDT_Byte;
  write_raster(folder.path() / "a.tif", fields, mixed);
  constexpr int kPosts = 241;
  const gdal::CoverPosts posts = read({folder.path() / "a.tif"}, 55, 9, kPosts - 1, kPosts - 1);
  const test::Transform to_degrees = test::transform_between("EPSG:3035", "EPSG:4326");
  std::vector<Votes> votes(kPosts * kPosts);
  for (int row = 0; row < fields.rows; ++row)
    for (int column = 0; column < fields.columns; ++column) {
      double east = 4250050.0 + 100.0 * column, north = 3699950.0 - 100.0 * row;
      ASSERT_NE(OCTTransform(to_degrees.get(), 1, &east, &north, nullptr), 0);
      const double post_row = std::round((north - 55.0) * (kPosts - 1)),
                   post_column = std::round((east - 9.0) * (kPosts - 1));
      if (post_row >= 0 && post_column >= 0 && post_row < kPosts && post_column < kPosts)
        votes[static_cast<std::size_t>(post_row) * kPosts + static_cast<std::size_t>(post_column)].add(
            mixed(row, column));
    }
  std::size_t inside = 0, equal = 0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (votes[i].all < 5) continue;
    ++inside;
    if (posts.classes[i] != gdal::kNoClass && kLegend[posts.classes[i]].values[0] == votes[i].winner()) ++equal;
  }
  EXPECT_GT(inside, 30'000U);
  EXPECT_GT(static_cast<double>(equal), 0.995 * static_cast<double>(inside))
      << "a pixel on an edge may be the next post's";
}

TEST(LandCover, GapsAreFilledFromTheNextRaster) {
  const test::TemporaryFolder folder;
  RasterFields fields = filled_degree(10, 20, 240);
  fields.void_value = 0;
  write_raster(folder.path() / "a.tif", fields, [](int row, int) { return row < 120 ? 0 : 10; });
  write_raster(folder.path() / "b.tif", filled_degree(10, 20, 240),
               [](int, int column) { return column < 120 ? 20 : 7; });
  const gdal::CoverPosts posts = read({folder.path() / "a.tif", folder.path() / "b.tif"}, 10, 20, 60, 60);
  const auto at = [&](int row, int column) {
    return posts.classes[static_cast<std::size_t>(row) * 61 + static_cast<std::size_t>(column)];
  };
  EXPECT_EQ(at(10, 10), 0);
  EXPECT_EQ(at(10, 50), 0);
  EXPECT_EQ(at(50, 10), 1);
  EXPECT_EQ(at(50, 50), gdal::kNoClass);
  ASSERT_TRUE(posts.unknown.contains(7));
  EXPECT_GT(posts.unknown.at(7), 10'000U);
  EXPECT_EQ(posts.unknown.size(), 1U) << "pixels without data are not unknown";
}

TEST(LandCover, ABandOfHeightsOrOfColoursIsRefused) {
  const test::TemporaryFolder folder;
  RasterFields fields = filled_degree(10, 20, 20);
  fields.type = GDT_Float32;
  write_raster(folder.path() / "float.tif", fields, [](int, int) { return 10; });
  fields.type = GDT_Byte;
  fields.bands = 3;
  write_raster(folder.path() / "rgb.tif", fields, [](int, int) { return 10; });
  for (const char* name : {"float.tif", "rgb.tif", "absent.tif"}) {
    const auto summary = gdal::describe_cover(folder.path() / name);
    ASSERT_FALSE(summary.has_value()) << name;
    EXPECT_THAT(summary.error().message(), HasSubstr("classes")) << name;
  }
}

TEST(LandCover, ItsDetailIsThatOfItsPixels) {
  const test::TemporaryFolder folder;
  write_raster(folder.path() / "a.tif", filled_degree(-36, 149, 400), mixed);
  const auto summary = gdal::describe_cover(folder.path() / "a.tif");
  ASSERT_TRUE(summary.has_value()) << summary.error().message();
  EXPECT_EQ(summary->cells.size(), 1U);
  EXPECT_NEAR(summary->pixels_per_degree, 400.0, 0.1);
}

}  // namespace
}  // namespace yars::model::terrain
