#include "statemachine/navigators.hpp"

#include <cmath>

#include "lib/geo/quantity.hpp"

namespace yars::statemachine {

namespace {

// Nullptr for what names no navigator, or is no number.
databuffer::NavigatorError* error_named(const Step& step) {
  if (!std::isfinite(step.event.x) || !std::isfinite(step.event.y)) return nullptr;
  switch (static_cast<radar::Navigator>(step.event.argument)) {
    case radar::Navigator::mission:
      return &step.state.mission;
    case radar::Navigator::ins:
      return &step.state.ins;
  }
  return nullptr;
}

}  // namespace

void put_position_error(Step& step) {
  if (auto* error = error_named(step)) {
    error->north_m = geo::Length::feet(step.event.x).metres();
    error->east_m = geo::Length::feet(step.event.y).metres();
  }
}

void put_drift(Step& step) {
  if (auto* error = error_named(step)) {
    error->velocity_north_mps = geo::Length::feet(step.event.x).metres();
    error->velocity_east_mps = geo::Length::feet(step.event.y).metres();
  }
}

}  // namespace yars::statemachine
