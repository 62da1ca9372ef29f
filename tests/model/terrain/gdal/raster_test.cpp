// Posts of cells read from rasters: position, voids, units, reduction; rasters that are refused.
#include "model/terrain/gdal/raster.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/dted.hpp"
#include "model/terrain/sampling/cell_view.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/gdal/raster_builder.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"
#include "tests/model/terrain/shared_data.hpp"

namespace yars::model::terrain {
namespace {

using test::degree_raster;
using test::RasterFields;
using test::same_posts;
using test::write_raster;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Cell read(const std::filesystem::path& path, CellCorner corner, int reduction = 0) {
  const auto reading = read_cell({path, CellFormat::raster}, corner, reduction);
  if (!reading) throw std::runtime_error(reading.error().message());
  return reading->cell;
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

std::string refusal(const std::filesystem::path& path) {
  const auto summary = gdal::describe_raster(path);
  return summary ? "none" : summary.error().message();
}

class RasterOf : public ::testing::TestWithParam<const char*> {};

TEST_P(RasterOf, ADegreeOfPostsIsReadPostByPost) {
  const test::TemporaryFolder folder;
  RasterFields fields = degree_raster(-36, 149, 121);
  fields.driver = GetParam();
  // With the extension .jp2, GDAL writes the georeference into the JPEG 2000 file.
  const auto path = folder.path() / (fields.driver == std::string_view("JP2OpenJPEG") ? "a.jp2" : "a.tif");
  write_raster(path, fields, [](int row, int column) { return 100 + 7 * row - 3 * column; });
  const auto summary = gdal::describe_raster(path);
  ASSERT_TRUE(summary.has_value()) << summary.error().message();
  ASSERT_EQ(summary->cells.size(), 1U) << "half a pixel beyond the edge makes no second cell";
  EXPECT_EQ(summary->cells[0].posts_per_degree_north, 120);
  EXPECT_EQ(summary->cells[0].posts_per_degree_east, 120);
  EXPECT_NEAR(summary->cells[0].covered, 1.0, 1e-6);
  const Cell cell = read(path, {-36, 149});
  for (int row = 0; row < 121; ++row)
    for (int column = 0; column < 121; ++column)
      ASSERT_EQ(cell.post(row, column), 100 + 7 * (120 - row) - 3 * column) << row << ", " << column;
}

INSTANTIATE_TEST_SUITE_P(Raster, RasterOf, ::testing::Values("GTiff", "JP2OpenJPEG", "HFA"));

TEST(Raster, PixelsWithADeclaredOrACommonNoDataValueAreVoid) {
  const test::TemporaryFolder folder;
  RasterFields fields = degree_raster(10, 20, 121);
  fields.void_value = 9999;
  write_raster(folder.path() / "declared.tif", fields, [](int row, int) { return row == 3 ? 9999 : 50; });
  fields.void_value.reset();
  write_raster(folder.path() / "undeclared.tif", fields, [](int row, int) { return row == 3 ? -32768 : 50; });
  for (const char* name : {"declared.tif", "undeclared.tif"}) {
    const Cell cell = read(folder.path() / name, {10, 20});
    EXPECT_EQ(cell.voids(), 121U) << name;
    EXPECT_EQ(cell.post(117, 5), kVoidPost) << name;
    EXPECT_EQ(cell.lowest_m(), 50) << name;
  }
}

TEST(Raster, OneFileServesEveryCellThatItTouchesAndIsVoidOutside) {
  const test::TemporaryFolder folder;
  const double step = 1.0 / 120;
  // 49.75 to 51.25 N, 9.75 to 11.25 E: all of cell 50 N 10 E and parts of the eight cells around it.
  const RasterFields fields{180, 180, {9.75, step, 0, 51.25, 0, -step}};
  write_raster(folder.path() / "four.tif", fields, [](int, int) { return 321; });
  const auto index = index_directory(folder.path());
  ASSERT_TRUE(index.has_value()) << index.error().message();
  EXPECT_EQ(index->size(), 9U);
  EXPECT_NEAR(index->at(slot_of({50, 10})).covered, 1.0, 1e-9);
  EXPECT_NEAR(index->at(slot_of({49, 9})).covered, 0.0625, 0.01);
  auto store = DirectoryTerrainStore::open(folder.path(), {});
  const auto view = (*store)->prepare({{50.5, 10.5}, 100e3});
  EXPECT_NEAR(view->elevation_m({50.0, 10.0}), 321, 1e-6);
  EXPECT_NEAR(view->elevation_m({51.2, 11.2}), 321, 1e-6);
  EXPECT_TRUE(std::isnan(view->elevation_m({49.5, 9.5})));
}

// The heights are a linear function of latitude and longitude, on a Mercator grid. Each post has the function's value.
TEST(Raster, APostOfAProjectedGridHasTheHeightOfItsPosition) {
  const test::TemporaryFolder folder;
  constexpr double kRadius_m = 6378137.0;
  constexpr double kPixel_m = 300.0;
  const double west_m = -122.6 * geo::kRadiansPerDegree * kRadius_m;
  const double north_m = kRadius_m * std::asinh(std::tan(37.9 * geo::kRadiansPerDegree));
  RasterFields fields{300, 300, {west_m, kPixel_m, 0, north_m, 0, -kPixel_m}};
  fields.epsg = 3857;
  fields.type = GDT_Float32;
  const auto height_m = [](double latitude_deg, double longitude_deg) {
    return 1000 + 800 * (latitude_deg - 37) - 500 * (longitude_deg + 122);
  };
  write_raster(folder.path() / "mercator.tif", fields, [&](int row, int column) {
    const double y = north_m - (row + 0.5) * kPixel_m;
    const double x = west_m + (column + 0.5) * kPixel_m;
    return height_m(std::atan(std::sinh(y / kRadius_m)) / geo::kRadiansPerDegree,
                    x / kRadius_m / geo::kRadiansPerDegree);
  });
  const Cell cell = read(folder.path() / "mercator.tif", {37, -123});
  ASSERT_GT(cell.rows(), 300);
  int known = 0;
  for (int row = 0; row < cell.rows(); ++row)
    for (int column = 0; column < cell.columns(); ++column) {
      if (cell.post(row, column) == kVoidPost) continue;
      ++known;
      ASSERT_NEAR(cell.post(row, column) * cell.unit_m(),
                  height_m(37 + static_cast<double>(row) / (cell.rows() - 1),
                           -123 + static_cast<double>(column) / (cell.columns() - 1)),
                  // Rounding; interpolated projection of posts; outermost pixels repeated over half a pixel.
                  0.05 + 0.02 + 2.0);
    }
  EXPECT_GT(known, cell.rows() * cell.columns() / 3);
  EXPECT_GT(cell.voids(), 0U);
  // The cell to the east is in the same file. Both cells have the same heights on their common edge.
  const Cell east = read(folder.path() / "mercator.tif", {37, -122});
  ASSERT_EQ(east.rows(), cell.rows());
  for (int row = 0; row < cell.rows(); ++row) EXPECT_EQ(east.post(row, 0), cell.post(row, cell.columns() - 1));
}

TEST(Raster, LongitudesFromZeroTo360AreTheSameEarth) {
  const test::TemporaryFolder folder;
  RasterFields fields = degree_raster(10, 180, 121);
  write_raster(folder.path() / "pacific.tif", fields, [](int, int column) { return 10 + column; });
  const auto summary = gdal::describe_raster(folder.path() / "pacific.tif");
  ASSERT_TRUE(summary.has_value()) << summary.error().message();
  ASSERT_EQ(summary->cells.size(), 1U);
  EXPECT_EQ(summary->cells[0].west_deg, -180);
  const Cell cell = read(folder.path() / "pacific.tif", {10, -180});
  EXPECT_EQ(cell.post(60, 0), 10);
  EXPECT_EQ(cell.post(60, 120), 130);
}

TEST(Raster, FeetBecomeMetresAndLandIsNeverZero) {
  const test::TemporaryFolder folder;
  RasterFields fields = degree_raster(10, 20, 121);
  fields.type = GDT_Float32;
  fields.unit = "ft";
  write_raster(folder.path() / "feet.tif", fields, [](int row, int) {
    return row < 40 ? 0.0 : row < 80 ? 1.0 : 1000.0;
  });
  const Cell cell = read(folder.path() / "feet.tif", {10, 20});
  EXPECT_DOUBLE_EQ(cell.unit_m(), 0.1);
  EXPECT_EQ(cell.post(120, 0), 0);
  EXPECT_EQ(cell.post(60, 0), 3) << "0.3 m is land";
  EXPECT_EQ(cell.post(0, 0), 3048);
}

TEST(Raster, AReducedCellEqualsReduceOfItsPosts) {
  const test::TemporaryFolder folder;
  const Cell rough = test::rough_cell({10, 20}, 121, 121, 3);
  RasterFields fields = degree_raster(10, 20, 121);
  fields.void_value = kVoidPost;
  write_raster(folder.path() / "rough.tif", fields, [&](int row, int column) { return rough.post(120 - row, column); });
  const auto reading = read_cell({folder.path() / "rough.tif", CellFormat::raster}, {10, 20}, 2);
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  const ReducedCell truth = reduce(read(folder.path() / "rough.tif", {10, 20}), 2);
  EXPECT_TRUE(same_posts(reading->cell, truth.means));
  EXPECT_TRUE(same_posts(reading->peaks.value(), truth.peaks));
}

TEST(Raster, ARasterThatCoversACellPartlyIsUsedOnlyWithoutAWholeCell) {
  const test::TemporaryFolder folder;
  const double step = 1.0 / 3600;
  write_raster(folder.path() / "fine.tif", {100, 100, {-121.5, step, 0, 36.5, 0, -step}}, [](int, int) { return 9; });
  auto index = index_directory(folder.path());
  ASSERT_TRUE(index.has_value()) << index.error().message();
  EXPECT_EQ(index->at(slot_of({36, -122})).posts_per_degree, 7200)
      << "pixel centres half-way between posts of 1/3600 deg";
  folder.write("w122/n36.dt0", test::level_dted(36, -122, 5).bytes());
  index = index_directory(folder.path());
  EXPECT_EQ(index->at(slot_of({36, -122})).format, CellFormat::dted);
  FileSentences found;
  ASSERT_TRUE(index_directory(folder.path(), &found).has_value());
  EXPECT_THAT(found.problems, ElementsAre(AllOf(HasSubstr("fine.tif"), HasSubstr("join them with gdalwarp"))))
      << "finer posts are left out";
}

TEST(Raster, FilesOtherThanRastersOfHeightsAreRefusedWithTheReason) {
  const test::TemporaryFolder folder;
  RasterFields picture = degree_raster(10, 20, 31);
  picture.type = GDT_Byte;
  picture.bands = 3;
  write_raster(folder.path() / "picture.tif", picture, [](int, int) { return 1; });
  EXPECT_THAT(refusal(folder.path() / "picture.tif"), HasSubstr("it may be a picture"));
  RasterFields nowhere = degree_raster(10, 20, 31);
  nowhere.epsg = 0;
  write_raster(folder.path() / "nowhere.tif", nowhere, [](int, int) { return 1; });
  EXPECT_THAT(refusal(folder.path() / "nowhere.tif"), HasSubstr("coordinate system"));
  write_text(folder.path() / "text.tif", "hello");
  EXPECT_THAT(refusal(folder.path() / "text.tif"), HasSubstr("GDAL"));
  EXPECT_THAT(refusal(folder.path() / "gone.tif"), HasSubstr("gone.tif"));
  EXPECT_THAT(refusal("/vsicurl/http://localhost/a.tif"), HasSubstr("regular file"));
}

// GDAL itself reads these files as WGS84 and mean sea level.
TEST(Raster, ADtedFileOfAnotherDatumIsRefusedUnderAnyName) {
  struct Datums {
    std::string vertical, horizontal, found;
  };
  for (const Datums& each :
       {Datums{"ELL", "WGS84", "'ELL'"}, Datums{"W84", "WGS84", "'W84'"}, Datums{"MSL", "NAD27", "'NAD27'"},
        Datums{"MSL", "WGS72", "'WGS72'"}, Datums{"E96", "WGS84", ""}, Datums{"   ", "     ", ""}}) {
    const test::TemporaryFolder folder;
    const Cell flat({10, 20}, 121, 121, std::vector<std::int16_t>(121 * 121, 700));
    std::vector<std::byte> bytes = dted_bytes(flat, 0);
    const std::string text = each.vertical + each.horizontal;
    for (std::size_t i = 0; i < text.size(); ++i)
      bytes[dted::kUserHeaderBytes + dted::kVerticalDatumAt + i] = static_cast<std::byte>(text[i]);
    const auto named = parse_dted(bytes, "n10.dt0", {10, 20});
    for (const std::string name : {"mytile.dt0", "mytile.bin", "mytile.img"}) {
      folder.write(name, bytes);
      const auto index = index_file(folder.path() / name);
      ASSERT_EQ(index.has_value(), each.found.empty()) << text << " " << name;
      EXPECT_EQ(read_cell({folder.path() / name, CellFormat::raster}, {10, 20}).has_value(), each.found.empty());
      if (index) continue;
      EXPECT_THAT(index.error().message(), HasSubstr("found " + each.found));
      const auto after_name = [](const error::Error& error) {
        return error.message().substr(error.message().find(':'));
      };
      EXPECT_EQ(after_name(index.error()), after_name(named.error()));
    }
  }
}

TEST(Raster, AVirtualRasterIsRefusedWhateverItsExtension) {
  const test::TemporaryFolder folder;
  write_raster(folder.path() / "w/real.tif", degree_raster(10, 20, 31), [](int, int) { return 1; });
  const std::string vrt =
      "<VRTDataset rasterXSize=\"31\" rasterYSize=\"31\"><VRTRasterBand dataType=\"Int16\" band=\"1\">"
      "<SimpleSource><SourceFilename>" +
      (folder.path() / "w/real.tif").string() + "</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>";
  write_text(folder.path() / "a.vrt", vrt);
  write_text(folder.path() / "b.tif", vrt);
  FileSentences found;
  ASSERT_TRUE(index_directory(folder.path(), &found).has_value());
  EXPECT_THAT(found.problems,
              ElementsAre(HasSubstr("a.vrt: expected a raster that holds its own heights"), HasSubstr("b.tif")));
}

TEST(Raster, ATruncatedFileIsAnError) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "cut.tif";
  write_raster(path, degree_raster(10, 20, 121), [](int row, int column) { return row * column; });
  const auto whole = std::filesystem::file_size(path);
  for (std::uintmax_t bytes = 0; bytes < whole; bytes += whole / 23) {
    const auto cut = folder.path() / ("cut" + std::to_string(bytes) + ".tif");
    std::filesystem::copy_file(path, cut);
    std::filesystem::resize_file(cut, bytes);
    const auto reading = read_cell({cut, CellFormat::raster}, {10, 20});
    ASSERT_FALSE(reading.has_value()) << bytes;
    EXPECT_THAT(reading.error().message(), HasSubstr("cut" + std::to_string(bytes)));
  }
}

TEST(RealRasters, AnSrtmGeoTiffIsOneCellWith1200PostIntervals) {
  YARS_NEEDS_SHARED_DATA();
  for (const auto& [name, corner] :
       {std::pair("N49W123.tif", CellCorner{49, -123}), std::pair("N49W124.tif", CellCorner{49, -124}),
        std::pair("S36E149.tif", CellCorner{-36, 149}), std::pair("mt_rainier_90m.tif", CellCorner{46, -122})}) {
    const auto path = test::shared_data() / "geotiff" / name;
    const auto summary = gdal::describe_raster(path);
    ASSERT_TRUE(summary.has_value()) << summary.error().message();
    ASSERT_EQ(summary->cells.size(), 1U) << name;
    EXPECT_EQ(summary->cells[0].posts_per_degree_north, 1200) << name;
    EXPECT_EQ((CellCorner{summary->cells[0].south_deg, summary->cells[0].west_deg}), corner) << name;
  }
  const Cell rainier = read(test::shared_data() / "geotiff/mt_rainier_90m.tif", {46, -122});
  EXPECT_NEAR(rainier.highest_m(), 4392, 50) << "Mount Rainier, 4392 m (USGS)";
  EXPECT_NEAR(interpolate(rainier, 0.8529, 1 - 0.7605).elevation_m, 4392, 100);
}

TEST(RealRasters, NeighboursInDifferentFilesShareTheirEdge) {
  YARS_NEEDS_SHARED_DATA();
  const Cell west = read(test::shared_data() / "geotiff/N49W124.tif", {49, -124}, 2);
  const Cell east = read(test::shared_data() / "geotiff/N49W123.tif", {49, -123}, 2);
  for (int row = 0; row < west.rows(); ++row) EXPECT_EQ(west.post(row, west.columns() - 1), east.post(row, 0));
}

TEST(RealRasters, AMercatorGridOfSanFranciscoHasTheFinestSpacingOfPosts) {
  YARS_NEEDS_SHARED_DATA();
  const auto path = test::shared_data() / "geotiff/sanfrancisco_6m_epsg3857.tif";
  const auto summary = gdal::describe_raster(path);
  ASSERT_TRUE(summary.has_value()) << summary.error().message();
  ASSERT_EQ(summary->cells.size(), 1U);
  EXPECT_EQ(summary->cells[0].south_deg, 37);
  EXPECT_EQ(summary->cells[0].west_deg, -123);
  EXPECT_EQ(summary->cells[0].posts_per_degree_north, gdal::kMaxPostsPerDegree);
  const Cell cell = read(path, {37, -123}, 1);
  EXPECT_EQ(cell.rows(), 3601);
  // The file has heights from 0.4 to 115 m.
  EXPECT_GT(cell.highest_m(), 60);
  EXPECT_LT(cell.highest_m(), 300);
  EXPECT_GT(cell.voids(), 12'000'000U);
}

// A raster without content that says it has 10^12 pixels: to read them would take hours.
TEST(GeoTiff, ACellOfMorePixelsThanCanBeReadIsRefused) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "sparse.tif";
  GDALAllRegister();
  constexpr int kPixels = 1'000'000;
  const std::array<const char*, 6> options{"SPARSE_OK=TRUE",   "TILED=YES",   "BLOCKXSIZE=16384",
                                           "BLOCKYSIZE=16384", "BIGTIFF=YES", nullptr};
  const GDALDatasetH dataset =
      GDALCreate(GDALGetDriverByName("GTiff"), path.c_str(), kPixels, kPixels, 1, GDT_Int16, options.data());
  std::array<double, 6> geotransform{5.0, 1.0 / kPixels, 0.0, 46.0, 0.0, -1.0 / kPixels};
  GDALSetGeoTransform(dataset, geotransform.data());
  const OGRSpatialReferenceH wgs84 = OSRNewSpatialReference(nullptr);
  OSRImportFromEPSG(wgs84, 4326);
  GDALSetSpatialRef(dataset, wgs84);
  OSRDestroySpatialReference(wgs84);
  GDALClose(dataset);
  const auto index = index_directory(folder.path());
  ASSERT_TRUE(index.has_value()) << index.error().message();
  const CellCorner corner{45, 5};
  ASSERT_TRUE(index->contains(slot_of(corner)));
  const auto reading = read_cell(index->at(slot_of(corner)), corner);
  ASSERT_FALSE(reading.has_value());
  EXPECT_NE(reading.error().message().find("expected at most 4e+10 pixels in a one-degree cell, found about 1e+12"),
            std::string::npos)
      << reading.error().message();
}

}  // namespace
}  // namespace yars::model::terrain
