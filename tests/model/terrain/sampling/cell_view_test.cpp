// CellView: interpolation, edges, voids, water and materials; its fast path against double precision and between vector
// widths.
#include "model/terrain/sampling/cell_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "tests/lib/simd/vector_targets.hpp"
#include "tests/model/terrain/sampling/fast_path.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"

namespace yars::model::terrain {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::shared_ptr<const Cell> cell(CellCorner corner, int rows, int columns, const std::function<int(int, int)>& height) {
  std::vector<std::int16_t> posts;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) posts.push_back(static_cast<std::int16_t>(height(row, column)));
  return std::make_shared<const Cell>(corner, rows, columns, std::move(posts));
}

// Results of the fast path at one position.
struct Answer {
  float elevation_m = 0;
  float water = 0;
  std::size_t not_loaded = 0;
};
Answer fast(const TerrainView& view, double latitude_deg, double longitude_deg) {
  const auto found = test::fast_path(view, {{latitude_deg, longitude_deg}});
  return {found.elevation_m[0], found.water[0], found.not_loaded};
}

TEST(CellView, BilinearIsExactOnAPlaneWhateverTheSpacing) {
  CellView view(1, Absence::sea);
  view.add(cell({50, 10}, 11, 6, [](int row, int column) { return 100 + 20 * row + 50 * column; }));
  for (const double north : {0.0, 0.05, 0.37, 0.999})
    for (const double east : {0.0, 0.1, 0.61, 0.999})
      EXPECT_NEAR(view.elevation_m({50 + north, 10 + east}), 100 + 200 * north + 250 * east, 1e-9);
}

// Four cells that meet at 10 N, at the antimeridian. All edges of the north-east one are void but for its interior, as
// of an HGT tile whose maker had no neighbour.
TEST(CellView, AWholeDegreeHasTheHeightOfTheCellThatHasOne) {
  CellView view(1, Absence::none);
  const auto inner = [](int row, int column) {
    const bool edge = row == 0 || column == 0 || row == 10 || column == 10;
    return edge ? int{kVoidPost} : 500;
  };
  view.add(cell({10, -180}, 11, 11, inner));
  view.add(cell({9, -180}, 11, 11, [](int row, int) { return 90 + row; }));
  view.add(cell({10, 179}, 11, 11, [](int, int column) { return 190 + column; }));
  view.add(cell({9, 179}, 11, 11, inner));
  const auto expect = [&](double latitude_deg, double longitude_deg, double height_m) {
    EXPECT_EQ(view.elevation_m({latitude_deg, longitude_deg}), height_m) << latitude_deg << ' ' << longitude_deg;
    EXPECT_EQ(fast(view, latitude_deg, longitude_deg).elevation_m, static_cast<float>(height_m))
        << latitude_deg << ' ' << longitude_deg;
  };
  expect(10.0, -179.5, 100);
  expect(10.5, -180.0, 200);
  expect(10.5, 180.0, 200);
  expect(10.0, -180.0, 100);
  expect(10.0, 179.5, 195);  // the cell itself has the height
  expect(10.5, -179.5, 500);
  EXPECT_TRUE(std::isnan(view.elevation_m({9.0, 179.5}))) << "no cell has a height there";
  EXPECT_TRUE(std::isnan(fast(view, 9.0, 179.5).elevation_m));
}

TEST(CellView, CellsMeetAtTheAntimeridianForAnyLongitude) {
  CellView view(1, Absence::none);
  view.add(cell({10, 179}, 2, 2, [](int, int) { return 5; }));
  view.add(cell({10, -180}, 2, 2, [](int, int) { return 7; }));
  EXPECT_EQ(view.elevation_m({10.5, 179.9}), 5);
  EXPECT_EQ(view.elevation_m({10.5, 180.0}), 7);
  EXPECT_EQ(view.elevation_m({10.5, 180.1}), 7);
  EXPECT_EQ(view.elevation_m({10.5, -180.1}), 5);
  EXPECT_EQ(fast(view, 10.5, 180.1).elevation_m, 7);
  EXPECT_EQ(fast(view, 10.5, 539.9).elevation_m, 5);
}

TEST(CellView, APoleHasTheHeightOfTheOutermostRowAndLatitudeIsClamped) {
  CellView view(1, Absence::none);
  view.add(cell({89, 0}, 2, 2, [](int row, int) { return row == 1 ? 30 : 20; }));
  view.add(cell({-90, 0}, 2, 2, [](int row, int) { return row == 0 ? 40 : 20; }));
  EXPECT_EQ(view.elevation_m({90, 0.5}), 30);
  EXPECT_EQ(view.elevation_m({91, 0.5}), 30);
  EXPECT_EQ(view.elevation_m({-90, 0.5}), 40);
  EXPECT_EQ(fast(view, 90, 0.5).elevation_m, 30);
  EXPECT_EQ(fast(view, -95, 0.5).elevation_m, 40);
}

TEST(CellView, AVoidPostIsLeftOutAndTheOthersAreWeightedUp) {
  CellView view(1, Absence::sea);
  view.add(cell({0, 0}, 2, 2, [](int row, int column) {
    return row == 0 && column == 0 ? int{kVoidPost} : 100 * row + 10 * column;
  }));
  // At the centre, three posts remain, each with weight 1/4: 10, 100 and 110 m.
  EXPECT_NEAR(view.elevation_m({0.5, 0.5}), (10 + 100 + 110) / 3.0, 1e-12);
  EXPECT_NEAR(view.elevation_m({0.0, 0.25}), 10, 1e-12);
  EXPECT_TRUE(std::isnan(view.elevation_m({0.0, 0.0})));
}

TEST(CellView, AmongFourVoidPostsThereIsNoHeight) {
  CellView view(1, Absence::sea);
  view.add(cell({0, 0}, 2, 2, [](int, int) { return int{kVoidPost}; }));
  EXPECT_TRUE(std::isnan(view.elevation_m({0.5, 0.5})));
  EXPECT_TRUE(std::isnan(fast(view, 0.5, 0.5).elevation_m));
  EXPECT_EQ(fast(view, 0.5, 0.5).water, 0);
}

TEST(CellView, WaterIsTheWeightOfPostsAtExactlyZero) {
  CellView view(1, Absence::sea);
  view.add(cell({0, 0}, 2, 2, [](int, int column) { return column == 0 ? 0 : 8; }));
  EXPECT_NEAR(fast(view, 0.5, 0.25).water, 0.75, 1e-6);
  EXPECT_NEAR(fast(view, 0.5, 0.25).elevation_m, 2, 1e-5);
  EXPECT_EQ(fast(view, 0.3, 0.0).water, 1);
}

TEST(CellView, AnAbsentCellIsSeaVoidOrNotLoaded) {
  CellView view(1, Absence::sea);
  view.set_absence({1, 1}, Absence::none);
  view.set_absence({2, 2}, Absence::not_loaded);
  EXPECT_EQ(view.elevation_m({0.5, 0.5}), 0);
  EXPECT_EQ(fast(view, 0.5, 0.5).water, 1);
  EXPECT_EQ(fast(view, 0.5, 0.5).not_loaded, 0U);
  EXPECT_TRUE(std::isnan(view.elevation_m({1.5, 1.5})));
  EXPECT_EQ(fast(view, 1.5, 1.5).not_loaded, 0U);
  EXPECT_TRUE(std::isnan(view.elevation_m({2.5, 2.5})));
  EXPECT_TRUE(std::isnan(fast(view, 2.5, 2.5).elevation_m));
  EXPECT_EQ(fast(view, 2.5, 2.5).not_loaded, 1U);
}

TEST(CellView, AnInvalidPositionIsAVoid) {
  const CellView view(1, Absence::sea);
  for (const double bad : {kNan, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
    EXPECT_TRUE(std::isnan(view.elevation_m({bad, 0})));
    EXPECT_TRUE(std::isnan(view.elevation_m({0, bad})));
    EXPECT_TRUE(std::isnan(fast(view, bad, 0).elevation_m));
    EXPECT_TRUE(std::isnan(fast(view, 0, bad).elevation_m));
  }
}

// Rough cells with different post spacings, on both sides of the antimeridian; one cell has voids.
std::unique_ptr<CellView> rough_view(std::mt19937_64& random) {
  auto view = std::make_unique<CellView>(1, Absence::sea);
  const auto rough = [&](int, int) { return static_cast<int>(random() % 9000) - 500; };
  const auto with_voids = [&](int, int) {
    return random() % 4 == 0 ? int{kVoidPost} : static_cast<int>(random() % 3) * 700;
  };
  view->add(cell({0, 179}, 121, 121, rough));
  view->add(cell({0, -180}, 121, 61, rough));
  view->add(cell({1, 179}, 31, 31, with_voids));
  return view;
}

TEST(CellView, TheFastPathKeepsItsBoundAgainstDoublePrecision) {
  constexpr unsigned kSeed = 11;
  std::mt19937_64 random(kSeed);
  const auto view = rough_view(random);
  std::uniform_real_distribution<double> latitude(-0.2, 2.2);
  std::uniform_real_distribution<double> longitude(178.8, 181.2);
  const std::size_t corners = 20000;
  std::vector<geo::GeoPoint> at;
  // Half of the positions are scattered, half lie along rays. The runs of positions in one cell are short or long.
  for (std::size_t i = 0; i < corners; ++i) {
    const bool scattered = i % 2000 < 1000;
    at.push_back({scattered ? latitude(random) : -0.2 + 2.4 * static_cast<double>(i % 1000) / 1000,
                  scattered ? longitude(random) : 178.8 + 2.4 * static_cast<double>((i * 7) % 1000) / 1000});
  }
  for (const auto interpolation :
       {radar::Interpolation::nearest, radar::Interpolation::bilinear, radar::Interpolation::cubic}) {
    const auto found = test::fast_path(*view, at, interpolation);
    EXPECT_EQ(found.not_loaded, 0U);
    for (std::size_t i = 0; i < corners; ++i) {
      const Surface truth = view->surface_at(found.positions[i], interpolation);
      ASSERT_EQ(std::isnan(truth.elevation_m), std::isnan(found.elevation_m[i]))
          << "seed " << kSeed << ", position " << i << ", interpolation " << static_cast<int>(interpolation);
      if (!std::isnan(truth.elevation_m)) {
        ASSERT_NEAR(found.elevation_m[i], truth.elevation_m, 0.05 + 1e-6 * 9000)
            << "seed " << kSeed << ", position " << i << ", interpolation " << static_cast<int>(interpolation);
      }
      ASSERT_NEAR(found.water[i], truth.water, 1e-4);
    }
  }
}

TEST(CellView, PostsInDecimetresAreHeightsInMetresOnBothPaths) {
  const Cell whole = test::rough_cell({36, -122}, 61, 61, 7);
  for (const auto interpolation :
       {radar::Interpolation::nearest, radar::Interpolation::bilinear, radar::Interpolation::cubic}) {
    CellView metres(1, Absence::none);
    metres.add(std::make_shared<const Cell>(whole));
    CellView decimetres(2, Absence::none);
    decimetres.add(std::make_shared<const Cell>(whole.corner(), 61, 61, whole.posts(), 0.1));
    std::vector<geo::GeoPoint> corners;
    for (int i = 0; i < 300; ++i) corners.push_back({36.0 + i / 301.0, -122.0 + (i * 37 % 301) / 301.0});
    const auto fast = test::fast_path(decimetres, corners, interpolation);
    const auto coarse = test::fast_path(metres, corners, interpolation);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (std::isnan(coarse.elevation_m[i])) {
        EXPECT_TRUE(std::isnan(fast.elevation_m[i]));
        continue;
      }
      EXPECT_NEAR(fast.elevation_m[i], coarse.elevation_m[i] / 10, 1e-3);
      EXPECT_EQ(fast.water[i], coarse.water[i]);
      EXPECT_NEAR(decimetres.surface_at(fast.positions[i], interpolation).elevation_m, fast.elevation_m[i], 0.05);
    }
  }
}

TEST(Cell, HeightsInWholeMetresAreRoundedAndLandIsNeverZero) {
  const Cell fine({36, -122}, 2, 3, {0, 4, -4, 16, kVoidPost, -1234}, 0.1);
  EXPECT_DOUBLE_EQ(fine.lowest_m(), -123.4);
  EXPECT_DOUBLE_EQ(fine.highest_m(), 1.6);
  EXPECT_EQ(in_whole_metres(fine).posts(), (std::vector<std::int16_t>{0, 1, -1, 2, kVoidPost, -123}));
  EXPECT_EQ(in_whole_metres(fine).unit_m(), 1.0);
}

TEST(CellView, APositionGetsTheSameBitsInAnyRunOfPositions) {
  constexpr unsigned kSeed = 12;
  std::mt19937_64 random(kSeed);
  const auto view = rough_view(random);
  std::uniform_real_distribution<double> latitude(0, 2);
  std::vector<geo::GeoPoint> at;
  for (std::size_t i = 0; i < 999; ++i) at.push_back({latitude(random), 179.0 + static_cast<double>(i) / 500});
  at.front() = {0.5, 179.0};  // fast_path() gives positions relative to the cell of the first position, so both calls
                              // begin with the same one
  const auto found = test::fast_path(*view, at);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto pair = test::fast_path(*view, {at.front(), at[i]});
    ASSERT_TRUE(pair.elevation_m[1] == found.elevation_m[i] ||
                (std::isnan(pair.elevation_m[1]) && std::isnan(found.elevation_m[i])))
        << "seed " << kSeed << ", position " << i;
    ASSERT_EQ(pair.water[1], found.water[i]) << "seed " << kSeed << ", position " << i;
  }
}

// The ground a tenth of the posts' spacing before each position of a ray, where it lies between the same four posts.
TEST(CellView, NearGroundIsTheGroundBeforeThePosition) {
  for (const Cell& cell :
       {test::rough_cell({36, -122}, 121, 121, 7), test::cell_of({36, -122}, 121, 121, [](int row, int column) {
          return 100 + row * row % 37 + column * column % 41;
        })}) {
    CellView view(1, Absence::sea);
    view.add(std::make_shared<const Cell>(cell));
    constexpr std::size_t kCount = 150;
    const double step_m = 500.0, spacing_m = view.post_spacing_at({36.5, -121.5}).ray_step_m;
    std::vector<float> zeros(kCount + kRunSlack), north_deg(zeros), east_deg(zeros), height_m(zeros), water(zeros),
        near_m(zeros), back_m(zeros);
    for (std::size_t i = 0; i < kCount; ++i) {
      north_deg[i] = static_cast<float>(0.05 + 0.0045 * static_cast<double>(i));
      east_deg[i] = static_cast<float>(0.9 - 0.0031 * static_cast<double>(i));
    }
    const auto of = [](auto& values) { return std::span(values).first(kCount); };
    view.surfaces({{36, -122}, of(zeros), of(zeros), of(north_deg), of(east_deg)}, radar::Interpolation::bilinear,
                  {of(height_m), of(water), {}, {}, {static_cast<float>(step_m), of(near_m), of(back_m)}});
    const double part = 0.1 * spacing_m / step_m;
    std::size_t found = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      EXPECT_NEAR(static_cast<double>(back_m[i]), 0.1 * spacing_m, 0.01);
      const geo::GeoPoint before{36.0 + static_cast<double>(north_deg[i]) - 0.0045 * part,
                                 -122.0 + static_cast<double>(east_deg[i]) + 0.0031 * part};
      const double expected_m = view.elevation_m(before);
      if (std::isnan(near_m[i])) continue;
      ++found;
      EXPECT_NEAR(static_cast<double>(near_m[i]), expected_m, 0.5) << i;
    }
    EXPECT_GT(found, kCount / 2);
  }
}

TEST(Ceilings, AreNotBelowAnyPostAround) {
  for (const auto& [rows, columns] : {std::pair{121, 61}, {16, 17}, {2, 2}, {33, 100}}) {
    const Cell cell = test::rough_cell({36, -122}, rows, columns, 3);
    for (int row = 0; row < rows; row += 3)
      for (int column = 0; column < columns; column += 2) {
        const int ceiling = cell.ceilings().around(static_cast<float>(row), static_cast<float>(column));
        for (int r = std::max(0, row - Ceilings::kReach); r < std::min(rows, row + Ceilings::kReach); ++r)
          for (int c = std::max(0, column - Ceilings::kReach); c < std::min(columns, column + Ceilings::kReach); ++c)
            ASSERT_GE(ceiling, cell.post(r, c)) << row << ", " << column;
      }
  }
}

TEST(CellView, EveryWidthOfVectorGivesTheSameBits) {
  constexpr unsigned kSeed = 13;
  std::mt19937_64 random(kSeed);
  const auto view = rough_view(random);
  std::uniform_real_distribution<double> latitude(-0.2, 2.2);
  std::uniform_real_distribution<double> longitude(178.8, 181.2);
  std::vector<geo::GeoPoint> at{{0.5, 179.0}};
  for (int i = 0; i < 5000; ++i) at.push_back({latitude(random), longitude(random)});
  for (int i = 0; i < 5000; ++i) at.push_back({0.0002 * i, 179.0 + 0.0003 * i});
  const auto bits_of = [](const std::vector<float>& values) {
    std::vector<std::uint32_t> bits;
    for (const float value : values) bits.push_back(std::isnan(value) ? 1U : std::bit_cast<std::uint32_t>(value));
    return bits;
  };
  for (const auto interpolation :
       {radar::Interpolation::nearest, radar::Interpolation::bilinear, radar::Interpolation::cubic}) {
    const auto expected = test::fast_path(*view, at, interpolation);
    test::for_each_vector_target([&](const char* name) {
      const auto found = test::fast_path(*view, at, interpolation);
      EXPECT_EQ(bits_of(found.elevation_m), bits_of(expected.elevation_m)) << name;
      EXPECT_EQ(bits_of(found.water), bits_of(expected.water)) << name;
    });
  }
}

TEST(CellView, TheMaterialIsTheCodeOfTheNearestCulturePost) {
  constexpr unsigned kSeed = 14;
  std::mt19937_64 random(kSeed);
  std::vector<std::uint8_t> codes(31U * 61U);
  for (auto& code : codes) code = static_cast<std::uint8_t>(random() % 32);
  const auto culture = std::make_shared<const Culture>(CellCorner{40, -75}, 31, 61, codes);
  CellView view(1, Absence::sea);
  view.add(TerrainCell{cell({40, -75}, 11, 11, [](int, int) { return 100; }), nullptr, culture});
  view.add(cell({40, -74}, 11, 11, [](int, int) { return 100; }));
  EXPECT_TRUE(view.has_materials());
  std::uniform_real_distribution<double> degrees(0.0, 1.0);
  std::vector<geo::GeoPoint> at{{40.0, -75.0}, {40.999999, -74.000001}, {40.5, -73.5}, {39.5, -74.5}};
  for (int i = 0; i < 2000; ++i) at.push_back({40.0 + degrees(random), -75.0 + degrees(random)});
  test::for_each_vector_target([&](const char* name) {
    const auto found = test::fast_path(view, at);
    EXPECT_EQ(found.material[0], codes.front()) << name;
    EXPECT_EQ(found.material[1], codes.back()) << name;
    EXPECT_EQ(found.material[2], 0) << "a cell without culture, " << name;
    EXPECT_EQ(found.material[3], 0) << "no cell, " << name;
    std::size_t different = 0;
    for (std::size_t i = 4; i < at.size(); ++i)
      if (found.material[i] != view.surface_at(found.positions[i], radar::Interpolation::bilinear).material)
        ++different;
    EXPECT_LE(different, 1U) << "half-way between two posts, float may round to the other post, " << name;
  });
}

TEST(CellView, ResidentBytesCoverThePosts) {
  CellView view(1, Absence::sea);
  const std::uint64_t empty = view.resident_bytes();
  view.add(cell({0, 0}, 121, 121, [](int, int) { return 1; }));
  EXPECT_GE(view.resident_bytes() - empty, 2U * 121 * 121);
}

}  // namespace
}  // namespace yars::model::terrain
