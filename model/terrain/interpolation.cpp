#include "model/terrain/interpolation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace yars::model::terrain {

namespace {

// A place between posts: the post south-west of it and the way on from there [0, 1].
struct Position {
  int row, column;
  double north, east;
};

Position position_in(const Cell& cell, double north_deg, double east_deg) {
  const double row = std::clamp(north_deg, 0.0, 1.0) * (cell.rows() - 1);
  const double column = std::clamp(east_deg, 0.0, 1.0) * (cell.columns() - 1);
  const int south = std::min(static_cast<int>(row), cell.rows() - 2);
  const int west = std::min(static_cast<int>(column), cell.columns() - 2);
  return {south, west, row - south, column - west};
}

Surface bilinear(const Cell& cell, const Position& at) {
  double total = 0.0;
  double height = 0.0;  // [unit_m]
  double water = 0.0;
  for (const int up : {0, 1})
    for (const int right : {0, 1}) {
      const std::int16_t post = cell.post(at.row + up, at.column + right);
      if (post == kVoidPost) continue;
      const double weight = (up == 1 ? at.north : 1 - at.north) * (right == 1 ? at.east : 1 - at.east);
      total += weight;
      height += weight * post;
      if (post == 0) water += weight;
    }
  if (total <= 0.0) return {std::numeric_limits<double>::quiet_NaN(), 0.0};
  return {height / total * cell.unit_m(), water / total};
}

// Catmull-Rom weights of the four posts about a way of t behind the second.
std::array<double, 4> cubic_weights(double t) {
  return {0.5 * t * ((2.0 - t) * t - 1.0), 0.5 * (t * t * (3.0 * t - 5.0) + 2.0), 0.5 * t * ((4.0 - 3.0 * t) * t + 1.0),
          0.5 * t * t * (t - 1.0)};
}

std::optional<double> cubic_height_m(const Cell& cell, const Position& at) {
  const std::array<double, 4> along = cubic_weights(at.north);
  const std::array<double, 4> across = cubic_weights(at.east);
  double height_m = 0.0;
  for (std::size_t up = 0; up < 4; ++up)
    for (std::size_t right = 0; right < 4; ++right) {
      const int row = std::clamp(at.row + static_cast<int>(up) - 1, 0, cell.rows() - 1);
      const int column = std::clamp(at.column + static_cast<int>(right) - 1, 0, cell.columns() - 1);
      const std::int16_t post_m = cell.post(row, column);
      if (post_m == kVoidPost) return std::nullopt;
      height_m += along[up] * across[right] * post_m;
    }
  return height_m * cell.unit_m();
}

}  // namespace

Surface interpolate(const Cell& cell, double north_deg, double east_deg, radar::Interpolation interpolation) {
  Position at = position_in(cell, north_deg, east_deg);
  if (interpolation == radar::Interpolation::nearest) {
    at.north = at.north >= 0.5 ? 1.0 : 0.0;
    at.east = at.east >= 0.5 ? 1.0 : 0.0;
  }
  Surface surface = bilinear(cell, at);
  if (interpolation != radar::Interpolation::cubic) return surface;
  if (const std::optional<double> height_m = cubic_height_m(cell, at)) surface.elevation_m = surface.peak_m = *height_m;
  return surface;
}

}  // namespace yars::model::terrain
