#include "model/hrm/map_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/radar/mapping.hpp"
#include "lib/radar/sensor.hpp"
#include "model/hrm/map_image_simd.hpp"
#include "model/physics/clutter_simd.hpp"
#include "model/physics/reflectivity.hpp"

namespace yars::model::hrm {

namespace {
// Lower bound of the sine of the grazing angle in unit_return_m2(). Without it the result, a divisor, could be 0.
constexpr double kMinGrazingSine = 1.0e-3;
}  // namespace

double unit_return_m2(const PatchGeometry& geometry, int pixels) {
  const double pixel_m = geometry.window_m() / pixels;
  return pixel_m * pixel_m * std::max(geometry.sin_grazing(), kMinGrazingSine);
}

void draw_polar_grid(const PatchGeometry& geometry, const PolarGrid& grid, const float* cross_section_m2, int first,
                     int last, MapImage& image) {
  const double pixel_m = geometry.window_m() / image.size;
  const double edge_m = 0.5 * geometry.window_m();
  simd::MapRow row;
  row.columns = image.size;
  row.first_right_m = static_cast<float>(0.5 * pixel_m - edge_m);
  row.pixel_m = static_cast<float>(pixel_m);
  row.scale = static_cast<float>(pixel_m * pixel_m / unit_return_m2(geometry, image.size));
  for (int line = first; line < last; ++line) {
    row.ahead_m = static_cast<float>(geometry.distance_m() + edge_m - (line + 0.5) * pixel_m);
    simd::draw_row(grid, cross_section_m2, row, &image.power[image.at(0, line)]);
  }
}

void blank_blind_zone(const PatchGeometry& geometry, geo::Bearing ground_track,
                      const radar::HighResolutionConfiguration& configuration, MapImage& image) {
  const double pixel_m = geometry.window_m() / image.size;
  const double edge_m = 0.5 * geometry.window_m();
  const geo::Angle squint = geometry.squint(ground_track);
  // Half the angle that the map subtends at the aircraft. No pixel is blind if the centre is farther than this
  // angle from the blind zone.
  const double half_view_deg =
      std::atan2(edge_m, std::max(geometry.distance_m() - edge_m, 1.0)) / geo::kRadiansPerDegree;
  const double off_deg = std::abs(squint.degrees());
  const double clear_deg = std::min(off_deg, 180.0 - off_deg) - configuration.blind_zone_deg;
  if (clear_deg > half_view_deg) return;
  for (int row = 0; row < image.size; ++row) {
    const double ahead_m = geometry.distance_m() + edge_m - (row + 0.5) * pixel_m;
    for (int column = 0; column < image.size; ++column) {
      const double right_m = (column + 0.5) * pixel_m - edge_m;
      const geo::Angle off_centre = geo::Angle::radians(std::atan2(right_m, ahead_m));
      if (!radar::in_blind_zone(squint + off_centre, configuration.blind_zone_deg)) continue;
      image.power[image.at(column, row)] = -1.0F;
      image.blind = true;
    }
  }
}

namespace {
constexpr std::size_t kSlack = 16;  // entries that vectors may access beyond a row
// Length of a row of cells: kMapCells, and one more cell at each end, because the outermost pixels lie beyond the
// centres of the outermost cells.
constexpr int kCellsPerRow = radar::kMapCells + 2;

std::size_t padded(std::size_t count) {
  return (count + kSlack - 1) / kSlack * kSlack;
}
}  // namespace

Speckle::Speckle(int size, int looks, std::uint64_t seed, std::uint32_t map)
    : size_(size),
      looks_(looks),
      seed_(seed),
      map_(map),
      finer_(size > radar::kMapCells),
      pitch_(padded(static_cast<std::size_t>(size))),
      intensity_(pitch_ + kSlack) {
  if (!finer_) return;
  cell_.assign(pitch_, 0);
  first_.assign(pitch_, 0.0F);
  second_.assign(pitch_, 0.0F);
  for (int pixel = 0; pixel < size_; ++pixel) {
    const auto i = static_cast<std::size_t>(pixel);
    const CellWeights weights = cell_weights(pixel);
    cell_[i] = weights.cell;
    first_[i] = weights.first;
    second_[i] = weights.second;
  }
  cells_.assign(2 * padded(kCellsPerRow), 0.0F);
  near_.assign(2 * static_cast<std::size_t>(looks_) * pitch_, 0.0F);
  far_ = near_;
}

Speckle::CellWeights Speckle::cell_weights(int pixel) const {
  const double cell_position = (pixel + 0.5) * radar::kMapCells / size_ - 0.5;
  const double cell = std::floor(cell_position);
  const double second = cell_position - cell;
  const double first = 1.0 - second;
  const double scale = 1.0 / std::sqrt(first * first + second * second);
  return {static_cast<std::int32_t>(cell) + 1, static_cast<float>(first * scale), static_cast<float>(second * scale)};
}

void Speckle::draw_cells(int cell_row, std::vector<float>& field) {
  const std::size_t half = cells_.size() / 2;
  for (int look = 0; look < looks_; ++look) {
    const auto name = static_cast<std::uint32_t>(cell_row * looks_ + look);
    simd::draw_gaussian(half, physics::make_noise_state({seed_, map_, name}), cells_.data(), &cells_[half]);
    float* real = &field[2 * static_cast<std::size_t>(look) * pitch_];
    simd::interpolate(pitch_, {cell_.data(), first_.data(), second_.data()}, cells_.data(), real);
    simd::interpolate(pitch_, {cell_.data(), first_.data(), second_.data()}, &cells_[half], real + pitch_);
  }
}

const float* Speckle::row(int row) {
  if (!finer_) {
    const auto name = static_cast<std::uint32_t>(row);
    physics::simd::speckle(static_cast<std::size_t>(size_), physics::make_noise_state({seed_, map_, name}), looks_,
                           intensity_.data());
    return intensity_.data();
  }
  const CellWeights weights = cell_weights(row);
  while (drawn_row_ < weights.cell + 1) {
    near_.swap(far_);
    drawn_row_ = drawn_row_ < weights.cell ? weights.cell : drawn_row_ + 1;
    draw_cells(drawn_row_, far_);
  }
  simd::intensity(pitch_, looks_, {near_.data(), weights.first}, {far_.data(), weights.second}, intensity_.data());
  return intensity_.data();
}

namespace {
// Slant range and window at which the configured noise_gamma_db applies.
constexpr double kNoiseRange_m = 20.0 * geo::kMetresPerNauticalMile;
constexpr double kNoiseWindow_m = 0.67 * geo::kMetresPerNauticalMile;
}  // namespace

double noise_gamma(const radar::HighResolutionConfiguration& configuration, geo::Length slant_range,
                   geo::Length window) {
  return physics::ratio(configuration.noise_gamma_db) * std::pow(slant_range.metres() / kNoiseRange_m, 3.0) *
         kNoiseWindow_m / window.metres();
}

void form_video(const radar::HighResolutionConfiguration& hrm, const MapImage& image, const MapNoise& noise, int first,
                int last, std::vector<std::uint8_t>& picture) {
  const auto size = static_cast<std::size_t>(image.size);
  Speckle speckle(image.size, noise.looks, noise.seed, noise.map);
  constexpr std::array<float, 3> kNoSmear{0.0F, 1.0F, 0.0F};
  for (auto row = static_cast<std::size_t>(first); row < static_cast<std::size_t>(last); ++row) {
    const float* power = &image.power[row * size];
    const physics::simd::VideoInputs inputs{power,
                                            power,
                                            power,
                                            kNoSmear.data(),
                                            static_cast<float>(noise.thermal),
                                            noise.with_speckle ? speckle.row(static_cast<int>(row)) : nullptr,
                                            nullptr,
                                            static_cast<float>(-hrm.brightest_gamma_db),
                                            static_cast<float>(hrm.dynamic_range_db)};
    physics::simd::form_video(size, inputs, &picture[row * size]);
    if (!image.blind) continue;
    for (std::size_t i = 0; i < size; ++i)
      if (power[i] < 0.0F) picture[row * size + i] = 0;
  }
}

}  // namespace yars::model::hrm
