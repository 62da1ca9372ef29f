// prepare_in_steps(): the intermediate views of a region, what replaces cells that are not loaded, and has_detail().
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "model/terrain/formats/dted.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/sampling/fast_path.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"

namespace yars::model::terrain {
namespace {

using ::testing::ElementsAre;

// Centre of the cell at the equator with this western edge.
geo::GeoPoint middle_of_cell(int west_deg) {
  return {0.5, west_deg + 0.5};
}

std::unique_ptr<DirectoryTerrainStore> steps_over(const test::TemporaryFolder& folder) {
  auto store = DirectoryTerrainStore::open(folder.path(), {});
  EXPECT_TRUE(store.has_value()) << store.error().message();
  return std::move(store.value());
}

// The region needs three cells in a row, 0 to 3 degrees east. Its centre lies in the first cell.
constexpr TerrainRegion kRow{{0.5, 0.5}, 280000.0, 0};

void write_row(const test::TemporaryFolder& folder) {
  for (const int west : {0, 1, 2}) ASSERT_TRUE(write_dted(folder.path(), test::rough_cell({0, west}, 121, 121, 7), 0));
}

TEST(DirectoryStoreSteps, NearCellsComeFirstAndCellsToComeAreMarkedAsNotLoaded) {
  const test::TemporaryFolder folder;
  write_row(folder);
  const auto store = steps_over(folder);
  std::vector<TerrainViewPointer> interim;
  const auto whole = store->prepare_in_steps(kRow, [&](const TerrainViewPointer& view) {
    interim.push_back(view);
    return true;
  });
  ASSERT_EQ(interim.size(), 2U) << "the last step gives the final view";
  for (int step = 0; step < 2; ++step) {
    SCOPED_TRACE(step);
    for (int west = 0; west < 3; ++west) {
      const Surface ground = interim[step]->surface_at(middle_of_cell(west));
      EXPECT_EQ(ground.loaded, west <= step);
      EXPECT_EQ(std::isnan(ground.elevation_m), west > step);
    }
    EXPECT_FALSE(interim[step]->has_detail(0));
    EXPECT_EQ(test::fast_path(*interim[step], {middle_of_cell(step + 1)}).not_loaded, 1U);
  }
  EXPECT_LT(interim[0]->generation(), interim[1]->generation());
  EXPECT_LT(interim[1]->generation(), whole->generation());
  EXPECT_TRUE(whole->has_detail(0));
  EXPECT_EQ(store->prepare(kRow), whole);
}

TEST(DirectoryStoreSteps, ACellToComeIsReplacedByItsCoarserVersionAndTheViewServesNoDetail) {
  const test::TemporaryFolder folder;
  write_row(folder);
  const auto store = steps_over(folder);
  TerrainRegion coarse = kRow;
  coarse.detail = detail_for(4100.0);  // every fourth post
  const auto before = store->prepare(coarse);
  TerrainViewPointer first;
  const auto whole = store->prepare_in_steps(kRow, [&](const TerrainViewPointer& view) {
    if (!first) first = view;
    return true;
  });
  const geo::GeoPoint near{0.31, 0.43}, far{0.31, 2.43};
  ASSERT_NE(before->elevation_m(far), whole->elevation_m(far));
  EXPECT_EQ(first->elevation_m(near), whole->elevation_m(near)) << "the loaded cell is fine";
  EXPECT_EQ(first->elevation_m(far), before->elevation_m(far)) << "the cell to come is coarse";
  EXPECT_TRUE(first->surface_at(far).loaded);
  EXPECT_TRUE(first->has_peaks());
  EXPECT_FALSE(first->has_detail(kRow.detail));
  EXPECT_FALSE(first->has_detail(coarse.detail));
  EXPECT_TRUE(whole->has_detail(kRow.detail));
  EXPECT_FALSE(whole->has_peaks());
}

TEST(DirectoryStoreSteps, ACellToComeIsReplacedByItsNextCoarserVersionInMemory) {
  const test::TemporaryFolder folder;
  write_row(folder);
  const auto store = steps_over(folder);
  const auto at = [&](int reduction) {
    TerrainRegion region = kRow;
    region.detail = reduction == 0 ? 0 : detail_for(1100.0 * std::ldexp(1.0, reduction));
    return region;
  };
  const geo::GeoPoint far{0.31, 2.43};
  const double coarser_m = store->prepare(at(2))->elevation_m(far);
  store->prepare(at(3));
  store->prepare(at(0));
  TerrainViewPointer first;
  store->prepare_in_steps(at(1), [&](const TerrainViewPointer& view) {
    if (!first) first = view;
    return true;
  });
  EXPECT_EQ(first->elevation_m(far), coarser_m);
}

TEST(DirectoryStoreSteps, AViewServesTheDetailOnceAllCellsWithinReachAreLoaded) {
  const test::TemporaryFolder folder;
  write_row(folder);
  const auto store = steps_over(folder);
  TerrainRegion region = kRow;
  region.reach_m = 100000.0;  // touches the first two cells
  std::vector<bool> served;
  store->prepare_in_steps(region, [&](const TerrainViewPointer& view) {
    served.push_back(view->has_detail(region.detail));
    return true;
  });
  EXPECT_THAT(served, ElementsAre(false, true));
}

TEST(DirectoryStoreSteps, AnInterruptedLoadingIsContinuedByTheNextPrepare) {
  const test::TemporaryFolder folder;
  write_row(folder);
  const auto store = steps_over(folder);
  const auto first = store->prepare_in_steps(kRow, [](const TerrainViewPointer&) { return false; });
  EXPECT_FALSE(first->has_detail(0));
  EXPECT_TRUE(std::isnan(first->elevation_m(middle_of_cell(1))));
  const auto small = store->prepare({middle_of_cell(0), 1000.0});
  EXPECT_TRUE(small->has_detail(0)) << "all cells of the smaller region are already loaded";
  const auto whole = store->prepare(kRow);
  for (int west = 0; west < 3; ++west) EXPECT_TRUE(whole->surface_at(middle_of_cell(west)).loaded);
}

}  // namespace
}  // namespace yars::model::terrain
