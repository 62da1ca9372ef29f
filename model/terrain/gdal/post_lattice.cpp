#include "model/terrain/gdal/post_lattice.hpp"

#include <algorithm>
#include <cmath>

namespace yars::model::terrain::gdal {

PostLattice::PostLattice(const Georeference& georeference, const Grid& grid, const PostBox& box)
    : rows_((box.intervals_north + kStep - 1) / kStep + 1),
      columns_((box.intervals_east + kStep - 1) / kStep + 1),
      intervals_north_(box.intervals_north),
      intervals_east_(box.intervals_east) {
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const int post_row = box.first_row + std::min(row * kStep, intervals_north_);
      const int post_column = box.first_column + std::min(column * kStep, intervals_east_);
      column_.push_back(grid.west_deg + static_cast<double>(post_column) / (grid.columns - 1));
      row_.push_back(grid.south_deg + static_cast<double>(post_row) / (grid.rows - 1));
    }
  if (georeference.heights_are_ellipsoidal()) above_m_ = georeference.above_sea_level_m(column_, row_);
  georeference.to_pixels(column_, row_, {grid.west_deg + 0.5, grid.south_deg + 0.5});
}

PostLattice::Node PostLattice::node_at(int row, int column) const {
  const auto locate = [](int post, int nodes, int intervals) {
    const int node = std::clamp(post / kStep, 0, std::max(0, nodes - 2));
    const int length = std::max(1, std::min(kStep, intervals - node * kStep));
    return std::pair(node, length);
  };
  const auto [north, north_posts] = locate(row, rows_, intervals_north_);
  const auto [east, east_posts] = locate(column, columns_, intervals_east_);
  return {static_cast<std::size_t>(north) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(east),
          static_cast<double>(row - north * kStep) / north_posts,
          static_cast<double>(column - east * kStep) / east_posts, static_cast<double>(north_posts),
          static_cast<double>(east_posts)};
}

double PostLattice::between(const std::vector<double>& values, const Node& node) const {
  const std::size_t up = rows_ > 1 ? static_cast<std::size_t>(columns_) : 0;
  const std::size_t right = columns_ > 1 ? 1 : 0;
  const double* const at = &values[node.south_west];
  const double south = at[0] + node.east * (at[right] - at[0]);
  const double north = at[up] + node.east * (at[up + right] - at[up]);
  return south + node.north * (north - south);
}

PixelPlace PostLattice::place(int row, int column) const {
  const Node node = node_at(row, column);
  return {between(column_, node), between(row_, node)};
}

PixelStep PostLattice::step(int row, int column) const {
  const Node node = node_at(row, column);
  const std::size_t up = rows_ > 1 ? static_cast<std::size_t>(columns_) : 0;
  const std::size_t right = columns_ > 1 ? 1 : 0;
  const std::size_t at = node.south_west;
  return {(column_[at + up] - column_[at]) / node.north_posts, (row_[at + up] - row_[at]) / node.north_posts,
          (column_[at + right] - column_[at]) / node.east_posts, (row_[at + right] - row_[at]) / node.east_posts};
}

double PostLattice::above_sea_level_m(int row, int column) const {
  return above_m_.empty() ? 0.0 : between(above_m_, node_at(row, column));
}

std::optional<PixelBounds> PostLattice::bounds() const {
  std::optional<PixelBounds> bounds;
  for (std::size_t i = 0; i < column_.size(); ++i) {
    if (std::isnan(column_[i])) continue;
    if (!bounds) bounds = PixelBounds{column_[i], column_[i], row_[i], row_[i]};
    bounds->left = std::min(bounds->left, column_[i]);
    bounds->right = std::max(bounds->right, column_[i]);
    bounds->top = std::min(bounds->top, row_[i]);
    bounds->bottom = std::max(bounds->bottom, row_[i]);
  }
  return bounds;
}

}  // namespace yars::model::terrain::gdal
