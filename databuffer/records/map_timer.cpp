#include "databuffer/records/map_timer.hpp"

#include <cmath>

#include "lib/radar/modes.hpp"

namespace yars::databuffer {

namespace {

bool maps_from(radar::Mode mode) {
  return mode == radar::Mode::rbm || mode == radar::Mode::hrm || mode == radar::Mode::patch;
}

}  // namespace

std::optional<double> map_timer_s(const RadarState& state, const ModelStatus& model) {
  if (!std::isfinite(model.map_timer_s)) return std::nullopt;
  const bool forms = model.map_window_nm > 0.0;
  const bool could = maps_from(static_cast<radar::Mode>(state.resume_mode)) &&
                     state.cursor_function == static_cast<std::uint8_t>(radar::CursorFunction::map) &&
                     state.window_nm > 0.0 && model.mappable != 0;
  if (!forms && !could) return std::nullopt;
  return model.map_timer_s;
}

}  // namespace yars::databuffer
