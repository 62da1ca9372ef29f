#include "model/terrain/void_fill.hpp"

#include <algorithm>
#include <cmath>

#include "model/terrain/cell.hpp"

namespace yars::model::terrain {

namespace {

std::size_t index_of(int row, int column, int columns) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
}

// Means of two by two; void where all four are.
HeightGrid halved(const HeightGrid& fine) {
  HeightGrid coarse{(fine.rows + 1) / 2, (fine.columns + 1) / 2, {}};
  coarse.heights.reserve(index_of(coarse.rows, 0, coarse.columns));
  for (int row = 0; row < coarse.rows; ++row)
    for (int column = 0; column < coarse.columns; ++column) {
      long sum = 0;
      long count = 0;
      for (int down = 2 * row; down < std::min(2 * row + 2, fine.rows); ++down)
        for (int right = 2 * column; right < std::min(2 * column + 2, fine.columns); ++right) {
          const std::int16_t height_m = fine.heights[index_of(down, right, fine.columns)];
          if (height_m == kVoidPost) continue;
          sum += height_m;
          ++count;
        }
      coarse.heights.push_back(count == 0 ? kVoidPost : static_cast<std::int16_t>(sum / count));
    }
  return coarse;
}

// Bilinear between the middles of coarse posts.
std::int16_t between(const HeightGrid& coarse, int fine_row, int fine_column) {
  const auto locate = [](int fine, int count) {
    const double place = std::clamp((fine - 0.5) / 2.0, 0.0, static_cast<double>(count - 1));
    const int first = std::min(static_cast<int>(place), std::max(0, count - 2));
    return std::pair(first, place - first);
  };
  const auto [row, down] = locate(fine_row, coarse.rows);
  const auto [column, right] = locate(fine_column, coarse.columns);
  const int next_row = std::min(row + 1, coarse.rows - 1);
  const int next_column = std::min(column + 1, coarse.columns - 1);
  const auto at = [&coarse](int r, int c) {
    return static_cast<double>(coarse.heights[index_of(r, c, coarse.columns)]);
  };
  const double upper = at(row, column) + right * (at(row, next_column) - at(row, column));
  const double lower = at(next_row, column) + right * (at(next_row, next_column) - at(next_row, column));
  return static_cast<std::int16_t>(std::lround(upper + down * (lower - upper)));
}

}  // namespace

void fill_voids(HeightGrid& grid) {
  if (std::find(grid.heights.begin(), grid.heights.end(), kVoidPost) == grid.heights.end()) return;
  if (grid.rows == 1 && grid.columns == 1) {
    grid.heights[0] = 0;
    return;
  }
  HeightGrid coarse = halved(grid);
  fill_voids(coarse);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      std::int16_t& height_m = grid.heights[index_of(row, column, grid.columns)];
      if (height_m == kVoidPost) height_m = between(coarse, row, column);
    }
}

}  // namespace yars::model::terrain
