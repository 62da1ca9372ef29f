#include "model/terrain/cell.hpp"

#include <algorithm>
#include <cmath>

namespace yars::model::terrain {

CellPlace cell_holding(geo::GeoPoint point) {
  const double latitude_deg = std::clamp(point.latitude_deg, -90.0, 90.0);
  const double longitude_deg = geo::wrapped_degrees(point.longitude_deg);
  // The pole itself belongs to the last row; rounding may lift a longitude just below 180 to 180.
  return {std::min(static_cast<int>(std::floor(latitude_deg)), 89),
          std::min(static_cast<int>(std::floor(longitude_deg)), 179)};
}

Cell::Cell(CellPlace place, int rows, int columns, const std::vector<std::int16_t>& posts)
    : place_(place), rows_(rows), columns_(columns), blocks_(rows, columns, posts) {
  bool any = false;
  for (const std::int16_t post_m : posts) {
    if (post_m == kVoidPost) {
      ++voids_;
      continue;
    }
    if (post_m == 0) ++sea_posts_;
    lowest_m_ = any ? std::min(lowest_m_, post_m) : post_m;
    highest_m_ = any ? std::max(highest_m_, post_m) : post_m;
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

}  // namespace yars::model::terrain
