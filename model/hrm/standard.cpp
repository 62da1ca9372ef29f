#include "model/hrm/standard.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "lib/radar/sensor.hpp"
#include "model/physics/reflectivity.hpp"

namespace yars::model::hrm {

Standard::Standard(const physics::RadarParameters& parameters)
    : fidelity_(parameters.fidelity),
      double_bounce_db_(parameters.high_resolution.double_bounce_db),
      gas_(parameters),
      scene_(parameters),
      power_picture_(parameters) {}

void Standard::begin(const PatchData& data) {
  const PolarGrid& grid = data.grid;
  scene_.begin(data);
  cross_section_m2_.resize(data.points + grid.strip_size());  // simd::draw_row() may read one strip more
  distance_m_.clear();
  inverse_m_.clear();
  above_plane_m_.clear();
  above_level_m_.clear();
  for (int row = 0; row < grid.rows; ++row) {
    distance_m_.push_back(static_cast<float>(grid.distance_m(row)));
    inverse_m_.push_back(static_cast<float>(1.0 / data.geometry->sight_distance_m(grid.distance_m(row))));
    above_plane_m_.push_back(static_cast<float>(data.geometry->above_plane_m(grid.distance_m(row))));
    above_level_m_.push_back(static_cast<float>(data.geometry->above_level_m(grid.distance_m(row))));
  }
  fit_gas_rows(data);
  arc_.resize(static_cast<std::size_t>(grid.columns));
  for (int column = 0; column < grid.columns; ++column)
    arc_.data()[column] = static_cast<float>(grid.width_m(column, 1.0));
}

// At nine distances (knots), fits a parabola in height through the two-way gas transmission at three heights. The
// coefficients of each row are interpolated between knots.
void Standard::fit_gas_rows(const PatchData& data) {
  const PolarGrid& grid = data.grid;
  gas_rows_.clear();
  if (gas_.none()) return;
  constexpr int kKnots = 9;
  constexpr std::array<double, 3> kHeights_m{0.0, 2000.0, 5000.0};  // [m MSL]
  constexpr double kLowest_m = -500.0, kHighest_m = 6000.0;         // [m MSL] heights are clamped to this range
  const double plane_m = data.geometry->plane_msl_m();
  std::array<simd::GasRow, kKnots> knots{};
  for (int knot = 0; knot < kKnots; ++knot) {
    const double along_m = std::max(grid.distance_m((grid.rows - 1.0) * knot / (kKnots - 1)), 1.0);
    const auto transmission = [&](std::size_t height) {
      return gas_.two_way_transmission(data.geometry->earth(), data.geometry->altitude_m(), along_m,
                                       kHeights_m[height]);
    };
    const double low = transmission(0), first = (transmission(1) - low) / kHeights_m[1],
                 second = (transmission(2) - low) / kHeights_m[2];
    const double bend = (second - first) / (kHeights_m[2] - kHeights_m[1]);
    const double slope = first - bend * kHeights_m[1];
    knots[static_cast<std::size_t>(knot)] = {
        static_cast<float>(low + plane_m * (slope + plane_m * bend)), static_cast<float>(slope + 2.0 * plane_m * bend),
        static_cast<float>(bend), static_cast<float>(kLowest_m - plane_m), static_cast<float>(kHighest_m - plane_m)};
  }
  for (int row = 0; row < grid.rows; ++row) {
    const float knot_position = static_cast<float>(row) * (kKnots - 1) / static_cast<float>(std::max(grid.rows - 1, 1));
    const auto near = static_cast<std::size_t>(std::min(static_cast<int>(knot_position), kKnots - 2));
    const float fraction = knot_position - static_cast<float>(near);
    const simd::GasRow &nearer = knots[near], &farther = knots[near + 1];
    gas_rows_.push_back({nearer.constant + fraction * (farther.constant - nearer.constant),
                         nearer.slope + fraction * (farther.slope - nearer.slope),
                         nearer.bend + fraction * (farther.bend - nearer.bend), nearer.lowest_m, nearer.highest_m});
  }
}

void Standard::draw_scene(const PatchInputs& inputs, PatchData& data) {
  scene_.draw(inputs, data);
}

simd::Strip Standard::strip_of(PatchData& data, int number) {
  const std::size_t at = data.grid.at(number * kStripColumns, 0);
  const auto column = static_cast<std::size_t>(number) * kStripColumns;
  simd::Strip strip;
  strip.rows = data.grid.rows;
  strip.first_distance_m = static_cast<float>(data.grid.first_distance_m);
  strip.spacing_m = static_cast<float>(data.grid.spacing_m);
  strip.layover = fidelity_.map_layover;
  if (fidelity_.map_double_bounce) strip.double_bounce = static_cast<float>(physics::ratio(double_bounce_db_));
  strip.distance_m = distance_m_.data();
  strip.inverse_m = inverse_m_.data();
  strip.above_plane_m = above_plane_m_.data();
  strip.above_level_m = above_level_m_.data();
  if (!gas_rows_.empty()) strip.gas = gas_rows_.data();
  strip.arc = arc_.data() + column;
  strip.horizon = data.horizon.data() + column;
  strip.surface = data.surface.data() + at;
  if (data.crests_m() != nullptr) strip.crest_m = data.crests_m() + at;
  if (scene_.walls() != nullptr) strip.walls = scene_.walls() + at;
  strip.power = cross_section_m2_.data() + at;
  if (!data.labels.wanted()) return strip;
  strip.strength = data.labels.strength() + at;
  strip.shown_row = data.labels.shown_rows() + at;
  strip.layers = data.labels.layers() + at;
  return strip;
}

void Standard::cast_profiles(const PatchInputs& inputs, PatchData& data) {
  parallel_for_strips(inputs.executor, data.grid, [&](int first, int last, std::size_t) {
    for (int number = first; number < last; ++number) {
      const simd::Strip strip = strip_of(data, number);
      std::fill_n(strip.power, data.grid.strip_size(), 0.0F);
      if (strip.strength != nullptr) {
        std::fill_n(strip.strength, data.grid.strip_size(), 0.0F);
        std::fill_n(strip.layers, data.grid.strip_size(), 0);
      }
      simd::cast_profile(strip);
    }
  });
  scene_.set_clear();
}

void Standard::draw_pixels(const PatchInputs& inputs, PatchData& data) {
  parallel_for_rows(inputs.executor, data.image, [&](int first, int last, std::size_t) {
    draw_polar_grid(*data.geometry, data.grid, cross_section_m2_.data(), first, last, data.image);
  });
  power_picture_.find_hidden_points(inputs, data);
}

void Standard::complete_map(const PatchInputs& inputs, PatchData& data) {
  power_picture_.add_response_and_movers(inputs, data);
}

void Standard::draw_video(const PatchInputs& inputs, PatchData& data) {
  power_picture_.draw_video(inputs, data);
}

}  // namespace yars::model::hrm
