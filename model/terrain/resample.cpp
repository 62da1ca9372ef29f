#include "model/terrain/resample.hpp"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "lib/failure/require.hpp"
#include "model/terrain/interpolation.hpp"
#include "model/terrain/reduce.hpp"

namespace yars::model::terrain {

namespace {

// The whole number of old intervals in a new one; 1 where the new grid is finer.
int whole_factor(int old_posts, int new_posts) {
  const int old_intervals = old_posts - 1;
  for (int factor = old_intervals / (new_posts - 1); factor > 1; --factor)
    if (old_intervals % factor == 0) return factor;
  return 1;
}

std::int16_t rounded(const Surface& surface, double unit_m) {
  if (std::isnan(surface.elevation_m)) return kVoidPost;
  if (surface.water > 0.5) return 0;
  const long units = std::lround(surface.elevation_m / unit_m);
  if (units != 0) return static_cast<std::int16_t>(units);
  return surface.elevation_m < 0 ? std::int16_t{-1} : std::int16_t{1};
}

}  // namespace

Cell resample(const Cell& cell, int rows, int columns) {
  YARS_REQUIRE(rows, >=, 2);
  YARS_REQUIRE(columns, >=, 2);
  if (rows == cell.rows() && columns == cell.columns()) return cell;
  Cell means = reduce_by(cell, whole_factor(cell.rows(), rows), whole_factor(cell.columns(), columns)).means;
  if (rows == means.rows() && columns == means.columns()) return means;
  std::vector<std::int16_t> posts;
  posts.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      posts.push_back(rounded(
          interpolate(means, static_cast<double>(row) / (rows - 1), static_cast<double>(column) / (columns - 1)),
          cell.unit_m()));
  return {cell.place(), rows, columns, posts, cell.unit_m()};
}

}  // namespace yars::model::terrain
