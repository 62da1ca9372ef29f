#include "model/hrm/map_labels.hpp"

#include <cmath>
#include <limits>

#include "model/hrm/map_image.hpp"

namespace yars::model::hrm {

namespace {
constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

}  // namespace

void MapLabels::begin(const PatchGeometry& geometry, const PolarGrid& grid, std::size_t points) {
  if (!wanted()) return;
  above_plane_m_.clear();
  if (use_ == LabelUse::heights)
    for (int row = 0; row < grid.rows; ++row) above_plane_m_.push_back(geometry.above_plane_m(grid.distance_m(row)));
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

namespace {

// Nearest grid cells of the pixels of one row.
struct Cells {
  explicit Cells(int size) : left(static_cast<std::size_t>(size)), column(left.size()), row(left.size()) {}
  std::vector<std::int32_t> left;         // column to the left of the pixel, which decides the sector that draws it
  std::vector<std::int32_t> column, row;  // nearest ones
};

// Steps from pixels to the grid.
struct PixelGrid {
  PixelGrid(const PatchGeometry& map, const PolarGrid& polar, int pixels) : geometry(map), grid(polar), size(pixels) {}

  void find(int line, Cells& cells) const {
    const double ahead_m = geometry.distance_m() + (0.5 - (line + 0.5) / size) * geometry.window_m();
    const auto ahead = static_cast<float>(ahead_m);
    const auto columns_per_m = static_cast<float>(1.0 / (ahead_m * grid.tangent_step));
    const auto first_column = static_cast<float>(-grid.first_tangent / grid.tangent_step);
    const auto rows_per_m = static_cast<float>(1.0 / grid.spacing_m);
    const auto middle_row = static_cast<float>((ahead_m - grid.first_distance_m) / grid.spacing_m);
    const auto pixel_m = static_cast<float>(geometry.window_m() / size);
    const auto edge_m = static_cast<float>(0.5 * geometry.window_m());
    const auto last_column = static_cast<float>(grid.end_strip * kStripColumns - 1);
    const auto last_row = static_cast<float>(grid.rows - 1);
    for (int i = 0; i < size; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const float right_m = (static_cast<float>(i) + 0.5F) * pixel_m - edge_m;
      const float column = std::max(first_column + right_m * columns_per_m, 0.0F);
      // Distance minus ahead_m, in a form that keeps the precision of float.
      const float longer_m = right_m * right_m / (ahead + std::sqrt(ahead * ahead + right_m * right_m));
      const float row = std::max(middle_row + longer_m * rows_per_m, 0.0F);
      cells.left[at] = static_cast<std::int32_t>(column);
      cells.column[at] = static_cast<std::int32_t>(std::min(column + 0.5F, last_column));
      cells.row[at] = static_cast<std::int32_t>(std::min(row + 0.5F, last_row));
    }
  }

  const PatchGeometry& geometry;
  const PolarGrid& grid;
  int size;
};

}  // namespace

void MapLabels::draw(const PatchGeometry& geometry, const PolarGrid& grid, const SurfacePoint* surface, int first,
                     int last) {
  const PixelGrid pixels(geometry, grid, size_);
  Cells cells(size_);
  const int begin = grid.first_drawn_column(), end = grid.end_drawn_column();
  for (int line = first; line < last; ++line) {
    pixels.find(line, cells);
    std::size_t pixel = static_cast<std::size_t>(line) * static_cast<std::size_t>(size_);
    for (std::size_t i = 0; i < cells.column.size(); ++i, ++pixel) {
      if (cells.left[i] < begin || cells.left[i] >= end) continue;
      const std::size_t top = grid.at(cells.column[i], 0);
      set_pixel(pixel, top, top + static_cast<std::size_t>(cells.row[i]) * kStripColumns);
      if (use_ == LabelUse::heights)
        set_heights(pixel, geometry, grid, surface + top,
                    shown_row_[top + static_cast<std::size_t>(cells.row[i]) * kStripColumns]);
    }
  }
}

// `top`: entry of the column's row 0; `cell`: of the pixel's cell.
void MapLabels::set_pixel(std::size_t pixel, std::size_t top, std::size_t cell) {
  const bool dark = !(strength_[cell] > 0.0F);
  const std::uint32_t label = dark ? 0U : surface_[top + static_cast<std::size_t>(shown_row_[cell]) * kStripColumns];
  pixels_.shadow[pixel] = dark ? 1 : 0;
  pixels_.layover[pixel] = layers_[cell] > 1 ? 1 : 0;
  pixels_.object[pixel] = object_of(label);
  pixels_.material[pixel] = material_of(label);
}

// `column`: surface of the pixel's column, row 0; `row`: the row that it shows, undefined in shadow.
void MapLabels::set_heights(std::size_t pixel, const PatchGeometry& geometry, const PolarGrid& grid,
                            const SurfacePoint* column, std::int32_t row) {
  pixels_.height_m[pixel] = pixels_.sin_grazing[pixel] = kNoNumber;
  if (pixels_.shadow[pixel] != 0) return;
  const auto height_m = [&](std::int32_t at) { return column[static_cast<std::size_t>(at) * kStripColumns].height_m; };
  pixels_.height_m[pixel] = height_m(row) + static_cast<float>(geometry.plane_msl_m());
  // Sine of the angle between the line of sight and the piece of the profile that ends at the shown point.
  const std::int32_t far_row = std::max(row, 1);
  const auto up_m = [&](std::int32_t at) {
    return static_cast<double>(height_m(at)) - above_plane_m_[static_cast<std::size_t>(at)];
  };
  const double near_up_m = up_m(far_row - 1);
  const double climb_m = up_m(far_row) - near_up_m;
  const double middle_up_m = near_up_m + 0.5 * climb_m;
  const double distance_m = grid.distance_m(far_row - 0.5);
  const double across = distance_m * climb_m - middle_up_m * grid.spacing_m;
  const double lengths2 =
      (distance_m * distance_m + middle_up_m * middle_up_m) * (grid.spacing_m * grid.spacing_m + climb_m * climb_m);
  pixels_.sin_grazing[pixel] = static_cast<float>(std::clamp(across / std::sqrt(lengths2), 0.0, 1.0));
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
