#include "model/hrm/fan_grid.hpp"

#include <algorithm>

namespace yars::model::hrm {

namespace {
// A margin taller than the picture by this factor is cut: mountains above the aircraft would ask for any number.
constexpr double kMostRowsAPixel = 4.0;
}  // namespace

FanGrid make_fan_grid(const PatchGeometry& geometry, int pixels, int cells, const FanMargins& margins) {
  const double half_m = 0.5 * geometry.window_m();
  const double centre_m = geometry.distance_m();
  FanGrid grid;
  grid.centre_distance_m = centre_m;
  grid.spacing_m = geometry.window_m() / (pixels * cells);
  grid.tangent_step = grid.spacing_m / centre_m;
  // The near corners are seen under the widest angle; a pixel more, for interpolation looks at both neighbours.
  const double nearest_m = std::max(centre_m - half_m, grid.spacing_m);
  const double widest = half_m / nearest_m + 2.0 * grid.tangent_step;
  const int columns = static_cast<int>(std::ceil(2.0 * widest / grid.tangent_step));
  grid.columns = (columns + kStripColumns - 1) / kStripColumns * kStripColumns;
  grid.first_tangent = -0.5 * (grid.columns - 1) * grid.tangent_step;

  const double most_m = kMostRowsAPixel * geometry.window_m();
  const double near_m = std::max(nearest_m - 3.0 * grid.spacing_m - std::min(margins.near_m, most_m), grid.spacing_m);
  const double far_m = std::hypot(centre_m + half_m, half_m) + 2.0 * grid.spacing_m + std::min(margins.far_m, most_m);
  // Ahead of the centre rows lie on the middles of pixels, as columns do: what lies between rows is less sharp.
  const double middle = std::fmod(0.5 * cells * (pixels % 2 == 0 ? 1.0 : 0.0), 1.0);
  const double before = std::floor((centre_m - near_m) / grid.spacing_m - middle) + middle;
  grid.first_distance_m = centre_m - before * grid.spacing_m;
  grid.rows = static_cast<int>(std::ceil((far_m - grid.first_distance_m) / grid.spacing_m)) + 1;
  return grid;
}

}  // namespace yars::model::hrm
