#include "model/hrm/map_labels.hpp"

#include <cmath>
#include <limits>

#include "model/hrm/map_image.hpp"

namespace yars::model::hrm {

namespace {
constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

// Number of the grid line nearest to a position in [0, count - 1].
int nearest(float position, int count) {
  return std::clamp(static_cast<int>(position + 0.5F), 0, count - 1);
}
}  // namespace

void MapLabels::begin(std::size_t points) {
  if (!wanted()) return;
  if (surface_.size() < points) {
    surface_ = memory::CacheAlignedVector<std::uint32_t>(points);
    shown_row_ = memory::CacheAlignedVector<std::int32_t>(points);
    layers_ = memory::CacheAlignedVector<std::int32_t>(points);
    strength_ = memory::CacheAlignedVector<float>(points);
  }
  const std::size_t pixels = static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_);
  pixels_.shadow.resize(pixels);
  pixels_.layover.resize(pixels);
  pixels_.object.resize(pixels);
  pixels_.material.resize(pixels);
  const std::size_t heights = use_ == LabelUse::heights ? pixels : 0;
  pixels_.height_m.resize(heights);
  pixels_.sin_grazing.resize(heights);
}

void MapLabels::draw(const PatchGeometry& geometry, const PolarGrid& grid, const SurfacePoint* surface, int first,
                     int last) {
  const auto pixel_m = static_cast<float>(geometry.window_m() / size_);
  const auto edge_m = static_cast<float>(0.5 * geometry.window_m());
  const auto columns_per_tangent = static_cast<float>(1.0 / grid.tangent_step);
  const auto first_column = static_cast<float>(-grid.first_tangent / grid.tangent_step);
  const auto rows_per_m = static_cast<float>(1.0 / grid.spacing_m);
  for (int line = first; line < last; ++line) {
    const double ahead_m =
        geometry.distance_m() + 0.5 * geometry.window_m() - (line + 0.5) * geometry.window_m() / size_;
    const auto ahead = static_cast<float>(ahead_m);
    const auto columns_per_m = static_cast<float>(1.0 / ahead_m) * columns_per_tangent;
    const auto nearest_row = static_cast<float>((ahead_m - grid.first_distance_m) / grid.spacing_m);
    for (int i = 0; i < size_; ++i) {
      const float right_m = (static_cast<float>(i) + 0.5F) * pixel_m - edge_m;
      const float column = first_column + right_m * columns_per_m;
      const auto left = static_cast<int>(column);
      if (left < grid.first_drawn_column() || left >= grid.end_drawn_column()) continue;
      // Distance minus ahead_m, in a form that keeps the precision of float.
      const float longer_m = right_m * right_m / (ahead + std::sqrt(ahead * ahead + right_m * right_m));
      const std::size_t cell = grid.at(std::min(nearest(column, grid.columns), grid.end_strip * kStripColumns - 1),
                                       nearest(nearest_row + longer_m * rows_per_m, grid.rows));
      const std::size_t pixel =
          static_cast<std::size_t>(line) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(i);
      set_pixel(pixel, grid, cell);
      if (use_ == LabelUse::heights) set_heights(pixel, geometry, grid, surface, cell);
    }
  }
}

namespace {
// Entry of the grid point that a cell shows: another row of the cell's column.
std::size_t shown_point(const PolarGrid& grid, std::size_t cell, std::int32_t row) {
  const std::size_t in_strip = cell % grid.strip_size();
  return cell - in_strip + static_cast<std::size_t>(row) * kStripColumns + in_strip % kStripColumns;
}
}  // namespace

void MapLabels::set_pixel(std::size_t pixel, const PolarGrid& grid, std::size_t cell) {
  const bool dark = !(strength_[cell] > 0.0F);
  const std::uint32_t label = dark ? 0U : surface_[shown_point(grid, cell, shown_row_[cell])];
  pixels_.shadow[pixel] = dark ? 1 : 0;
  pixels_.layover[pixel] = layers_[cell] > 1 ? 1 : 0;
  pixels_.object[pixel] = object_of(label);
  pixels_.material[pixel] = material_of(label);
}

void MapLabels::set_heights(std::size_t pixel, const PatchGeometry& geometry, const PolarGrid& grid,
                            const SurfacePoint* surface, std::size_t cell) {
  pixels_.height_m[pixel] = pixels_.sin_grazing[pixel] = kNoNumber;
  if (pixels_.shadow[pixel] != 0) return;
  const std::int32_t row = shown_row_[cell];
  pixels_.height_m[pixel] = surface[shown_point(grid, cell, row)].height_m + static_cast<float>(geometry.plane_msl_m());
  // Sine of the angle between the line of sight and the piece of the profile that ends at the shown point.
  const std::int32_t far_row = std::max(row, 1);
  const auto up_m = [&](std::int32_t at) {
    return static_cast<double>(surface[shown_point(grid, cell, at)].height_m) -
           geometry.above_plane_m(grid.distance_m(at));
  };
  const double near_up_m = up_m(far_row - 1);
  const double climb_m = up_m(far_row) - near_up_m;
  const double middle_up_m = near_up_m + 0.5 * climb_m;
  const double distance_m = grid.distance_m(far_row - 0.5);
  const double across = distance_m * climb_m - middle_up_m * grid.spacing_m;
  const double lengths = std::hypot(distance_m, middle_up_m) * std::hypot(grid.spacing_m, climb_m);
  pixels_.sin_grazing[pixel] = static_cast<float>(std::clamp(across / lengths, 0.0, 1.0));
}

void MapLabels::clear_blind(const MapImage& image) {
  if (!wanted() || !image.blind) return;
  for (std::size_t pixel = 0; pixel < image.power.size(); ++pixel) {
    if (image.power[pixel] >= 0.0F) continue;
    pixels_.shadow[pixel] = pixels_.layover[pixel] = pixels_.material[pixel] = 0;
    pixels_.object[pixel] = -1;
    if (use_ == LabelUse::heights) pixels_.height_m[pixel] = pixels_.sin_grazing[pixel] = kNoNumber;
  }
}

}  // namespace yars::model::hrm
