#include "statemachine/navigators.hpp"

#include <algorithm>
#include <cmath>

#include "lib/geo/quantity.hpp"
#include "lib/radar/chance.hpp"
#include "lib/radar/limits.hpp"

namespace yars::statemachine {

namespace {

using databuffer::NavigatorError;
using databuffer::RadarState;

constexpr std::int64_t kTicksPerSecond = 1'000'000'000 / radar::kTickNanoseconds;
// [m] and [m/s] where an error stops growing: a quarter round the Earth, and far above any aircraft's speed. The
// border, which holds the record to less, would refuse the whole state.
constexpr double kMostError_m = 1e7;
constexpr double kMostDrift_mps = 5e3;

double bounded(double value, double most) {
  return std::clamp(value, -most, most);
}

// Nullptr for what names no navigator, or is no number.
NavigatorError* error_named(const Step& step) {
  if (!std::isfinite(step.event.x) || !std::isfinite(step.event.y)) return nullptr;
  if (step.event.argument == static_cast<std::int16_t>(radar::Navigator::mission)) return &step.state.mission;
  if (step.event.argument == static_cast<std::int16_t>(radar::Navigator::ins)) return &step.state.ins;
  return nullptr;
}

void drift(NavigatorError& error) {
  error.north_m = bounded(error.north_m + error.velocity_north_mps * radar::kTickSeconds, kMostError_m);
  error.east_m = bounded(error.east_m + error.velocity_east_mps * radar::kTickSeconds, kMostError_m);
}

}  // namespace

void put_position_error(Step& step) {
  if (NavigatorError* error = error_named(step)) {
    error->north_m = bounded(geo::Length::feet(step.event.x).metres(), kMostError_m);
    error->east_m = bounded(geo::Length::feet(step.event.y).metres(), kMostError_m);
  }
}

void put_drift(Step& step) {
  if (NavigatorError* error = error_named(step)) {
    error->velocity_north_mps = bounded(geo::Length::feet(step.event.x).metres(), kMostDrift_mps);
    error->velocity_east_mps = bounded(geo::Length::feet(step.event.y).metres(), kMostDrift_mps);
  }
}

void put_first_errors(RadarState& state, const radar::NavigationConfiguration& navigation) {
  state.mission = {navigation.error_north_m, navigation.error_east_m, navigation.drift_north_mps,
                   navigation.drift_east_mps, navigation.drift_down_mps};
  state.ins = state.mission;
}

void advance_navigators(RadarState& state, std::int64_t tick, const radar::RadarConfiguration& configuration) {
  if (configuration.navigation.walk_mps > 0.0 && tick % kTicksPerSecond == 0) {
    constexpr double kSecondsPerHour = 3600.0;
    const double step_mps = configuration.navigation.walk_mps / std::sqrt(kSecondsPerHour);
    // Draws of its own: the model makes its noise from the same seed.
    constexpr std::uint64_t kFirstDraw = 100;
    const auto walk = [&](double NavigatorError::*component, std::uint64_t draw) {
      const double by_mps =
          step_mps * radar::standard_normal(configuration.seed, static_cast<std::uint64_t>(tick), kFirstDraw + draw);
      for (NavigatorError* error : {&state.mission, &state.ins})
        error->*component = bounded(error->*component + by_mps, kMostDrift_mps);
    };
    walk(&NavigatorError::velocity_north_mps, 0);
    walk(&NavigatorError::velocity_east_mps, 1);
    walk(&NavigatorError::velocity_down_mps, 2);
  }
  drift(state.mission);
  drift(state.ins);
}

void put_variation(RadarState& state, const Surroundings& surroundings,
                   const radar::RadarConfiguration& configuration) {
  state.magnetic_variation_deg = configuration.magnetic_variation_deg;
  for (const double given_deg : {surroundings.field_variation_deg, surroundings.nav.magnetic_variation_deg})
    if (!std::isnan(given_deg)) state.magnetic_variation_deg = given_deg;
}

NavigatorError& error_in_use(RadarState& state) {
  return state.navigator == static_cast<std::uint8_t>(radar::Navigator::ins) ? state.ins : state.mission;
}

}  // namespace yars::statemachine
