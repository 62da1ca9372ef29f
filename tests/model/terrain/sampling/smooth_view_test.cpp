// Smooth view: accuracy of its slopes against finer posts; posts, voids, level water and boxes that it must not change.
// Facets: the ground with bilinear interpolation between posts.
#include "model/terrain/sampling/smooth_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <vector>

#include "lib/radar/world.hpp"
#include "model/terrain/sampling/cell_view.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/lib/simd/vector_targets.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"
#include "tests/model/terrain/shared_data.hpp"

namespace yars::model::terrain {
namespace {

constexpr int kPosts = 401;  // posts a degree: 9 arc seconds apart, 278 m along a meridian
constexpr GeoBox kBox{37.4, 37.5, -122.6, -122.5};

std::shared_ptr<CellView> view_of(const std::function<int(int, int)>& height, CellCorner corner = {37, -123}) {
  auto view = std::make_shared<CellView>(1, Absence::none);
  view->add(std::make_shared<const Cell>(test::cell_of(corner, kPosts, kPosts, height)));
  return view;
}

int hills(int row, int column) {
  return static_cast<int>(600.0 + 250.0 * std::sin(row * 0.5) * std::cos(column * 0.4) + 40.0 * std::sin(row * 1.7));
}

// Rms difference of the slopes of two grounds, to the north and to the east, over a grid in the box.
using Height = std::function<double(geo::GeoPoint)>;
double slope_error(const Height& found, const Height& wanted, const GeoBox& box, double step_deg) {
  const double north_m = 111'000.0 * step_deg;
  const double east_m = north_m * std::cos(0.5 * (box.south_deg + box.north_deg) * geo::kRadiansPerDegree);
  double squares = 0.0, count = 0.0;
  for (double north = box.south_deg; north < box.north_deg; north += step_deg)
    for (double east = box.west_deg; east < box.east_deg; east += step_deg) {
      const auto off = [&](geo::GeoPoint position) { return found(position) - wanted(position); };
      const double here = off({north, east});
      const double up = (off({north + step_deg, east}) - here) / north_m;
      const double right = (off({north, east + step_deg}) - here) / east_m;
      if (std::isnan(up + right)) continue;
      squares += up * up + right * right;
      count += 1.0;
    }
  return std::sqrt(squares / count);
}

Height heights_of(const TerrainViewPointer& view) {
  return [view](geo::GeoPoint position) { return view->elevation_m(position); };
}

TEST(SmoothGround, ComesNearerToTheSlopesOfHillsThanFacets) {
  const auto hill_m = [](geo::GeoPoint position) {
    return 600.0 + 250.0 * std::sin((position.latitude_deg - 37.0) * 200.0) *
                       std::cos((position.longitude_deg + 123.0) * 160.0);
  };
  const auto facets = view_of([&](int row, int column) {
    return static_cast<int>(std::lround(hill_m({37.0 + row / 400.0, -123.0 + column / 400.0})));
  });
  const auto smooth = smooth_between_posts(facets, {kBox, 20.0, 60.0});
  const double by_facets = slope_error(heights_of(facets), hill_m, kBox, 0.0003);
  const double by_curves = slope_error(heights_of(smooth), hill_m, kBox, 0.0003);
  std::printf("slopes of hills: facets %.4f, smooth %.4f RMS\n", by_facets, by_curves);
  EXPECT_LT(by_curves, 0.5 * by_facets);
}

// Posts of 3 arc seconds are thinned to every third post; the slopes of the original posts are the reference.
TEST(SmoothGround, ComesNearerToTheSlopesOfRealPostsThanFacets) {
  YARS_NEEDS_SHARED_DATA();
  struct Area {
    const char* folder;
    GeoBox box;
  };
  for (const Area& area : {Area{"srtm", {38.7, 38.95, -114.5, -114.2}}, Area{"srtm", {36.2, 36.5, -121.8, -121.5}},
                           Area{"dted", {0.3, 0.6, 6.5, 6.8}}, Area{"srtm", {44.1, 44.4, -71.6, -71.3}}}) {
    auto store = open_terrain({(test::shared_data() / area.folder).string(), true});
    ASSERT_TRUE(store);
    const geo::GeoPoint middle{0.5 * (area.box.south_deg + area.box.north_deg),
                               0.5 * (area.box.west_deg + area.box.east_deg)};
    const TerrainViewPointer fine = (*store)->prepare({middle, 40000.0, 0});
    const auto cells = fine->cells_within(area.box);
    ASSERT_EQ(cells.size(), 1U);
    const Cell& cell = *cells[0];
    auto thinned = std::make_shared<CellView>(1, Absence::none);
    thinned->add(std::make_shared<const Cell>(
        test::cell_of(cell.corner(), (cell.rows() - 1) / 3 + 1, (cell.columns() - 1) / 3 + 1,
                      [&](int row, int column) { return int{cell.post(3 * row, 3 * column)}; })));
    const auto smooth = smooth_between_posts(thinned, {area.box, 20.0, 60.0});
    ASSERT_NE(smooth, thinned);
    const double by_facets = slope_error(heights_of(thinned), heights_of(fine), area.box, 1.0 / 1200.0);
    const double by_curves = slope_error(heights_of(smooth), heights_of(fine), area.box, 1.0 / 1200.0);
    std::printf("%.1f N %.1f E: facets %.4f, smooth %.4f RMS\n", middle.latitude_deg, middle.longitude_deg, by_facets,
                by_curves);
    EXPECT_LT(by_curves, by_facets);
  }
}

// SmoothParameters::min_parts is limited to 1 to 64: memory grows with the parts, and an interval needs one part.
TEST(SmoothGround, HasOneTo64PartsPerPostInterval) {
  const auto facets = view_of(hills);
  const GeoBox box{37.40, 37.41, -122.60, -122.59};
  const auto with_parts = [&](int parts, double spacing_m) {
    return smooth_between_posts(facets, {.box = box, .spacing_m = spacing_m, .posts_m = 60.0, .min_parts = parts});
  };
  const auto expect_same = [&](const TerrainViewPointer& found, const TerrainViewPointer& wanted) {
    for (double north = 37.4005; north < 37.41; north += 0.000321)
      for (double east = -122.5995; east < -122.59; east += 0.000321)
        ASSERT_EQ(found->elevation_m({north, east}), wanted->elevation_m({north, east})) << north << ' ' << east;
  };
  expect_same(with_parts(100, 1.0), with_parts(64, 1.0));
  expect_same(with_parts(0, 1e6), with_parts(1, 1e6));
}

TEST(SmoothGround, KeepsPostsAndStaysBetweenTheFourPostsAroundAPosition) {
  const auto facets =
      view_of([](int row, int column) { return hills(row, column) * ((row + column) % 7 == 0 ? 2 : 1); });
  const auto smooth = smooth_between_posts(facets, {kBox, 20.0, 60.0});
  const Cell& cell = *facets->cells_within(kBox)[0];
  for (int row = 162; row < 198; ++row)
    for (int column = 162; column < 198; ++column) {
      const auto at = [&](double up, double right) {
        return smooth->elevation_m({37.0 + (row + up) / 400.0, -123.0 + (column + right) / 400.0});
      };
      const auto post = [&](int up, int right) { return double{1} * cell.post(row + up, column + right); };
      EXPECT_NEAR(at(1e-9, 1e-9), post(0, 0), 1e-3);
      const double least = std::min({post(0, 0), post(0, 1), post(1, 0), post(1, 1)});
      const double most = std::max({post(0, 0), post(0, 1), post(1, 0), post(1, 1)});
      for (const double up : {0.1, 0.5, 0.83})
        for (const double right : {0.2, 0.5, 0.9}) {
          EXPECT_GE(at(up, right), least - 1e-3);
          EXPECT_LE(at(up, right), most + 1e-3);
        }
    }
}

// A lake at 640 m among hills, and the sea in front of a cliff.
TEST(SmoothGround, LeavesLevelWaterLevel) {
  const auto facets = view_of([](int row, int column) {
    if (row < 180) return 0;
    return column < 180 ? 640 : hills(row, column);
  });
  const auto smooth = smooth_between_posts(facets, {kBox, 20.0, 60.0});
  for (double up = 0.0; up < 1.0; up += 0.07)
    for (double right = 0.0; right < 1.0; right += 0.07) {
      EXPECT_EQ(smooth->elevation_m({37.0 + (178.0 + up) / 400.0, -123.0 + (190.0 + right) / 400.0}), 0.0);
      EXPECT_NEAR(smooth->elevation_m({37.0 + (181.0 + up) / 400.0, -123.0 + (177.0 + right) / 400.0}), 640.0, 1e-9);
    }
  EXPECT_GT(smooth->surface_at({37.0 + 178.5 / 400.0, -122.5}).water, 0.99);
}

TEST(SmoothGround, HasTheVoidsOfTheFacetsAndPlausibleHeightsBesideThem) {
  const auto hole = [](int row, int column) { return row > 175 && row < 181 && column > 175 && column < 180; };
  const auto holed =
      view_of([&](int row, int column) { return hole(row, column) ? int{kVoidPost} : 500 + row + column; });
  const auto smooth = smooth_between_posts(holed, {kBox, 20.0, 60.0});
  ASSERT_NE(smooth, holed);
  for (double row = 172.03; row < 184.0; row += 0.11)
    for (double column = 172.07; column < 184.0; column += 0.13) {
      const geo::GeoPoint position{37.0 + row / 400.0, -123.0 + column / 400.0};
      const double facet_m = holed->elevation_m(position), smooth_m = smooth->elevation_m(position);
      EXPECT_EQ(std::isnan(facet_m), std::isnan(smooth_m)) << row << ' ' << column;
      if (std::isnan(smooth_m)) continue;
      EXPECT_GT(smooth_m, 840.0) << row << ' ' << column;
      EXPECT_LT(smooth_m, 870.0) << row << ' ' << column;
    }
}

TEST(SmoothGround, IsContinuousAcrossTheEdgesOfCells) {
  auto facets = std::make_shared<CellView>(1, Absence::none);
  for (const int west : {-123, -122})
    for (const int south : {37, 38})
      facets->add(std::make_shared<const Cell>(test::cell_of({south, west}, kPosts, kPosts, [&](int row, int column) {
        return hills(row + (south - 37) * (kPosts - 1), column + (west + 123) * (kPosts - 1));
      })));
  const auto smooth = smooth_between_posts(facets, {{37.9, 38.1, -122.1, -121.9}, 20.0, 60.0});
  // The same heights within one cell.
  const auto within = view_of([](int row, int column) { return hills(row + 200, column + 200); });
  const auto whole = smooth_between_posts(within, {{37.4, 37.6, -122.6, -122.4}, 20.0, 60.0});
  for (double off = -0.03; off < 0.03; off += 0.000173) {
    EXPECT_NEAR(smooth->elevation_m({38.0 + off, -122.0 + 0.7 * off}),
                whole->elevation_m({37.5 + off, -122.5 + 0.7 * off}), 0.3)
        << off;
    EXPECT_NEAR(smooth->elevation_m({38.0, -122.0 + off}), smooth->elevation_m({38.0 - 1e-9, -122.0 + off}), 0.01);
    EXPECT_NEAR(smooth->elevation_m({38.0 + off, -122.0}), smooth->elevation_m({38.0 + off, -122.0 - 1e-9}), 0.01);
  }
}

TEST(SmoothGround, IsBilinearInPlainBoxesAndHasNoStepAtTheirEdges) {
  const auto facets = view_of(hills);
  const GeoBox yard{37.445, 37.455, -122.555, -122.545};
  const auto smooth = smooth_between_posts(facets, {kBox, 20.0, 60.0, 6, {yard}});
  const auto free = smooth_between_posts(facets, {kBox, 20.0, 60.0});
  double most_m = 0.0;
  for (double north = yard.south_deg; north <= yard.north_deg; north += 0.0003)
    for (double east = yard.west_deg; east <= yard.east_deg; east += 0.0003) {
      EXPECT_NEAR(smooth->elevation_m({north, east}), facets->elevation_m({north, east}), 1e-3);
      most_m = std::max(most_m, std::abs(free->elevation_m({north, east}) - facets->elevation_m({north, east})));
    }
  EXPECT_GT(most_m, 3.0) << "else the plain box changes nothing";
  EXPECT_NEAR(smooth->elevation_m({37.48, -122.52}), free->elevation_m({37.48, -122.52}), 1e-6);
  constexpr double kStep_deg = 1e-5;  // 1.1 m along a meridian
  for (double north = yard.south_deg - 0.01; north < yard.north_deg + 0.01; north += kStep_deg)
    EXPECT_NEAR(smooth->elevation_m({north + kStep_deg, -122.551}), smooth->elevation_m({north, -122.551}), 1.5);
}

TEST(SmoothGround, IsTheGivenViewWherePostsAreCloseOrAbsentOrNearThePoles) {
  const auto facets = view_of(hills);
  EXPECT_EQ(smooth_between_posts(facets, {kBox, 100.0, 300.0}), facets);
  EXPECT_EQ(smooth_between_posts(facets, {{10.0, 10.1, 5.0, 5.1}, 20.0, 60.0}), facets);
  EXPECT_EQ(smooth_between_posts(facets, {{88.5, 88.6, 5.0, 5.1}, 20.0, 60.0}), facets);
}

TEST(SmoothGround, IsTheSameInRunsAsAtSinglePositionsForEveryVectorWidth) {
  const auto facets = view_of([](int row, int column) {
    if (row % 37 == 5 && column % 11 < 3) return int{kVoidPost};
    return column % 23 == 0 ? 0 : hills(row, column);
  });
  const auto smooth = smooth_between_posts(facets, {kBox, 20.0, 60.0});
  constexpr std::size_t kCount = 301;  // positions; the first and the last of them lie outside the box
  std::vector<float> zeros(kCount + kRunSlack), north(zeros), east(zeros);
  for (std::size_t i = 0; i < kCount; ++i) {
    north[i] = 0.38F + 0.0005F * static_cast<float>(i);
    east[i] = 0.41F + 0.0003F * static_cast<float>(i);
  }
  const PositionRun run{
      {37, -123}, {zeros.data(), kCount}, {zeros.data(), kCount}, {north.data(), kCount}, {east.data(), kCount}};
  std::vector<float> first;
  test::for_each_vector_target([&](const char* name) {
    std::vector<float> elevation(kCount + kRunSlack), water(elevation);
    EXPECT_EQ(smooth->surfaces(run, radar::Interpolation::bilinear,
                               {std::span(elevation).first(kCount), std::span(water).first(kCount), {}, {}}),
              0U);
    elevation.resize(kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
      const Surface wanted = smooth->surface_at(position_of(run, i));
      ASSERT_EQ(std::isnan(elevation[i]), std::isnan(wanted.elevation_m)) << name << ' ' << i;
      EXPECT_NEAR(static_cast<double>(water[i]), wanted.water, 1e-3) << name << ' ' << i;
      if (std::isnan(elevation[i])) {
        elevation[i] = -1.0F;
      } else {
        EXPECT_NEAR(static_cast<double>(elevation[i]), wanted.elevation_m, 0.1) << name << ' ' << i;
      }
    }
    if (first.empty()) first = elevation;
    EXPECT_EQ(elevation, first) << name;
  });
}

}  // namespace
}  // namespace yars::model::terrain
