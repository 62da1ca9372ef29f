// The ground has no step between cells of different post spacing, at the antimeridian and at the poles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/dted.hpp"
#include "model/terrain/formats/pack.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/sampling/fast_path.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"

namespace yars::model::terrain {
namespace {

constexpr double kWaves = 3.0;        // waves of the ground per degree, north and east
constexpr double kAmplitude_m = 200;  // amplitude of the waves in each direction
constexpr double kHair_deg = 1e-9;    // offset to either side of an edge; 0.1 mm

// Height [m] of hills over the whole earth, equal at 180 and -180 degrees and always above sea level.
double ground_m(double latitude_deg, double longitude_deg) {
  const double rad_per_deg = 2 * std::numbers::pi * kWaves;
  return 1000 + kAmplitude_m * std::sin(rad_per_deg * latitude_deg) +
         kAmplitude_m * std::cos(rad_per_deg * (longitude_deg + 0.1));
}

// [m] Maximum error of heights along an edge: linear interpolation with `intervals` post intervals a degree, plus 0.5 m
// for rounding to metres.
double bound_m(int intervals) {
  const double phase_rad = 2 * std::numbers::pi * kWaves / intervals;
  return kAmplitude_m * phase_rad * phase_rad / 8 + 0.5;
}

Cell ground_cell(CellCorner corner, int rows, int columns) {
  return test::cell_of(corner, rows, columns, [&](int row, int column) {
    return static_cast<int>(std::lround(ground_m(corner.south_deg + static_cast<double>(row) / (rows - 1),
                                                 corner.west_deg + static_cast<double>(column) / (columns - 1))));
  });
}

// Writes a cell of the ground as DTED of a level: 0 has 120 post intervals a degree, 1 has 1200.
void put_ground(const test::TemporaryFolder& folder, CellCorner corner, int level) {
  const auto path =
      write_dted(folder.path(), ground_cell(corner, dted::kPostsOfLevel[level], dted_columns(corner, level)), level);
  ASSERT_TRUE(path.has_value()) << path.error().message();
}

std::unique_ptr<DirectoryTerrainStore> open_store(const test::TemporaryFolder& folder) {
  auto store = DirectoryTerrainStore::open(folder.path(), {.missing_cell_is_sea = false});
  EXPECT_TRUE(store.has_value()) << store.error().message();
  return std::move(store.value());
}

// Compares the heights on both sides of a meridian with the ground and with each other, over one degree of latitude.
// `coarse`: intervals per degree of the coarser cell.
void expect_meridian_is_no_seam(const TerrainView& view, double longitude_deg, double south_deg, int coarse) {
  for (int step = 0; step <= 500; ++step) {
    const double latitude_deg = south_deg + (step + 0.37) / 502;
    const double west_m = view.elevation_m({latitude_deg, longitude_deg - kHair_deg});
    const double east_m = view.elevation_m({latitude_deg, longitude_deg + kHair_deg});
    ASSERT_NEAR(west_m, ground_m(latitude_deg, longitude_deg), bound_m(coarse)) << latitude_deg;
    ASSERT_NEAR(east_m, west_m, bound_m(coarse) + 0.5) << latitude_deg;
  }
}

void expect_parallel_is_no_seam(const TerrainView& view, double latitude_deg, double west_deg, int coarse) {
  for (int step = 0; step <= 500; ++step) {
    const double longitude_deg = west_deg + (step + 0.37) / 502;
    const double south_m = view.elevation_m({latitude_deg - kHair_deg, longitude_deg});
    const double north_m = view.elevation_m({latitude_deg + kHair_deg, longitude_deg});
    ASSERT_NEAR(south_m, ground_m(latitude_deg, longitude_deg), bound_m(coarse)) << longitude_deg;
    ASSERT_NEAR(north_m, south_m, bound_m(coarse) + 0.5) << longitude_deg;
  }
}

TEST(CellSeams, LevelsZeroAndOneMeetWithinTheErrorOfTheCoarserCell) {
  const test::TemporaryFolder folder;
  put_ground(folder, {36, -122}, 0);
  put_ground(folder, {36, -121}, 1);
  put_ground(folder, {37, -122}, 1);
  const auto store = open_store(folder);
  const auto view = store->prepare({{37.0, -121.0}, 50e3});
  expect_meridian_is_no_seam(*view, -121.0, 36.0, 120);
  expect_parallel_is_no_seam(*view, 37.0, -122.0, 120);
}

TEST(CellSeams, CellsOnBothSidesOfADtedZoneLimitMeet) {
  const test::TemporaryFolder folder;
  put_ground(folder, {49, 10}, 0);
  put_ground(folder, {50, 10}, 0);
  put_ground(folder, {79, 10}, 0);
  put_ground(folder, {80, 10}, 0);
  const auto store = open_store(folder);
  expect_parallel_is_no_seam(*store->prepare({{50.0, 10.5}, 50e3}), 50.0, 10.0, 60);
  expect_parallel_is_no_seam(*store->prepare({{80.0, 10.5}, 20e3}), 80.0, 10.0, 20);
}

TEST(CellSeams, TheAntimeridianIsAnEdgeLikeOthers) {
  const test::TemporaryFolder folder;
  put_ground(folder, {10, 179}, 0);
  put_ground(folder, {10, -180}, 0);
  const auto store = open_store(folder);
  const auto view = store->prepare({{10.5, 180.0}, 20e3});
  expect_meridian_is_no_seam(*view, 180.0, 10.0, 120);
  expect_meridian_is_no_seam(*view, -180.0, 10.0, 120);
}

TEST(CellSeams, CellsMeetAtThePolesAndThePolesAreNotVoid) {
  const test::TemporaryFolder folder;
  for (const int west : {-180, -1, 0, 179}) {
    put_ground(folder, {89, west}, 0);
    put_ground(folder, {-90, west}, 0);
  }
  const auto store = open_store(folder);
  const auto north = store->prepare({{89.9, 0.0}, 60e3});
  expect_meridian_is_no_seam(*north, 0.0, 89.0, 20);
  expect_meridian_is_no_seam(*north, 180.0, 89.0, 20);
  EXPECT_NEAR(north->elevation_m({90.0, 0.5}), ground_m(90.0, 0.5), bound_m(20));
  const auto south = store->prepare({{-89.9, 0.0}, 60e3});
  expect_meridian_is_no_seam(*south, 0.0, -90.0, 20);
  EXPECT_NEAR(south->elevation_m({-90.0, 0.5}), ground_m(-90.0, 0.5), bound_m(20));
}

TEST(CellSeams, NothingInsideCellsWithoutVoidsIsVoid) {
  const test::TemporaryFolder folder;
  put_ground(folder, {50, 179}, 0);
  put_ground(folder, {49, 179}, 1);
  put_ground(folder, {50, -180}, 1);
  put_ground(folder, {49, -180}, 0);
  const auto store = open_store(folder);
  const auto view = store->prepare({{50.0, 180.0}, 120e3});
  std::vector<geo::GeoPoint> corners;
  for (int i = 0; i < 400; ++i)
    for (int j = 0; j < 400; ++j) corners.push_back({49.0 + i / 200.0, 179.0 + j / 200.0});
  const auto found = test::fast_path(*view, corners);
  EXPECT_EQ(found.not_loaded, 0U);
  for (std::size_t i = 0; i < corners.size(); ++i)
    ASSERT_NEAR(found.elevation_m[i], ground_m(corners[i].latitude_deg, corners[i].longitude_deg),
                2 * bound_m(60) + 0.1)
        << corners[i].latitude_deg << ", " << corners[i].longitude_deg;
}

TEST(CellSeams, ReducedCellsAndPacksOfOneReductionMeetExactly) {
  const Cell west = ground_cell({36, -122}, 121, 121);
  const Cell east = ground_cell({36, -121}, 121, 121);
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_pack(folder.path(), east).has_value());
  for (int reduction = 1; reduction <= 3; ++reduction) {
    const Cell a = reduce(west, reduction).means;
    const auto b = read_cell({folder.path() / "w121/n36.jp2", CellFormat::pack}, {36, -121}, reduction);
    ASSERT_TRUE(b.has_value()) << b.error().message();
    for (int row = 0; row < a.rows(); ++row) EXPECT_EQ(a.post(row, a.columns() - 1), b->cell.post(row, 0));
  }
}

}  // namespace
}  // namespace yars::model::terrain
