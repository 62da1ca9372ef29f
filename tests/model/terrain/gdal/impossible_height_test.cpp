// Impossible heights of a raster (below -12,000 m, above 10,000 m, undeclared no-data values) become void posts and
// are counted. Pixels that equal the declared no-data value become voids without being counted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "model/terrain/store/cell_files.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/gdal/raster_builder.hpp"

namespace yars::model::terrain {
namespace {

using test::RasterFields;
using test::write_raster;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kBadRow = 41, kBadColumn = 57;

// Pixel centres lie half a pixel beside the posts of the cell, so that each post is interpolated from several pixels.
RasterFields shifted_fields(GDALDataType type) {
  RasterFields fields{120, 120, {20, 1.0 / 120, 0, 11, 0, -1.0 / 120}};
  fields.type = type;
  return fields;
}

double hilly(int row, int column) {
  return 700 + std::round(300 * std::sin(row / 9.0) * std::cos(column / 7.0));
}

struct BadPixel {
  double number;  // value of three adjacent pixels
  GDALDataType type;
  std::size_t impossible;  // expected number of impossible pixels
};

class ImpossiblePixel : public ::testing::TestWithParam<BadPixel> {};

TEST_P(ImpossiblePixel, IsVoidBeforePostsAreInterpolated) {
  const test::TemporaryFolder folder;
  write_raster(folder.path() / "a.tif", shifted_fields(GetParam().type), [](int row, int column) {
    return row == kBadRow && std::abs(column - kBadColumn) <= 1 ? GetParam().number : hilly(row, column);
  });
  const auto index = index_directory(folder.path());
  ASSERT_TRUE(index.has_value()) << index.error().message();
  for (const int reduction : {0, 1, 3}) {
    const auto reading = read_cell(index->begin()->second, {10, 20}, reduction);
    ASSERT_TRUE(reading.has_value()) << reading.error().message();
    EXPECT_GE(reading->cell.lowest_m(), 400) << reduction;
    EXPECT_LE(reading->cell.highest_m(), 1000) << reduction;
    EXPECT_EQ(reading->impossible, GetParam().impossible) << reduction;
    if (reduction == 0) {
      const Cell& cell = reading->cell;
      const int row = static_cast<int>(std::lround((120 - kBadRow - 0.5) / 120 * (cell.rows() - 1)));
      const int column = static_cast<int>(std::lround((kBadColumn + 0.5) / 120 * (cell.columns() - 1)));
      EXPECT_EQ(cell.post(row, column), kVoidPost);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Values, ImpossiblePixel,
                         ::testing::Values(BadPixel{-32767, GDT_Int16, 3}, BadPixel{-32768, GDT_Int16, 3},
                                           BadPixel{-9999, GDT_Int16, 3}, BadPixel{30000, GDT_Int16, 3},
                                           BadPixel{-9999, GDT_Float32, 3},
                                           BadPixel{-3.4028234663852886e38, GDT_Float32, 3},
                                           BadPixel{1e20, GDT_Float64, 3}, BadPixel{65535, GDT_UInt16, 3},
                                           BadPixel{kInfinity, GDT_Float32, 3}, BadPixel{-kInfinity, GDT_Float32, 3},
                                           BadPixel{kNan, GDT_Float32, 0}, BadPixel{-2147483648.0, GDT_Int32, 3}));

TEST(RasterVoids, PixelsWithTheDeclaredNoDataValueAreVoidAndNotCounted) {
  for (const double declared : {-9999.0, 0.0, 9999.0, -3.4028234663852886e38}) {
    const test::TemporaryFolder folder;
    RasterFields fields = shifted_fields(GDT_Float32);
    fields.void_value = declared;
    write_raster(folder.path() / "a.tif", fields,
                 [&](int row, int column) { return row < 30 ? declared : hilly(row, column); });
    const auto reading = read_cell({folder.path() / "a.tif", CellFormat::raster}, {10, 20});
    ASSERT_TRUE(reading.has_value()) << reading.error().message();
    EXPECT_EQ(reading->impossible, 0U) << declared;
    EXPECT_GE(reading->cell.lowest_m(), 400) << declared;
    EXPECT_NEAR(static_cast<double>(reading->cell.voids()) / static_cast<double>(reading->cell.post_count()), 0.25,
                0.01);
  }
}

TEST(RasterVoids, TheLimitsOfHeightsApplyAfterScaleAndOffsetOfTheBand) {
  const test::TemporaryFolder folder;
  RasterFields fields = shifted_fields(GDT_Int16);
  fields.scale = 0.5;
  fields.offset = 1000;
  // Unscaled, 18,000 m is impossible. Scaled, 18000 is 10,000 m and possible; 18002 is 10,001 m and impossible.
  write_raster(folder.path() / "a.tif", fields, [](int row, int) {
    return row == 60 ? 18002 : row < 60 ? 18000 : -800;
  });
  const auto reading = read_cell({folder.path() / "a.tif", CellFormat::raster}, {10, 20});
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  EXPECT_NEAR(reading->cell.highest_m(), 10'000, 0.2);
  EXPECT_NEAR(reading->cell.lowest_m(), 600, 0.2);
  EXPECT_EQ(reading->impossible, 120U);
}

struct VoidMark {
  double number;
  GDALDataType type;
  const char* unit = nullptr;
  double scale = 1.0;
  const char* system = nullptr;
};

class UndeclaredVoid : public ::testing::TestWithParam<VoidMark> {};

// In feet or with a scale, the number alone would be a possible height.
TEST_P(UndeclaredVoid, IsComparedBeforeScaleAndUnit) {
  const auto& [number, type, unit, scale, system] = GetParam();
  const test::TemporaryFolder folder;
  RasterFields fields = shifted_fields(type);
  fields.unit = unit;
  fields.scale = scale;
  fields.system = system;
  write_raster(folder.path() / "a.tif", fields,
               [&, bad_m = number](int row, int column) { return row == kBadRow ? bad_m : hilly(row, column); });
  const auto reading = read_cell({folder.path() / "a.tif", CellFormat::raster}, {10, 20});
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  EXPECT_EQ(reading->impossible, 120U);
  EXPECT_GT(reading->cell.lowest_m(), 0);
  EXPECT_LE(reading->cell.highest_m(), 1000);
}

INSTANTIATE_TEST_SUITE_P(
    Marks, UndeclaredVoid,
    ::testing::Values(VoidMark{32767, GDT_Int16, "ft"}, VoidMark{32767, GDT_Int16, nullptr, 1.0, "EPSG:4326+6360"},
                      VoidMark{32767, GDT_Int16, nullptr, 0.1}, VoidMark{-32767, GDT_Int16, nullptr, 0.1},
                      VoidMark{-32768, GDT_Int16, "ft"}, VoidMark{-9999, GDT_Int16, "ft"},
                      VoidMark{-9999, GDT_Int16, nullptr, 0.1}, VoidMark{32767, GDT_Int32, "ft"},
                      VoidMark{32767, GDT_UInt16, "ft"}, VoidMark{65535, GDT_UInt16, nullptr, 0.1},
                      VoidMark{32767, GDT_Float32, "ft"}, VoidMark{-32767, GDT_Float32, nullptr, 0.1},
                      VoidMark{-9999, GDT_Float32, nullptr, 0.1}, VoidMark{-9999, GDT_Float64, "ft"}));

TEST(RasterVoids, TheMiddleOfAnUnsignedBandWithAScaleIsGround) {
  const test::TemporaryFolder folder;
  RasterFields fields = shifted_fields(GDT_UInt16);
  fields.scale = 0.1;
  write_raster(folder.path() / "a.tif", fields, [](int, int) { return 32767; });
  const auto reading = read_cell({folder.path() / "a.tif", CellFormat::raster}, {10, 20});
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  EXPECT_EQ(reading->impossible, 0U);
  EXPECT_NEAR(reading->cell.highest_m(), 3276.7, 0.2);
}

TEST(RasterVoids, EachImpossibleHeightOfAProjectedRasterIsCountedOnce) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "utm.tif";
  // Zone 31, about 46 degrees north, 4 to 6 degrees east: rows are oblique, and pixels are finer than posts.
  RasterFields fields{1500, 900, {540'000, 100, 0, 5'140'000, 0, -100}};
  fields.epsg = 32631;
  std::size_t expected = 0;
  write_raster(path, fields, [&](int row, int column) {
    const bool bad = row % 9 == 0 || column % 50 < 5;
    expected += bad ? 1 : 0;
    return bad ? -9999.0 : hilly(row, column);
  });
  for (const int reduction : {0, 2}) {
    const auto index = index_directory(folder.path());
    ASSERT_TRUE(index.has_value()) << index.error().message();
    EXPECT_GE(index->size(), 4U);
    std::size_t found = 0;
    for (const auto& [slot, file] : *index) {
      const auto reading = read_cell(file, corner_of_slot(slot), reduction);
      ASSERT_TRUE(reading.has_value()) << reading.error().message();
      found += reading->impossible;
    }
    EXPECT_EQ(found, expected) << reduction;
  }
}

TEST(RasterVoids, ARasterOfTwoCellsGivesOneWarningWithTheCountOfOneCell) {
  const test::TemporaryFolder folder;
  RasterFields fields{240, 120, {20, 1.0 / 120, 0, 11, 0, -1.0 / 120}};
  write_raster(folder.path() / "wide.tif", fields,
               [](int row, int column) { return row == 40 && column % 60 == 7 ? -9999 : hilly(row, column); });
  auto store = DirectoryTerrainStore::open(folder.path(), {});
  ASSERT_TRUE(store.has_value()) << store.error().message();
  (*store)->prepare({{10.5, 21.0}, 100e3});  // two cells with two impossible posts each
  EXPECT_THAT((*store)->take_problems(), ElementsAre(AllOf(HasSubstr("wide.tif: impossible heights: 2 posts"))));
}

}  // namespace
}  // namespace yars::model::terrain
