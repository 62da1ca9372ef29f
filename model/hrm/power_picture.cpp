#include "model/hrm/power_picture.hpp"

#include <algorithm>

#include "lib/radar/mapping.hpp"
#include "model/physics/reflectivity.hpp"

namespace yars::model::hrm {

PowerPicture::PowerPicture(const radar::RadarConfiguration& configuration)
    : configuration_(configuration),
      movers_(configuration),
      response_(configuration.high_resolution.sidelobe_db,
                static_cast<double>(radar::kMapCells) / std::max(configuration.fidelity.map_size, 1)) {}

double PowerPicture::thermal_noise(const PatchInputs& inputs, const PatchData& data) const {
  return noise_gamma(configuration_.high_resolution, geo::Length::metres(data.geometry->slant_range_m()),
                     inputs.order.window);
}

void PowerPicture::add_response_and_movers(const PatchInputs& inputs, PatchData& data) {
  // Power below thermal noise and black level is invisible.
  const radar::HighResolutionConfiguration& hrm = configuration_.high_resolution;
  const double black = physics::ratio(hrm.brightest_gamma_db - hrm.dynamic_range_db);
  const double floor = std::max(thermal_noise(inputs, data), black);
  if (configuration_.fidelity.map_response) response_.apply(static_cast<float>(floor), inputs.executor, data.image);
  movers_.draw(inputs.order, *data.geometry, data.formation,
               {*inputs.environment.window, nullptr, true, inputs.environment.traffic},
               {&data.grid, data.surface.data(), data.crests_m(), data.horizon.data()}, response_, data.image);
}

void PowerPicture::draw_video(const PatchInputs& inputs, PatchData& data) const {
  const MapNoise noise{thermal_noise(inputs, data), inputs.order.looks, inputs.order.map};
  data.picture.resize(data.image.power.size());
  constexpr int kRowsPerTask = 128;  // Fewer cost more: each task draws two rows of speckle cells anew.
  parallel::parallel_for(inputs.executor, data.image.size, kRowsPerTask, [&](int first, int last, std::size_t) {
    form_video(configuration_, data.image, noise, first, last, data.picture);
  });
}

}  // namespace yars::model::hrm
