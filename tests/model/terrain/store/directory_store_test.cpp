// DirectoryTerrainStore: cells loaded for a region, memory limit, reduced cells and problems. open_terrain().
#include "model/terrain/store/directory_store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "lib/radar/world.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/formats/dted.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/sampling/fast_path.hpp"

namespace yars::model::terrain {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kNear = 1000.0;  // [m] radius of a region that needs one cell
// [bytes] memory of one cell of write_cells().
const std::size_t kCell = Cell({0, 0}, test::kSmallSide, test::kSmallSide,
                               std::vector<std::int16_t>(std::size_t{test::kSmallSide} * std::size_t{test::kSmallSide}))
                              .bytes();

// Cells far apart along the equator: heights 10, 20, 30, 40 at longitudes 0, 20, 40, 60.
std::string name_at(int west_deg) {
  char text[32];
  std::snprintf(text, sizeof text, "e%03d/n00.dt0", west_deg);
  return text;
}
void write_cells(const test::TemporaryFolder& folder) {
  for (const int west : {0, 20, 40, 60})
    folder.write(name_at(west), test::level_dted(0, west, static_cast<std::uint16_t>(10 + west / 2)).bytes());
}
geo::GeoPoint middle(int west_deg) {
  return {0.5, west_deg + 0.5};
}

std::unique_ptr<DirectoryTerrainStore> store_over(const test::TemporaryFolder& folder,
                                                  DirectoryStoreOptions options = {}) {
  auto store = DirectoryTerrainStore::open(folder.path(), options);
  EXPECT_TRUE(store.has_value()) << store.error().message();
  return std::move(store.value());
}

TEST(DirectoryStore, PrepareLoadsWhatTheRegionNeeds) {
  const test::TemporaryFolder folder;
  write_cells(folder);
  const auto store = store_over(folder);
  const auto view = store->prepare({middle(20), kNear});
  EXPECT_EQ(view->elevation_m(middle(20)), 20);
  EXPECT_TRUE(std::isnan(view->elevation_m(middle(40)))) << "a cell outside the region is not loaded";
  EXPECT_EQ(view->elevation_m(middle(100)), 0) << "a cell without a file is sea";
}

TEST(DirectoryStore, PrepareKeepsNoMemoryOfItsReaders) {
  const test::TemporaryFolder folder;
  write_cells(folder);
  store_over(folder)->prepare({middle(20), kNear});
  EXPECT_EQ(reading_buffers().file.capacity(), 0U);
  EXPECT_EQ(reading_buffers().posts.capacity(), 0U);
}

TEST(DirectoryStore, WithoutMaterialsNoCultureIsRead) {
  const test::TemporaryFolder folder;
  write_cells(folder);
  folder.write(culture_path(name_at(20)).string(), std::vector<std::byte>(10));
  const auto heights = store_over(folder, {.materials = false});
  EXPECT_EQ(heights->prepare({middle(20), kNear})->elevation_m(middle(20)), 20);
  EXPECT_TRUE(heights->take_problems().empty());
  const auto store = store_over(folder);
  EXPECT_EQ(store->prepare({middle(20), kNear})->elevation_m(middle(20)), 20);
  EXPECT_EQ(store->take_problems().size(), 1U) << "ten zeros are no culture";
}

TEST(DirectoryStore, AMissingCellIsVoidIfTheOptionForSeaIsOff) {
  const test::TemporaryFolder folder;
  write_cells(folder);
  const auto store = store_over(folder, {.missing_cell_is_sea = false});
  EXPECT_TRUE(std::isnan(store->prepare({middle(20), kNear})->elevation_m(middle(100))));
}

TEST(DirectoryStore, ARegionWithoutACellIsReportedOnceWithTheFoldersCoverage) {
  const test::TemporaryFolder folder;
  write_cells(folder);
  const auto store = store_over(folder);
  store->prepare({middle(20), kNear});
  EXPECT_THAT(store->take_problems(), IsEmpty());
  store->prepare({middle(-20), 40 * 1852.0});
  store->prepare({middle(-20), 40 * 1852.0});
  EXPECT_THAT(store->take_problems(),
              ElementsAre(AllOf(HasSubstr("expected a cell within 40 NM of latitude 0.5000, longitude -19.5000"),
                                HasSubstr("the folder covers latitude 0 to 1, longitude 0 to 61"),
                                HasSubstr("counts as sea"))));
  store->prepare({middle(20), kNear});
  store->prepare({middle(-20), kNear});
  EXPECT_EQ(store->take_problems().size(), 1U) << "reported again after a region over land";
  store->prepare({middle(20), kNear});
  store->prepare({middle(-20), 0.0});
  EXPECT_THAT(store->take_problems(), IsEmpty()) << "a region of radius 0 is not reported";
}

TEST(DirectoryStore, TheSameViewComesBackWhileNothingChanges) {
  const test::TemporaryFolder folder;
  write_cells(folder);
  const auto store = store_over(folder);
  const auto first = store->prepare({middle(20), kNear});
  EXPECT_EQ(store->prepare({middle(20), 2 * kNear}), first);
  EXPECT_EQ(store->prepare({middle(100), kNear}), first) << "open sea changes nothing";
  const auto second = store->prepare({middle(40), kNear});
  EXPECT_GT(second->generation(), first->generation());
  EXPECT_EQ(store->prepare({middle(20), kNear}), second) << "the first cell is still there";
}

TEST(DirectoryStore, AnOldViewKeepsItsCellsAfterTheStoreDropsThem) {
  const test::TemporaryFolder folder;
  write_cells(folder);
  const auto store = store_over(folder, {.resident_limit_bytes = kCell});
  const auto first = store->prepare({middle(0), kNear});
  store->prepare({middle(60), kNear});
  EXPECT_EQ(first->elevation_m(middle(0)), 10);
}

TEST(DirectoryStore, TheLeastRecentlyUsedCellIsDroppedFirst) {
  const test::TemporaryFolder folder;
  write_cells(folder);
  const auto store = store_over(folder, {.resident_limit_bytes = 2 * kCell});
  store->prepare({middle(0), kNear});
  store->prepare({middle(20), kNear});
  store->prepare({middle(0), kNear});
  const auto view = store->prepare({middle(40), kNear});
  EXPECT_EQ(view->elevation_m(middle(0)), 10);
  EXPECT_TRUE(std::isnan(view->elevation_m(middle(20))));
  EXPECT_EQ(view->elevation_m(middle(40)), 30);
}

TEST(DirectoryStore, AllCellsOfARegionStayInMemoryEvenBeyondTheLimit) {
  const test::TemporaryFolder folder;
  for (const int west : {0, 1}) folder.write(name_at(west), test::level_dted(0, west, 7).bytes());
  const auto store = store_over(folder, {.resident_limit_bytes = kCell});
  const auto view = store->prepare({{0.5, 1.0}, kNear});
  EXPECT_EQ(view->elevation_m({0.5, 0.9}), 7);
  EXPECT_EQ(view->elevation_m({0.5, 1.1}), 7);
  EXPECT_EQ(store->prepare({{0.5, 1.0}, kNear}), view);
}

TEST(DirectoryStore, AnUnreadableCellIsVoidAndReportedOnce) {
  const test::TemporaryFolder folder;
  write_cells(folder);
  folder.write(name_at(20), std::vector<std::byte>(100));
  const auto store = store_over(folder);
  const auto view = store->prepare({middle(20), kNear});
  EXPECT_TRUE(std::isnan(view->elevation_m(middle(20))));
  EXPECT_THAT(store->take_problems(), ElementsAre(HasSubstr("e020")));
  EXPECT_EQ(store->prepare({middle(20), kNear}), view);
  EXPECT_THAT(store->take_problems(), IsEmpty());
  EXPECT_EQ(store->prepare({middle(40), kNear})->elevation_m(middle(40)), 30) << "other cells are still loaded";
}

TEST(DirectoryStore, ACellWithAWrongChecksumIsReportedAndUsed) {
  const test::TemporaryFolder folder;
  test::DtedFile damaged = test::level_dted(0, 20, 5);
  damaged.columns[0].sum_error = 1;
  folder.write(name_at(20), damaged.bytes());
  const auto store = store_over(folder);
  EXPECT_EQ(store->prepare({middle(20), kNear})->elevation_m(middle(20)), 5);
  EXPECT_THAT(store->take_problems(), ElementsAre(HasSubstr("checksum")));
}

// Random heights on the posts of DTED level 0, 927 m apart.
Cell rough_cell(CellCorner corner) {
  std::mt19937 random(7);
  std::vector<std::int16_t> posts(121U * 121U);
  for (std::int16_t& post_m : posts) post_m = static_cast<std::int16_t>(100 + random() % 900);
  return {corner, 121, 121, posts};
}

TEST(DirectoryStore, ACoarserDetailHasMeansAsElevationsAndPeaksForShadows) {
  const test::TemporaryFolder folder;
  const Cell whole = rough_cell({0, 0});
  ASSERT_TRUE(write_dted(folder.path(), whole, 0));
  const auto store = store_over(folder);
  const auto fine = store->prepare({middle(0), kNear, 0});
  EXPECT_FALSE(fine->has_peaks());
  const auto coarse = store->prepare({middle(0), kNear, detail_for(4100.0)});  // every fourth post
  EXPECT_TRUE(coarse->has_peaks());
  EXPECT_LT(coarse->resident_bytes() - sizeof(CellView), (fine->resident_bytes() - sizeof(CellView)) / 4);
  std::vector<geo::GeoPoint> corners;
  for (int i = 0; i < 3000; ++i) corners.push_back({0.02 + 0.00032 * i, 0.98 - 0.00031 * i});
  const auto found = test::fast_path(*coarse, corners);
  double mean_difference_m = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double exact_m = fine->elevation_m(found.positions[i]);
    EXPECT_GE(found.peak_m[i], exact_m - 0.1) << "peaks are at least as high as the ground";
    mean_difference_m += (found.elevation_m[i] - exact_m) / static_cast<double>(corners.size());
  }
  EXPECT_NEAR(mean_difference_m, 0.0, 30.0) << "the mean height is kept";
}

TEST(DirectoryStore, AViewServesTheDetailOfItsRegionOnly) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_dted(folder.path(), rough_cell({0, 0}), 0));
  const auto store = store_over(folder);
  const auto coarse = store->prepare({middle(0), kNear, 12});
  EXPECT_TRUE(coarse->has_detail(12));
  EXPECT_FALSE(coarse->has_detail(0));
  const auto fine = store->prepare({middle(0), kNear, 0});
  EXPECT_GT(fine->generation(), coarse->generation());
  EXPECT_TRUE(fine->has_detail(0));
  EXPECT_TRUE(coarse->has_peaks()) << "the old view is unchanged";
  EXPECT_EQ(store->prepare({middle(0), kNear, 0}), fine);
}

TEST(Detail, IsTheLargestPowerOfTwoUpToTheSpacing) {
  EXPECT_EQ(detail_for(0.0), 0);
  EXPECT_EQ(detail_for(1.9), 0);
  EXPECT_EQ(detail_for(2.0), 1);
  EXPECT_EQ(detail_for(100.0), 6);
  EXPECT_EQ(detail_for(std::numeric_limits<double>::quiet_NaN()), 0);
  CellFile level_1;
  level_1.posts_per_degree = 1200;  // 93 m
  EXPECT_EQ(reduction_for(level_1, 6), 0);
  EXPECT_EQ(reduction_for(level_1, 7), 0);
  EXPECT_EQ(reduction_for(level_1, 8), 1);
  EXPECT_EQ(reduction_for(level_1, 10), 3);
  EXPECT_EQ(reduction_for(CellFile(), 10), 0) << "the file's spacing is not known";
}

TEST(OpenTerrain, WithoutADirectoryTheBuiltInHillsAreServed) {
  const auto store = open_terrain({});
  ASSERT_TRUE(store.has_value());
  const auto view = (*store)->prepare({{37, -122}, 1e5});
  double lowest_m = 1e9;
  double highest_m = -1e9;
  for (int i = 0; i < 1000; ++i) {
    const double elevation_m = view->elevation_m({36.5 + 0.001 * i, -122.0 + 0.0007 * i});
    lowest_m = std::min(lowest_m, elevation_m);
    highest_m = std::max(highest_m, elevation_m);
  }
  EXPECT_GE(lowest_m, 0);
  EXPECT_GT(highest_m - lowest_m, 300);
  EXPECT_LE(highest_m, 1170);
}

TEST(OpenTerrain, TheConfiguredDirectoryIsServedAndAMissingOneIsAnError) {
  const test::TemporaryFolder folder;
  write_cells(folder);
  radar::TerrainConfiguration configuration;
  configuration.directory = folder.path().string();
  configuration.missing_cell_is_sea = false;
  const auto store = open_terrain(configuration);
  ASSERT_TRUE(store.has_value());
  const auto view = (*store)->prepare({middle(60), kNear});
  EXPECT_EQ(view->elevation_m(middle(60)), 40);
  EXPECT_TRUE(std::isnan(view->elevation_m(middle(100))));
  configuration.directory += "/gone";
  EXPECT_THAT(open_terrain(configuration).error().message(), HasSubstr("gone"));
}

}  // namespace
}  // namespace yars::model::terrain
