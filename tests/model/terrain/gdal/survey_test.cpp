// survey_raster(): statistics of a raster in degrees by cell; a projected raster has none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "model/terrain/gdal/raster.hpp"
#include "model/terrain/gdal/raster_survey.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/gdal/raster_builder.hpp"

namespace yars::model::terrain {
namespace {

using test::degree_raster;
using test::RasterFields;
using test::write_raster;

gdal::RasterStatistics survey(const std::filesystem::path& path) {
  const auto facts = gdal::survey_raster(path, {});
  EXPECT_TRUE(facts.has_value()) << facts.error().message();
  EXPECT_TRUE(facts && facts->has_value());
  return facts && *facts ? **facts : gdal::RasterStatistics{};
}

const gdal::RasterCellStatistics& cell_at(const gdal::RasterStatistics& facts, int south_deg, int west_deg) {
  return *std::find_if(facts.cells.begin(), facts.cells.end(), [&](const gdal::RasterCellStatistics& cell) {
    return cell.south_deg == south_deg && cell.west_deg == west_deg;
  });
}

TEST(RasterSurvey, CountsPostsVoidsAndSeaByCell) {
  const test::TemporaryFolder folder;
  // 3 x 2 cells of 30 x 30 pixels: one cell is void, one is sea, and one has a single undeclared no-data value.
  const RasterFields fields{90, 60, {178, 1.0 / 30, 0, 52, 0, -1.0 / 30}};
  write_raster(folder.path() / "a.tif", fields, [](int row, int column) {
    if (row < 30 && column < 30) return -32768;
    if (row >= 30 && column >= 60) return 0;
    if (row == 40 && column == 5) return -9999;
    return 100 + row + column;
  });
  const gdal::RasterStatistics facts = survey(folder.path() / "a.tif");
  ASSERT_EQ(facts.cells.size(), 6U);
  const auto& empty = cell_at(facts, 51, 178);
  EXPECT_EQ(empty.posts, 900U);
  EXPECT_EQ(empty.voids, 900U);
  const auto& sea = cell_at(facts, 50, -180);
  EXPECT_EQ(sea.sea, 900U);
  EXPECT_EQ(sea.lowest_m, 0.0F);
  EXPECT_EQ(sea.highest_m, 0.0F);
  const auto& holed = cell_at(facts, 50, 178);
  EXPECT_EQ(holed.columns, 30);
  EXPECT_EQ(holed.voids, 1U);
  EXPECT_EQ(holed.lowest_m, 130.0F);
  EXPECT_EQ(holed.highest_m, 188.0F);
  EXPECT_EQ(facts.impossible, 901U);
}

TEST(RasterSurvey, PostsOnAnEdgeBelongToBothCells) {
  const test::TemporaryFolder folder;
  RasterFields fields = degree_raster(10, 20, 31);
  fields.columns = 61;
  write_raster(folder.path() / "a.tif", fields, [](int, int column) { return column == 30 ? 900 : 5; });
  const gdal::RasterStatistics facts = survey(folder.path() / "a.tif");
  ASSERT_EQ(facts.cells.size(), 2U);
  for (const gdal::RasterCellStatistics& cell : facts.cells) {
    EXPECT_EQ(cell.columns, 31);
    EXPECT_EQ(cell.posts, 961U);
    EXPECT_EQ(cell.highest_m, 900.0F);
  }
}

TEST(RasterSurvey, AProjectedRasterHasNoSurvey) {
  const test::TemporaryFolder folder;
  RasterFields fields{40, 40, {500'000, 300, 0, 5'160'000, 0, -300}};
  fields.epsg = 32631;
  write_raster(folder.path() / "a.tif", fields, [](int, int) { return 7; });
  const auto facts = gdal::survey_raster(folder.path() / "a.tif", {});
  ASSERT_TRUE(facts.has_value()) << facts.error().message();
  EXPECT_FALSE(facts->has_value());
}

TEST(RasterSurvey, ARasterWithHeightsAboveTheEllipsoidHasNoSurvey) {
  const test::TemporaryFolder folder;
  RasterFields fields = degree_raster(10, 20, 31);
  fields.system = "EPSG:4979";
  fields.type = GDT_Float32;
  write_raster(folder.path() / "a.tif", fields, [](int, int) { return 7; });
  const auto facts = gdal::survey_raster(folder.path() / "a.tif", {});
  EXPECT_TRUE(!facts || !facts->has_value());  // without proj-data, an error
}

}  // namespace
}  // namespace yars::model::terrain
