#include "model/hrm/develop.hpp"

#include <array>
#include <cmath>

#include "model/hrm/speckle.hpp"
#include "model/rbm/video_lanes.hpp"
#include "model/reflectivity/decibels.hpp"

namespace yars::model::hrm {

namespace {
// Where the configured figure holds.
constexpr double kNoiseRange_m = 20.0 * geo::kMetresPerNauticalMile;
constexpr double kNoiseWindow_m = 0.67 * geo::kMetresPerNauticalMile;
}  // namespace

double noise_gamma(const radar::HighResolutionConfiguration& configuration, geo::Length slant_range,
                   geo::Length window) {
  return reflectivity::ratio(configuration.noise_gamma_db) * std::pow(slant_range.metres() / kNoiseRange_m, 3.0) *
         kNoiseWindow_m / window.metres();
}

void develop(const radar::RadarConfiguration& configuration, const MapImage& image, const MapNoise& noise, int first,
             int last, std::vector<std::uint8_t>& picture) {
  const radar::HighResolutionConfiguration& hrm = configuration.high_resolution;
  const auto size = static_cast<std::size_t>(image.size);
  Speckle speckle(image.size, noise.looks, configuration.seed, noise.map);
  constexpr std::array<float, 3> kAlone{0.0F, 1.0F, 0.0F};
  for (auto row = static_cast<std::size_t>(first); row < static_cast<std::size_t>(last); ++row) {
    const float* power = &image.power[row * size];
    const rbm::lanes::VideoInputs inputs{power,
                                         power,
                                         power,
                                         kAlone.data(),
                                         static_cast<float>(noise.thermal),
                                         configuration.fidelity.noise ? speckle.row(static_cast<int>(row)) : nullptr,
                                         nullptr,
                                         static_cast<float>(-hrm.brightest_gamma_db),
                                         static_cast<float>(hrm.dynamic_range_db)};
    rbm::lanes::develop(size, inputs, &picture[row * size]);
    if (!image.blind) continue;
    for (std::size_t i = 0; i < size; ++i)
      if (power[i] < 0.0F) picture[row * size + i] = 0;
  }
}

}  // namespace yars::model::hrm
