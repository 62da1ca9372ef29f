#include "model/terrain/gdal/cell_posts.hpp"

#include <cmath>
#include <utility>

#include "model/terrain/gdal/raster.hpp"

namespace yars::model::terrain::gdal {

namespace {
constexpr double kSea_m = 0.05;  // [m] interpolated sea is not exactly 0
constexpr int kLargestPost = 32767;
}  // namespace

CellPosts::CellPosts(int rows, int columns, bool whole_metres)
    : columns_(columns),
      tenths_(whole_metres ? 10 : 1),
      posts_(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns), kNoHeight) {}

void CellPosts::put(int row, int column, double height_m) {
  if (std::isnan(height_m)) return;
  if (std::abs(height_m) > kLargestPost * unit_m()) coarsen(height_m);
  posts_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column)] =
      rounded(height_m);
}

std::int16_t CellPosts::rounded(double height_m) const {
  if (std::abs(height_m) < kSea_m) return 0;
  const long units = std::lround(height_m / unit_m());
  if (units != 0) return static_cast<std::int16_t>(units);
  return height_m < 0 ? std::int16_t{-1} : std::int16_t{1};
}

void CellPosts::coarsen(double height_m) {
  const double old_m = unit_m();
  tenths_ = static_cast<int>(std::ceil(std::abs(height_m) * 10.0 / kLargestPost));
  for (std::int16_t& post : posts_)
    if (post != kNoHeight && post != 0) post = rounded(post * old_m);
}

}  // namespace yars::model::terrain::gdal
