#include "model/hrm/develop.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/radar/map_formation.hpp"
#include "model/rbm/noise.hpp"
#include "model/rbm/video_lanes.hpp"
#include "model/reflectivity/decibels.hpp"

namespace yars::model::hrm {

namespace {
constexpr double kNoiseRange_m = 20.0 * geo::kMetresPerNauticalMile;
constexpr std::size_t kSlack = 16;  // entries that vectors may touch behind a row
}  // namespace

double noise_gamma(const radar::HighResolutionConfiguration& configuration, geo::Length slant_range) {
  return reflectivity::ratio(configuration.noise_gamma_db) * std::pow(slant_range.metres() / kNoiseRange_m, 3.0);
}

void develop(const radar::RadarConfiguration& configuration, const MapImage& image, double noise, int looks,
             std::uint32_t map, std::vector<std::uint8_t>& picture) {
  const radar::HighResolutionConfiguration& hrm = configuration.high_resolution;
  const auto size = static_cast<std::size_t>(image.size);
  picture.resize(image.power.size());
  constexpr auto kCells = static_cast<std::size_t>(radar::kCellsOfMap);
  const std::size_t cells = std::min(kCells, size);
  std::vector<float> variate(cells + 2 * kSlack, 1.0F);
  constexpr std::array<float, 3> kAlone{0.0F, 1.0F, 0.0F};
  const float cells_a_pixel = size > kCells ? static_cast<float>(kCells) / static_cast<float>(size) : 1.0F;
  std::vector<std::int32_t> cell(size + kSlack);
  for (std::size_t i = 0; i < cell.size(); ++i)
    cell[i] = static_cast<std::int32_t>(
        rbm::resolution_cell(static_cast<std::uint32_t>(std::min(i, size - 1)), cells_a_pixel));
  std::uint32_t drawn = ~0U;
  for (std::size_t row = 0; row < size; ++row) {
    const auto cell_row = rbm::resolution_cell(static_cast<std::uint32_t>(row), cells_a_pixel);
    if (configuration.fidelity.noise && cell_row != drawn) {
      drawn = cell_row;
      rbm::lanes::speckle(cells, rbm::make_noise_state({configuration.seed, map, cell_row}), looks, variate.data());
    }
    const float* power = &image.power[row * size];
    const rbm::lanes::VideoInputs inputs{power,
                                         power,
                                         power,
                                         kAlone.data(),
                                         static_cast<float>(noise),
                                         configuration.fidelity.noise ? variate.data() : nullptr,
                                         size > kCells ? cell.data() : nullptr,
                                         static_cast<float>(-hrm.brightest_gamma_db),
                                         static_cast<float>(hrm.dynamic_range_db)};
    rbm::lanes::develop(size, inputs, &picture[row * size]);
    if (!image.blind) continue;
    for (std::size_t i = 0; i < size; ++i)
      if (power[i] < 0.0F) picture[row * size + i] = 0;
  }
}

}  // namespace yars::model::hrm
