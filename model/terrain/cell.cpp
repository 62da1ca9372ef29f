#include "model/terrain/cell.hpp"

#include <algorithm>
#include <cmath>

#include "lib/failure/require.hpp"

namespace yars::model::terrain {

CellPlace cell_holding(geo::GeoPoint point) {
  const double latitude_deg = std::clamp(point.latitude_deg, -90.0, 90.0);
  const double longitude_deg = geo::wrapped_degrees(point.longitude_deg);
  // The pole itself belongs to the last row; rounding may lift a longitude just below 180 to 180.
  return {std::min(static_cast<int>(std::floor(latitude_deg)), 89),
          std::min(static_cast<int>(std::floor(longitude_deg)), 179)};
}

Cell::Cell(CellPlace place, int rows, int columns, const std::vector<std::int16_t>& posts, double unit_m)
    : place_(place), rows_(rows), columns_(columns), unit_m_(unit_m), blocks_(rows, columns, posts) {
  YARS_REQUIRE(unit_m, >, 0.0);
  bool any = false;
  for (const std::int16_t post : posts) {
    if (post == kVoidPost) {
      ++voids_;
      continue;
    }
    if (post == 0) ++sea_posts_;
    lowest_ = any ? std::min(lowest_, post) : post;
    highest_ = any ? std::max(highest_, post) : post;
    any = true;
  }
}

std::vector<std::int16_t> Cell::posts() const {
  std::vector<std::int16_t> posts;
  posts.reserve(post_count());
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) posts.push_back(blocks_.post(row, column));
  return posts;
}

Cell in_whole_metres(const Cell& cell) {
  std::vector<std::int16_t> posts = cell.posts();
  for (std::int16_t& post : posts) {
    if (post == kVoidPost || post == 0) continue;
    const long metres = std::lround(post * cell.unit_m());
    post = static_cast<std::int16_t>(metres != 0 ? metres : post > 0 ? 1 : -1);
  }
  return {cell.place(), cell.rows(), cell.columns(), posts};
}

}  // namespace yars::model::terrain
