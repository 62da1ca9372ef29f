#include "model/hrm/report_1996.hpp"

#include <algorithm>
#include <cmath>

#include "lib/radar/fidelity.hpp"
#include "model/physics/clutter.hpp"

namespace yars::model::hrm {

namespace {

constexpr float kWhite = 255.0F;
// Full scale as a multiple of the brightness of level ground at the map's centre. Level ground is then the third of
// eight grays, counted from black as 0. Slopes toward the radar are brighter, and walls are white.
constexpr double kFullScale = 2.5;
constexpr double kMinHeight_m = 100.0;  // [m] lower limit of the aircraft's height; nearer 0 even dark slopes are white

// Brightness that gives white: the same for the whole map, whatever its terrain.
float full_scale(const PatchGeometry& geometry) {
  const double height_m = std::max(geometry.above_plane_m(geometry.distance_m()), kMinHeight_m);
  return static_cast<float>(std::min(1.0, kFullScale * height_m / std::hypot(height_m, geometry.distance_m())));
}

// Slope of the surface across the line of sight [m/m], positive if it rises to the right. One-sided at the edges of the
// sector.
float slope_across(const PolarGrid& grid, const SurfacePoint* surface, int column, int row) {
  const int left = std::max(column - 1, grid.first_strip * kStripColumns);
  const int right = std::min(column + 1, grid.end_strip * kStripColumns - 1);
  const auto width_m = static_cast<float>(grid.width_m(column, grid.distance_m(row)) * (right - left));
  return (surface[grid.at(right, row)].height_m - surface[grid.at(left, row)].height_m) / width_m;
}

// Linear interpolation: first of the two samples next to a position, and the weight of the second.
struct SamplePair {
  int first;
  float second_weight;
};

SamplePair sample_pair(double position, int count) {
  const double clamped = std::clamp(position, 0.0, static_cast<double>(count - 1));
  const int first = std::min(static_cast<int>(clamped), count - 2);
  return {first, static_cast<float>(clamped - first)};
}

// Inputs of the shading. Ground and scene are already drawn on `surface`.
struct ShadingInputs {
  const SurfacePoint* surface;  // by PolarGrid::at(); SurfacePoint::gamma is +0 at a void
  const float* horizon;         // by column: greatest tangent of elevation angle of ground nearer than row 0
};

// Computes the brightness of the columns [first, last) from the heights of these columns and their neighbours.
void shade_polar_grid(const PatchGeometry& geometry, const PolarGrid& grid, const ShadingInputs& inputs, int first,
                      int last, float* brightness) {
  const auto spacing_m = static_cast<float>(grid.spacing_m);
  for (int column = first; column < last; ++column) {
    float horizon = inputs.horizon[column];
    for (int row = 0; row < grid.rows; ++row) {
      const std::size_t at = grid.at(column, row);
      const auto distance_m = static_cast<float>(grid.distance_m(row));
      const float height_m = inputs.surface[at].height_m;
      const float up_m = height_m - static_cast<float>(geometry.above_plane_m(grid.distance_m(row)));
      const float tangent = up_m / distance_m;
      brightness[at] = 0.0F;
      if (!(tangent > horizon)) continue;
      horizon = tangent;
      // SurfacePoint::gamma is +0 at a void. It is negated for a standing scene surface, so -0 is no void.
      if (const float gamma = inputs.surface[at].gamma; gamma == 0.0F && !std::signbit(gamma)) continue;
      const int nearer = std::max(row - 1, 0);
      const int farther = row == 0 ? 1 : row;
      const float along =
          (inputs.surface[grid.at(column, farther)].height_m - inputs.surface[grid.at(column, nearer)].height_m) /
          spacing_m;
      const float across = slope_across(grid, inputs.surface, column, row);
      const float normal_length = std::sqrt(1.0F + along * along + across * across);
      const float slant_m = std::sqrt(distance_m * distance_m + up_m * up_m);
      brightness[at] = std::max(0.0F, (along * distance_m - up_m) / (normal_length * slant_m));
    }
  }
}

// Interpolates rows [first, last) of the map bilinearly from the polar grid, in the pixels that the sector draws.
void draw_brightness(const PatchGeometry& geometry, const PolarGrid& grid, const float* brightness, int first, int last,
                     MapImage& image) {
  const double pixel_m = geometry.window_m() / image.size;
  const double edge_m = 0.5 * geometry.window_m();
  for (int line = first; line < last; ++line) {
    const double ahead_m = geometry.distance_m() + edge_m - (line + 0.5) * pixel_m;
    for (int pixel = 0; pixel < image.size; ++pixel) {
      const double right_m = (pixel + 0.5) * pixel_m - edge_m;
      float& value = image.power[image.at(pixel, line)];
      if (!(ahead_m > 0.0)) {
        value = 0.0F;
        continue;
      }
      const SamplePair column = sample_pair((right_m / ahead_m - grid.first_tangent) / grid.tangent_step, grid.columns);
      if (column.first < grid.first_drawn_column() || column.first >= grid.end_drawn_column()) continue;
      const double distance_m = std::sqrt(right_m * right_m + ahead_m * ahead_m);
      const SamplePair row = sample_pair((distance_m - grid.first_distance_m) / grid.spacing_m, grid.rows);
      const auto along = [&](int grid_column) {
        const float near = brightness[grid.at(grid_column, row.first)];
        return near + row.second_weight * (brightness[grid.at(grid_column, row.first + 1)] - near);
      };
      const float left = along(column.first);
      value = left + column.second_weight * (along(column.first + 1) - left);
    }
  }
}

}  // namespace

Report1996::Report1996(const physics::RadarParameters& parameters)
    : cells_per_pixel_(parameters.fidelity.map_oversampling),
      noise_(parameters.fidelity.map_noise),
      seed_(parameters.seed),
      scene_(parameters) {}

void Report1996::begin(const PatchData& data) {
  scene_.begin(data);
  brightness_.resize(data.points);
}

void Report1996::draw_scene(const PatchInputs& inputs, PatchData& data) {
  scene_.draw(inputs, data);
}

void Report1996::cast_profiles(const PatchInputs& inputs, PatchData& data) {
  parallel_for_strips(inputs.executor, data.grid, [&](int first, int last, std::size_t) {
    shade_polar_grid(*data.geometry, data.grid, {data.surface.data(), data.horizon.data()}, first * kStripColumns,
                     last * kStripColumns, brightness_.data());
  });
}

void Report1996::draw_pixels(const PatchInputs& inputs, PatchData& data) {
  parallel_for_rows(inputs.executor, data.image, [&](int first, int last, std::size_t) {
    draw_brightness(*data.geometry, data.grid, brightness_.data(), first, last, data.image);
  });
}

void Report1996::draw_video(const PatchInputs& inputs, PatchData& data) {
  const MapImage& image = data.image;
  std::vector<std::uint8_t>& picture = data.picture;
  constexpr auto kHalfOfBits =
      2147483648.0F;  // 2^31; bits / 2^31 - 1 maps 32 bits to [-1, 1]; float rounding makes the 128 greatest values 1
  const auto noise = static_cast<float>(noise_);
  const float scale = kWhite / full_scale(*data.geometry);
  const auto size = static_cast<std::size_t>(image.size);
  picture.resize(image.power.size());
  for (std::size_t row = 0; row < size; ++row) {
    const physics::NoiseState state =
        physics::make_noise_state({seed_, inputs.order.map, static_cast<std::uint32_t>(row)});
    for (std::size_t column = 0; column < size; ++column) {
      const std::size_t at = row * size + column;
      const auto bits = physics::noise_bits(state, static_cast<std::uint32_t>(column));
      const float random = static_cast<float>(bits) / kHalfOfBits - 1.0F;
      const float level = std::max(image.power[at], 0.0F) * (1.0F + noise * random);
      picture[at] = static_cast<std::uint8_t>(std::min(scale * level + 0.5F, kWhite));
    }
  }
}

}  // namespace yars::model::hrm
