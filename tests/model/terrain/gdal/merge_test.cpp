// Cells of several rasters: parts of a cell, and tiles that end one pixel short of their southern and eastern edges.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "model/terrain/sampling/terrain_view.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/gdal/raster_builder.hpp"

namespace yars::model::terrain {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kPixels = 120;  // per degree

// A plane: bilinear interpolation has no error on it.
double plane_m(double latitude_deg, double longitude_deg) {
  return 1000.0 + 300.0 * (latitude_deg - 45.0) - 200.0 * (longitude_deg - 5.0);
}

// Writes a raster with the heights of the plane. `north_deg`, `west_deg`: its outer corner.
void write_plane(const std::filesystem::path& path, double north_deg, double west_deg, int rows, int columns,
                 GDALDataType type = GDT_Float32) {
  constexpr double kStep = 1.0 / kPixels;
  test::RasterFields fields{columns, rows, {west_deg, kStep, 0, north_deg, 0, -kStep}};
  fields.type = type;
  test::write_raster(path, fields, [=](int row, int column) {
    return plane_m(north_deg - (row + 0.5) * kStep, west_deg + (column + 0.5) * kStep);
  });
}

// A tile as those of the Copernicus DEM: centres of pixels on whole degrees, no row on the southern edge and no column
// on the eastern one.
void write_tile(const std::filesystem::path& folder, int south_deg, int west_deg, GDALDataType type = GDT_Float32) {
  write_plane(folder / ("n" + std::to_string(south_deg) + "e" + std::to_string(west_deg) + ".tif"),
              south_deg + 1 + 0.5 / kPixels, west_deg - 0.5 / kPixels, kPixels, kPixels, type);
}

double elevation_m(DirectoryTerrainStore& store, double latitude_deg, double longitude_deg) {
  const geo::GeoPoint position{latitude_deg, longitude_deg};
  return store.prepare({position, 0.0})->elevation_m(position);
}

TEST(MergedRasters, PartsOfACellAreOneCell) {
  const test::TemporaryFolder folder;
  write_plane(folder.path() / "a.tif", 45.5, 5.0, kPixels / 2, kPixels / 2);
  write_plane(folder.path() / "b.tif", 45.5, 5.5, kPixels / 2, kPixels / 2);
  write_plane(folder.path() / "c.tif", 46.0, 5.0, kPixels / 2, kPixels);
  auto store = DirectoryTerrainStore::open(folder.path(), {});
  ASSERT_TRUE(store.has_value()) << store.error().message();
  // At the rims of the rasters, posts within half a pixel have the height of the outermost pixel.
  const double rim_m = 500.0 / kPixels;
  for (const auto& [latitude_deg, longitude_deg] :
       {std::pair(45.25, 5.25), {45.25, 5.75}, {45.75, 5.25}, {45.75, 5.75}, {45.5, 5.5}, {45.0, 5.0}, {45.0, 5.999}})
    EXPECT_NEAR(elevation_m(**store, latitude_deg, longitude_deg), plane_m(latitude_deg, longitude_deg), rim_m)
        << latitude_deg << ' ' << longitude_deg;
  EXPECT_NEAR(elevation_m(**store, 45.3, 5.7), plane_m(45.3, 5.7), 0.2) << "within a raster";
  EXPECT_THAT((*store)->take_problems(), IsEmpty());
  EXPECT_THAT((*store)->take_notes(), IsEmpty()) << "each file is used";
}

TEST(MergedRasters, TheGapBetweenPartsStaysVoid) {
  const test::TemporaryFolder folder;
  write_plane(folder.path() / "a.tif", 45.5, 5.0, kPixels / 2, kPixels / 2);
  write_plane(folder.path() / "c.tif", 46.0, 5.0, kPixels / 2, kPixels);
  auto store = DirectoryTerrainStore::open(folder.path(), {});
  ASSERT_TRUE(store.has_value()) << store.error().message();
  EXPECT_TRUE(std::isnan(elevation_m(**store, 45.25, 5.75)));
}

TEST(MergedRasters, WholeDegreesBetweenTilesHaveTheHeightsOfTheNextTile) {
  const test::TemporaryFolder folder;
  for (const int south_deg : {45, 46})
    for (const int west_deg : {5, 6}) write_tile(folder.path(), south_deg, west_deg);
  auto store = DirectoryTerrainStore::open(folder.path(), {});
  ASSERT_TRUE(store.has_value()) << store.error().message();
  for (const auto& [latitude_deg, longitude_deg] :
       {std::pair(46.0, 5.5), {45.5, 6.0}, {46.0, 6.0}, {46.0, 5.0}, {46.002, 5.3}, {45.7, 5.998}, {46.0, 6.4}})
    EXPECT_NEAR(elevation_m(**store, latitude_deg, longitude_deg), plane_m(latitude_deg, longitude_deg), 0.1)
        << latitude_deg << ' ' << longitude_deg;
  EXPECT_THAT((*store)->take_notes(), IsEmpty());
}

TEST(MergedRasters, AnEdgeWithoutANextTileHasTheHeightsBesideIt) {
  const test::TemporaryFolder folder;
  write_tile(folder.path(), 45, 5);
  auto store = DirectoryTerrainStore::open(folder.path(), {});
  ASSERT_TRUE(store.has_value()) << store.error().message();
  EXPECT_NEAR(elevation_m(**store, 45.0, 5.5), plane_m(45.0 + 1.0 / kPixels, 5.5), 0.1);
  EXPECT_EQ((*store)->index().size(), 1U) << "posts on an edge alone make no cell";
  const auto index = (*store)->index();
  const auto reading = read_cell(index.begin()->second, {45, 5});
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  EXPECT_EQ(reading->cell.voids(), 0U);
}

TEST(MergedRasters, NeighboursHaveEqualEdgesAtEveryReduction) {
  const test::TemporaryFolder folder;
  write_tile(folder.path(), 45, 5);
  write_tile(folder.path(), 46, 5);
  const auto index = index_directory(folder.path());
  ASSERT_TRUE(index.has_value()) << index.error().message();
  for (const int reduction : {0, 1, 2}) {
    const auto south = read_cell(index->at(slot_of({45, 5})), {45, 5}, reduction);
    const auto north = read_cell(index->at(slot_of({46, 5})), {46, 5}, reduction);
    ASSERT_TRUE(south.has_value() && north.has_value());
    for (int column = 0; column < north->cell.columns(); ++column)
      EXPECT_EQ(north->cell.post(0, column), south->cell.post(south->cell.rows() - 1, column)) << column;
  }
}

TEST(MergedRasters, WholeMetresAndFractionsHaveOneUnit) {
  const test::TemporaryFolder folder;
  write_tile(folder.path(), 45, 5, GDT_Float32);
  write_tile(folder.path(), 46, 5, GDT_Int16);
  auto store = DirectoryTerrainStore::open(folder.path(), {});
  ASSERT_TRUE(store.has_value()) << store.error().message();
  EXPECT_NEAR(elevation_m(**store, 46.0, 5.31), plane_m(46.0, 5.31), 0.1);
  EXPECT_NEAR(elevation_m(**store, 46.5, 5.31), plane_m(46.5, 5.31), 1.0);
}

TEST(MergedRasters, ADamagedNeighbourLeavesTheCellUsable) {
  const test::TemporaryFolder folder;
  write_tile(folder.path(), 45, 5);
  write_tile(folder.path(), 46, 5);
  const auto south = folder.path() / "n45e5.tif";
  std::filesystem::resize_file(south, std::filesystem::file_size(south) - 4 * kPixels * (kPixels - 1));
  auto store = DirectoryTerrainStore::open(folder.path(), {});
  ASSERT_TRUE(store.has_value()) << store.error().message();
  EXPECT_NEAR(elevation_m(**store, 46.5, 5.5), plane_m(46.5, 5.5), 0.1);
  EXPECT_THAT((*store)->take_problems(),
              ElementsAre(AllOf(HasSubstr("n46e5.tif: voids of its cell are not filled"), HasSubstr("n45e5.tif"))));
  EXPECT_NEAR(elevation_m(**store, 46.0, 5.5), plane_m(46.0 + 1.0 / kPixels, 5.5), 0.1) << "of the row beside it";
  EXPECT_THAT((*store)->take_problems(), ElementsAre(HasSubstr("n45e5.tif: expected heights that can be read")))
      << "a whole degree lies in both cells";
}

TEST(MergedRasters, ACoarserRasterOfAWholeCellIsNotedAsNotNeeded) {
  const test::TemporaryFolder folder;
  test::write_raster(folder.path() / "coarse.tif", test::degree_raster(45, 5, 61), [](int, int) { return 1; });
  test::write_raster(folder.path() / "fine.tif", test::degree_raster(45, 5, 121), [](int, int) { return 2; });
  FileSentences found;
  ASSERT_TRUE(index_directory(folder.path(), &found).has_value());
  EXPECT_THAT(found.problems, IsEmpty());
  EXPECT_THAT(found.notes, ElementsAre(AllOf(HasSubstr("coarse.tif: not used"), HasSubstr("has finer posts"))));
}

}  // namespace
}  // namespace yars::model::terrain
