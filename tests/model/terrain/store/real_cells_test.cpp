// Readers of DTED, HGT and packs on real cells. Source of the expected values: README of ../shared/data.
#include <gmock/gmock.h>

#include <cmath>
#include <stdexcept>

#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/pack.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"
#include "tests/model/terrain/shared_data.hpp"

namespace yars::model::terrain {
namespace {

Cell cell_of(const char* file, CellFormat format, CellCorner corner) {
  const auto reading = read_cell({test::shared_data() / file, format, 0}, corner);
  if (!reading) throw std::runtime_error(reading.error().message());
  EXPECT_THAT(reading.value().warnings, ::testing::IsEmpty());
  return reading->cell;
}

TEST(RealCells, TheEquatorCellHas4072VoidsAndHeightsFromMinus7To1979Metres) {
  YARS_NEEDS_SHARED_DATA();
  const Cell cell = cell_of("dted/e006/n00.dt1", CellFormat::dted, {0, 6});
  EXPECT_EQ(cell.voids(), 4072U);
  EXPECT_EQ(cell.lowest_m(), -7);
  EXPECT_EQ(cell.highest_m(), 1979);
}

TEST(RealCells, AZoneTwoCellHasHalfTheColumns) {
  YARS_NEEDS_SHARED_DATA();
  const Cell cell = cell_of("dted/e013/n54.dt1", CellFormat::dted, {54, 13});
  EXPECT_EQ(cell.columns(), 601);
  EXPECT_EQ(cell.rows(), 1201);
}

TEST(RealCells, NegativeHeightsOfHgtAreTwosComplement) {
  YARS_NEEDS_SHARED_DATA();
  const Cell cell = cell_of("srtm/N40W074.hgt", CellFormat::hgt, {40, -74});
  EXPECT_EQ(cell.lowest_m(), -42);
}

TEST(RealCells, NevadaLiesBetween1281And3959MetresAndHasVoids) {
  YARS_NEEDS_SHARED_DATA();
  int lowest_m = 32767;
  int highest_m = 0;
  for (const int south : {38, 39})
    for (const int west : {-114, -115}) {
      const std::string name = "srtm/N" + std::to_string(south) + "W" + std::to_string(-west) + ".hgt";
      const Cell cell = cell_of(name.c_str(), CellFormat::hgt, {south, west});
      lowest_m = std::min(lowest_m, static_cast<int>(cell.lowest_m()));
      highest_m = std::max(highest_m, static_cast<int>(cell.highest_m()));
      EXPECT_GE(cell.voids(), 132U);
      EXPECT_LE(cell.voids(), 34964U);
    }
  EXPECT_EQ(lowest_m, 1281);
  EXPECT_EQ(highest_m, 3959);
}

TEST(RealCells, EdgesOfNeighbouringCellsAreIdentical) {
  YARS_NEEDS_SHARED_DATA();
  const Cell west = cell_of("dted/w122/n37.dt0", CellFormat::dted, {37, -122});
  const Cell east = cell_of("dted/w121/n37.dt0", CellFormat::dted, {37, -121});
  const Cell north = cell_of("dted/w122/n38.dt0", CellFormat::dted, {38, -122});
  for (int post = 0; post < west.rows(); ++post) {
    EXPECT_EQ(west.post(post, west.columns() - 1), east.post(post, 0));
    EXPECT_EQ(west.post(west.rows() - 1, post), north.post(0, post));
  }
}

TEST(RealCells, TheStoreServesMountHamiltonAndTheSea) {
  YARS_NEEDS_SHARED_DATA();
  auto store = DirectoryTerrainStore::open(test::shared_data() / "dted", {});
  ASSERT_TRUE(store.has_value());
  const auto view = (*store)->prepare({{37.0, -122.0}, 100e3});
  // Mount Hamilton, 1,284 m (USGS). Posts 30 arc seconds apart lie up to several hundred metres from the summit.
  EXPECT_NEAR(view->elevation_m({37.3417, -121.6429}), 1284, 150);
  EXPECT_EQ(view->elevation_m({36.5, -122.5}), 0.0);
  EXPECT_THAT((*store)->take_problems(), ::testing::IsEmpty());
}

TEST(RealCells, AWrongChecksumIsReportedAndTheHeightsAreKept) {
  YARS_NEEDS_SHARED_DATA();
  const auto reading = read_cell({test::shared_data() / "malformed/n43_bad_crc.dt0", CellFormat::dted, 120}, {43, -80});
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  EXPECT_THAT(reading->warnings, ::testing::ElementsAre(::testing::HasSubstr("wrong checksum: 1;")));
  EXPECT_EQ(reading->cell.voids(), 0U);
  EXPECT_EQ(reading->cell.post(0, 0), 202);
}

TEST(RealCells, AHeaderWithoutDataIsRefused) {
  YARS_NEEDS_SHARED_DATA();
  const auto reading =
      read_cell({test::shared_data() / "malformed/w118n033_trunc.dt1", CellFormat::dted, 1200}, {33, -118});
  ASSERT_FALSE(reading.has_value());
  EXPECT_THAT(reading.error().message(), ::testing::HasSubstr("truncated"));
}

TEST(RealCells, CompressedHgtIsReadWithItsSpacing) {
  YARS_NEEDS_SHARED_DATA();
  const Cell cell = cell_of("srtm/N43E007.hgt.zip", CellFormat::compressed_hgt, {43, 7});
  EXPECT_EQ(cell.rows(), 1201);
  // The cell has the Maritime Alps and the Mediterranean.
  EXPECT_GT(cell.highest_m(), 1500);
  EXPECT_GT(cell.sea_posts(), 100000U);
  EXPECT_EQ(cell_of("srtm/S46W066.hgt.gz", CellFormat::compressed_hgt, {-46, -66}).rows(), 3601);
}

TEST(RealCells, CellsUnpackFromJpeg2000PacksToTheSamePosts) {
  YARS_NEEDS_SHARED_DATA();
  for (const Cell& cell : {cell_of("dted/w122/n37.dt0", CellFormat::dted, {37, -122}),
                           cell_of("dted/e006/n00.dt1", CellFormat::dted, {0, 6}),
                           cell_of("dted/e013/n54.dt1", CellFormat::dted, {54, 13})}) {
    const auto packed = pack_cell(cell);
    ASSERT_TRUE(packed.has_value()) << packed.error().message();
    const auto reading = parse_pack(packed->jp2, packed->side, "pack", cell.corner(), 0);
    ASSERT_TRUE(reading.has_value()) << reading.error().message();
    EXPECT_TRUE(test::same_posts(reading->cell, cell));
  }
}

TEST(RealCells, ReducedEdgesOfNeighboursStayIdentical) {
  YARS_NEEDS_SHARED_DATA();
  const Cell west = cell_of("dted/w122/n37.dt0", CellFormat::dted, {37, -122});
  const Cell east = cell_of("dted/w121/n37.dt0", CellFormat::dted, {37, -121});
  for (int reduction = 1; reduction <= 3; ++reduction) {
    const Cell a = reduce(west, reduction).means;
    const Cell b = reduce(east, reduction).means;
    for (int row = 0; row < a.rows(); ++row) EXPECT_EQ(a.post(row, a.columns() - 1), b.post(row, 0));
  }
}

}  // namespace
}  // namespace yars::model::terrain
