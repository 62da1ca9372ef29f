// Reduction of a cell to means and peaks of coarser spacing, against the definition computed post by post; resampling.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "model/terrain/formats/cell.hpp"
#include "model/terrain/sampling/cell_view.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"

namespace yars::model::terrain {
namespace {

using test::cell_of;
using test::rough_cell;
using test::same_posts;

constexpr CellCorner kReducedCorner{50, 10};

TEST(Cell, HasItsPostsInBlocksOfAnySizeOfGrid) {
  for (int rows = 2; rows <= 8; ++rows)
    for (int columns = 2; columns <= 24; ++columns) {
      std::vector<std::int16_t> posts;
      for (int i = 0; i < rows * columns; ++i) posts.push_back(static_cast<std::int16_t>(i - 20));
      const Cell cell(kReducedCorner, rows, columns, posts);
      ASSERT_EQ(cell.posts(), posts) << rows << " x " << columns;
      const std::int16_t* entries = cell.blocks().data();
      for (int row = 0; row + 1 < rows; ++row)
        for (int column = 0; column + 1 < columns; ++column) {
          const int block = row / 3 * cell.blocks().block_columns() + column / 7;
          const std::int16_t* entry = entries + block * 32 + row % 3 * 8 + column % 7;
          const std::array<int, 4> around = {entry[0], entry[1], entry[8], entry[9]};
          const int post = row * columns + column - 20;
          ASSERT_THAT(around, testing::ElementsAre(post, post + 1, post + columns, post + columns + 1));
        }
    }
}

TEST(Cell, CountsVoidsAndSeaAndKnowsItsExtremes) {
  std::vector<std::int16_t> posts(std::size_t{3} * 11, 5);
  posts[0] = posts[32] = kVoidPost;
  posts[7] = posts[12] = posts[31] = 0;
  const auto cell = [&] { return Cell(kReducedCorner, 3, 11, posts); };
  EXPECT_EQ(cell().voids(), 2U);
  EXPECT_EQ(cell().sea_posts(), 3U);
  EXPECT_EQ(cell().lowest_m(), 0);
  EXPECT_EQ(cell().highest_m(), 5);
  posts[9] = -32767;
  posts[25] = 32767;
  EXPECT_EQ(cell().lowest_m(), -32767);
  EXPECT_EQ(cell().highest_m(), 32767);
  posts.assign(posts.size(), kVoidPost);
  EXPECT_EQ(cell().voids(), posts.size());
  EXPECT_EQ(cell().lowest_m(), 0);
  EXPECT_EQ(cell().highest_m(), 0);
}

// Weight of a post in the mean of a coarse post, along one axis. `offset`: posts between the two. A post on the border
// between two coarse posts has weight 0.5.
double axis_weight(int offset, int factor) {
  const double far = std::abs(offset) - factor / 2.0;
  if (far > 0) return 0.0;
  return far == 0.0 && factor > 1 ? 0.5 : 1.0;
}

int expected_mean(const Cell& cell, int row, int column, int row_factor, int column_factor) {
  const bool row_edge = row == 0 || row == cell.rows() - 1;
  const bool column_edge = column == 0 || column == cell.columns() - 1;
  double sum = 0;
  double weight = 0;
  double sea = 0;
  for (int r = 0; r < cell.rows(); ++r)
    for (int c = 0; c < cell.columns(); ++c) {
      const double down = row_edge ? (r == row ? 1.0 : 0.0) : axis_weight(r - row, row_factor);
      const double right = column_edge ? (c == column ? 1.0 : 0.0) : axis_weight(c - column, column_factor);
      if (down * right == 0.0 || cell.post(r, c) == kVoidPost) continue;
      sum += down * right * cell.post(r, c);
      weight += down * right;
      if (cell.post(r, c) == 0) sea += down * right;
    }
  if (weight == 0.0) return kVoidPost;
  if (sea > weight / 2) return 0;
  const int rounded = static_cast<int>(std::round(sum / weight));
  return rounded != 0 ? rounded : (sum < 0 ? -1 : 1);
}

int expected_peak(const Cell& cell, int row, int column, int row_factor, int column_factor) {
  int highest = kVoidPost;
  for (int r = 0; r < cell.rows(); ++r)
    for (int c = 0; c < cell.columns(); ++c)
      if (std::abs(r - row) < row_factor && std::abs(c - column) < column_factor)
        highest = std::max<int>(highest, cell.post(r, c));
  return highest;
}

struct Factors {
  int rows, columns, row_factor, column_factor;
};
class ReducedBy : public ::testing::TestWithParam<Factors> {};

TEST_P(ReducedBy, MeansAndPeaksEqualTheirDefinition) {
  const Factors f = GetParam();
  for (unsigned seed = 0; seed < 3; ++seed) {
    const Cell cell = rough_cell(kReducedCorner, f.rows, f.columns, seed);
    const ReducedCell coarse = reduce_by(cell, f.row_factor, f.column_factor);
    ASSERT_EQ(coarse.means.rows(), (f.rows - 1) / f.row_factor + 1);
    ASSERT_EQ(coarse.means.columns(), (f.columns - 1) / f.column_factor + 1);
    for (int row = 0; row < coarse.means.rows(); ++row)
      for (int column = 0; column < coarse.means.columns(); ++column) {
        const int r = row * f.row_factor;
        const int c = column * f.column_factor;
        ASSERT_EQ(coarse.means.post(row, column), expected_mean(cell, r, c, f.row_factor, f.column_factor))
            << "seed " << seed << " at " << row << ", " << column;
        ASSERT_EQ(coarse.peaks.post(row, column), expected_peak(cell, r, c, f.row_factor, f.column_factor))
            << "seed " << seed << " at " << row << ", " << column;
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Reduce, ReducedBy,
                         ::testing::Values(Factors{17, 17, 1, 1}, Factors{17, 17, 2, 2}, Factors{17, 33, 4, 8},
                                           Factors{31, 31, 3, 5}, Factors{21, 11, 10, 1}, Factors{17, 17, 16, 16}));

TEST(Reduce, ADimensionIsHalvedAsOftenAsItsIntervalsDivideByTwo) {
  EXPECT_EQ(halvings(2), 0);
  EXPECT_EQ(halvings(121), 3);
  EXPECT_EQ(halvings(1201), 4);
  const Cell cell = rough_cell(kReducedCorner, 13, 9, 1);  // 12 and 8 intervals: two and three halvings
  const ReducedCell coarse = reduce(cell, 5);
  EXPECT_EQ(coarse.means.rows(), 4);
  EXPECT_EQ(coarse.means.columns(), 2);
  EXPECT_EQ(reduced_posts(13, 5), 4);
  EXPECT_TRUE(same_posts(coarse.peaks, reduce_by(cell, 4, 8).peaks));
}

TEST(Reduce, ZeroReductionsGiveTheSameCell) {
  const Cell cell = rough_cell(kReducedCorner, 9, 9, 2);
  const ReducedCell same = reduce(cell, 0);
  EXPECT_TRUE(same_posts(same.means, cell));
  EXPECT_TRUE(same_posts(same.peaks, cell));
}

TEST(Reduce, NeighboursKeepTheirCommonEdgeEqual) {
  const Cell west = rough_cell({50, 10}, 33, 17, 3);
  const Cell other = rough_cell({50, 11}, 33, 17, 4);
  const Cell east = cell_of({50, 11}, 33, 17, [&](int row, int column) {
    return column == 0 ? west.post(row, 16) : other.post(row, column);
  });
  const Cell north = cell_of({51, 10}, 33, 17, [&](int row, int column) {
    return row == 0 ? west.post(32, column) : other.post(row, column);
  });
  for (int reduction = 1; reduction <= 4; ++reduction) {
    const Cell a = reduce(west, reduction).means;
    const Cell b = reduce(east, reduction).means;
    const Cell c = reduce(north, reduction).means;
    for (int row = 0; row < a.rows(); ++row) EXPECT_EQ(a.post(row, a.columns() - 1), b.post(row, 0));
    for (int column = 0; column < a.columns(); ++column) EXPECT_EQ(a.post(a.rows() - 1, column), c.post(0, column));
  }
}

TEST(Reduce, InterpolatedPeaksAreNeverBelowAPost) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const Cell cell = rough_cell(kReducedCorner, 33, 17, seed);
    for (int reduction = 1; reduction <= 3; ++reduction) {
      const Cell peaks = reduce(cell, reduction).peaks;
      for (int row = 0; row < cell.rows(); ++row)
        for (int column = 0; column < cell.columns(); ++column) {
          if (cell.post(row, column) == kVoidPost) continue;
          const double peak_m =
              interpolate(peaks, row / (cell.rows() - 1.0), column / (cell.columns() - 1.0)).elevation_m;
          ASSERT_GE(peak_m, cell.post(row, column) - 1e-6) << "seed " << seed << ", reduction " << reduction;
        }
    }
  }
}

TEST(Reduce, PeaksOfReducedPeaksEqualPeaksOfTheCell) {
  const Cell cell = rough_cell(kReducedCorner, 33, 33, 7);
  EXPECT_TRUE(same_posts(reduce(reduce(cell, 1).peaks, 2).peaks, reduce(cell, 3).peaks));
}

TEST(Reduce, LandNeverBecomesSea) {
  // Posts of -1 m and 1 m alternate. Their means are near 0, but a post of 0 would be sea.
  const Cell cell =
      cell_of(kReducedCorner, 17, 17, [](int row, int column) { return (row + column) % 2 == 0 ? 1 : -1; });
  EXPECT_EQ(reduce(cell, 2).means.sea_posts(), 0U);
  const Cell low =
      cell_of(kReducedCorner, 17, 17, [](int row, int column) { return row % 4 == 0 && column % 4 == 0 ? -1 : 0; });
  EXPECT_EQ(reduce(low, 2).means.post(1, 1), 0) << "mostly sea stays sea";
}

TEST(Resample, ATenthOfTheIntervalsGivesTheMeansOfReduction) {
  const Cell cell = rough_cell(kReducedCorner, 121, 61, 9);
  EXPECT_TRUE(same_posts(resample(cell, 13, 7), reduce_by(cell, 10, 10).means));
}

TEST(Resample, AFinerGridKeepsTheOriginalPosts) {
  const Cell cell = cell_of(kReducedCorner, 5, 5, [](int row, int column) { return 100 + 40 * row - 20 * column; });
  const Cell fine = resample(cell, 17, 9);
  for (int row = 0; row < 17; ++row)
    for (int column = 0; column < 9; ++column) EXPECT_EQ(fine.post(row, column), 100 + 10 * row - 10 * column);
}

TEST(Resample, AGridThatDoesNotDivideTheIntervalsKeepsAPlane) {
  const Cell cell =
      cell_of(kReducedCorner, 101, 101, [](int row, int column) { return 1000 + 10 * row + 20 * column; });
  const Cell other = resample(cell, 41, 31);
  for (int row = 0; row < 41; ++row)
    for (int column = 0; column < 31; ++column)
      EXPECT_NEAR(other.post(row, column), 1000 + 1000.0 * row / 40 + 2000.0 * column / 30,
                  0.51 + 20 * (row % 40 == 0 || column % 30 == 0 ? 1 : 0));
}

}  // namespace
}  // namespace yars::model::terrain
