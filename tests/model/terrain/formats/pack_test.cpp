// Packs: cells compressed by JPEG 2000, with a side file. Lossless reading, reduced reading, damaged files, writing.
#include "model/terrain/formats/pack.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/jpeg2000.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"

namespace yars::model::terrain {
namespace {

using test::cell_of;
using test::rough_cell;
using test::same_posts;
using ::testing::HasSubstr;

constexpr CellCorner kPackCorner{36, -122};

Cell smooth_cell(int rows, int columns) {
  return cell_of(kPackCorner, rows, columns, [&](int row, int column) {
    return static_cast<int>(800 + 300 * std::sin(6.0 * row / rows) + 400 * std::cos(9.0 * column / columns));
  });
}

error::Expected<CellReading> read_back(const PackedCell& packed, int reduction) {
  return parse_pack(packed.jp2, packed.side, "n36.jp2", kPackCorner, reduction);
}

struct Sides {
  int rows, columns;
};
class PackOf : public ::testing::TestWithParam<Sides> {};

TEST_P(PackOf, UnpacksToTheSamePosts) {
  for (unsigned seed = 0; seed < 2; ++seed) {
    const Cell cell = rough_cell(kPackCorner, GetParam().rows, GetParam().columns, seed);
    const auto packed = pack_cell(cell);
    ASSERT_TRUE(packed.has_value()) << packed.error().message();
    const auto reading = read_back(*packed, 0);
    ASSERT_TRUE(reading.has_value()) << reading.error().message();
    EXPECT_TRUE(same_posts(reading->cell, cell)) << "seed " << seed;
    EXPECT_FALSE(reading->peaks.has_value());
  }
}

TEST_P(PackOf, HasTheVoidsSeaEdgesAndPeaksOfReduceAtEachReduction) {
  const Cell cell = rough_cell(kPackCorner, GetParam().rows, GetParam().columns, 5);
  const auto packed = pack_cell(cell);
  ASSERT_TRUE(packed.has_value());
  for (int reduction = 1; reduction <= 6; ++reduction) {
    const auto reading = read_back(*packed, reduction);
    ASSERT_TRUE(reading.has_value()) << reading.error().message();
    const ReducedCell expected = reduce(cell, std::min(reduction, 5));
    ASSERT_TRUE(reading->peaks.has_value());
    EXPECT_TRUE(same_posts(*reading->peaks, expected.peaks)) << "reduction " << reduction;
    const Cell& reduced = reading->cell;
    ASSERT_EQ(reduced.rows(), expected.means.rows());
    ASSERT_EQ(reduced.columns(), expected.means.columns());
    for (int row = 0; row < reduced.rows(); ++row)
      for (int column = 0; column < reduced.columns(); ++column) {
        const bool edge = row == 0 || column == 0 || row == reduced.rows() - 1 || column == reduced.columns() - 1;
        EXPECT_EQ(reduced.post(row, column) == kVoidPost, expected.means.post(row, column) == kVoidPost);
        EXPECT_EQ(reduced.post(row, column) == 0, expected.means.post(row, column) == 0);
        EXPECT_LE(reduced.post(row, column), expected.peaks.post(row, column));
        if (edge) {
          EXPECT_EQ(reduced.post(row, column), expected.means.post(row, column));
        }
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Pack, PackOf,
                         ::testing::Values(Sides{121, 121}, Sides{121, 61}, Sides{81, 31}, Sides{2, 2}, Sides{6, 4},
                                           Sides{33, 2}));

TEST(Pack, HasTheMeansOfSmoothGroundAtEachReduction) {
  const Cell cell = smooth_cell(241, 241);
  const auto packed = pack_cell(cell);
  ASSERT_TRUE(packed.has_value());
  for (int reduction = 1; reduction <= 3; ++reduction) {
    const Cell reduced = read_back(*packed, reduction)->cell;
    const Cell means = reduce(cell, reduction).means;
    for (int row = 0; row < reduced.rows(); ++row)
      for (int column = 0; column < reduced.columns(); ++column)
        // Tolerance: curvature of the waves over half a spacing, and the rounding of each level.
        ASSERT_NEAR(reduced.post(row, column), means.post(row, column), 2 + reduction * reduction);
  }
}

TEST(Pack, KeepsACellOfVoidsAndExtremeHeights) {
  const Cell nothing = cell_of(kPackCorner, 9, 9, [](int, int) { return int{kVoidPost}; });
  EXPECT_TRUE(same_posts(read_back(*pack_cell(nothing), 0)->cell, nothing));
  EXPECT_EQ(read_back(*pack_cell(nothing), 2)->cell.voids(), 9U);
  const Cell cliffs =
      cell_of(kPackCorner, 17, 17, [](int row, int column) { return (row + column) % 2 == 0 ? 32767 : -32767; });
  EXPECT_TRUE(same_posts(read_back(*pack_cell(cliffs), 0)->cell, cliffs));
}

TEST(Pack, KeepsTheUnitOfThePostsAtEachReduction) {
  const Cell rough = rough_cell(kPackCorner, 61, 61, 4);
  const Cell cell(kPackCorner, 61, 61, rough.posts(), 0.3);
  const auto packed = pack_cell(cell);
  ASSERT_TRUE(packed.has_value()) << packed.error().message();
  EXPECT_EQ(packed->side[11], std::byte{2}) << "version 2: posts in a unit other than metres";
  EXPECT_EQ(pack_cell(rough)->side[11], std::byte{1}) << "version 1: posts in metres, readable by older readers";
  for (const int reduction : {0, 1, 2}) {
    const auto reading = read_back(*packed, reduction);
    ASSERT_TRUE(reading.has_value()) << reading.error().message();
    EXPECT_DOUBLE_EQ(reading->cell.unit_m(), 0.3);
    if (reduction == 0) {
      EXPECT_TRUE(same_posts(reading->cell, cell));
      continue;
    }
    EXPECT_DOUBLE_EQ(reading->peaks.value().unit_m(), 0.3);
    EXPECT_TRUE(same_posts(*reading->peaks, reduce(cell, reduction).peaks));
    EXPECT_DOUBLE_EQ(reading->peaks->highest_m(), cell.highest_m());
  }
}

TEST(Pack, ASmoothCellHasLessThanAThirdOfTheBytesOfItsPosts) {
  const auto packed = pack_cell(smooth_cell(241, 241));
  ASSERT_TRUE(packed.has_value());
  EXPECT_LT(packed->jp2.size() + packed->side.size(), 241U * 241 * 2 / 3);
}

TEST(Pack, DamageToEitherFileIsRefused) {
  const auto packed = pack_cell(rough_cell(kPackCorner, 33, 33, 8));
  ASSERT_TRUE(packed.has_value());
  constexpr unsigned kSeed = 3;
  std::mt19937 random(kSeed);
  for (int round = 0; round < 400; ++round) {
    PackedCell damaged = *packed;
    std::vector<std::byte>& file = round % 2 == 0 ? damaged.jp2 : damaged.side;
    if (round % 4 < 2)
      file.resize(random() % file.size());
    else
      file[random() % file.size()] ^= static_cast<std::byte>(1U + random() % 255);
    for (const int reduction : {0, 2}) {
      const auto reading = read_back(damaged, reduction);
      ASSERT_FALSE(reading.has_value()) << "seed " << kSeed << ", round " << round;
      EXPECT_THAT(reading.error().message(), HasSubstr("n36.jp2"));
    }
  }
}

TEST(Pack, TheSideFileOfAnotherCellIsRefused) {
  const auto one = pack_cell(rough_cell(kPackCorner, 33, 33, 8));
  const auto other = pack_cell(rough_cell(kPackCorner, 33, 33, 9));
  EXPECT_THAT(parse_pack(one->jp2, other->side, "n36.jp2", kPackCorner, 0).error().message(), HasSubstr("beside it"));
}

TEST(Pack, IsIndexedByItsHeaderAndReadFromADirectory) {
  const test::TemporaryFolder folder;
  const Cell cell = rough_cell(kPackCorner, 121, 61, 4);
  const auto path = write_pack(folder.path(), cell);
  ASSERT_TRUE(path.has_value()) << path.error().message();
  EXPECT_EQ(std::filesystem::relative(*path, folder.path()), "w122/n36.jp2");
  const auto index = index_directory(folder.path());
  ASSERT_TRUE(index.has_value()) << index.error().message();
  const CellFile& file = index->at(slot_of(kPackCorner));
  EXPECT_EQ(file.format, CellFormat::pack);
  EXPECT_EQ(file.posts_per_degree, 120);
  EXPECT_EQ(file.posts_per_degree_east, 60);
  EXPECT_TRUE(same_posts(read_cell(file, kPackCorner)->cell, cell));
  std::filesystem::remove(folder.path() / "w122/n36.side");
  EXPECT_THAT(read_cell(file, kPackCorner).error().message(), HasSubstr("n36.side"));
}

TEST(Pack, IsReadUnderNamesInUpperCase) {
  const test::TemporaryFolder folder;
  const Cell cell = smooth_cell(33, 33);
  ASSERT_TRUE(write_pack(folder.path(), cell).has_value());
  const auto lower = folder.path() / "w122", upper = folder.path() / "W122";
  std::filesystem::create_directory(upper);
  std::filesystem::rename(lower / "n36.jp2", upper / "N36.JP2");
  std::filesystem::rename(lower / "n36.side", upper / "N36.SIDE");
  const auto reading = read_pack(upper / "N36.JP2", kPackCorner, 0);
  ASSERT_TRUE(reading.has_value()) << reading.error().message();
  EXPECT_TRUE(same_posts(reading->cell, cell));
}

TEST(Pack, LeavesNoTemporaryFilesAfterWriting) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_pack(folder.path(), smooth_cell(33, 33)).has_value());
  ASSERT_TRUE(write_pack(folder.path(), smooth_cell(17, 17)).has_value()) << "overwritten";
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "w122"))
    names.push_back(entry.path().filename().string());
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("n36.jp2", "n36.side"));
  folder.write("blocked", std::vector<std::byte>(1));
  EXPECT_FALSE(write_pack(folder.path() / "blocked", smooth_cell(17, 17)).has_value());
}

TEST(VoidFill, FillsVoidsFromTheirSurroundings) {
  HeightGrid grid{9, 9, std::vector<std::int16_t>(81, 700)};
  grid.heights[40] = kVoidPost;
  grid.heights[0] = kVoidPost;
  grid.heights[80] = 710;
  fill_voids(grid);
  EXPECT_EQ(grid.heights[40], 700);
  EXPECT_EQ(grid.heights[0], 700);
  EXPECT_EQ(grid.heights[80], 710);
  HeightGrid half{8, 8, std::vector<std::int16_t>(64, kVoidPost)};
  for (std::size_t i = 0; i < 32; ++i) half.heights[i] = 300;
  fill_voids(half);
  for (const std::int16_t height_m : half.heights) EXPECT_EQ(height_m, 300);
}

}  // namespace
}  // namespace yars::model::terrain
