#include "statemachine/navigation_errors.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/messages/inspection.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/modes.hpp"
#include "lib/random/counter_rng.hpp"
#include "statemachine/cursor.hpp"

namespace yars::statemachine {

namespace {

using databuffer::NavigatorError;
using databuffer::RadarState;

constexpr std::int64_t kTicksPerSecond = 1'000'000'000 / radar::kTickNanoseconds;
// Limits of the position error (a quarter of the Earth's circumference) and of the drift (far above any aircraft's
// speed). Without them an error could exceed the limits of validate(), and the entire state would be invalid.
constexpr double kMaxError_m = 1e7;
constexpr double kMaxDrift_mps = 5e3;

double limited(double value, double limit) {
  return std::clamp(value, -limit, limit);
}

// Error of the navigator that the event names; nullptr for an unknown navigator or a value that is not finite.
NavigatorError* error_named(const Step& step) {
  if (!std::isfinite(step.event.x) || !std::isfinite(step.event.y)) return nullptr;
  if (step.event.argument == static_cast<std::int16_t>(radar::Navigator::mission)) return &step.state.mission;
  if (step.event.argument == static_cast<std::int16_t>(radar::Navigator::ins)) return &step.state.ins;
  return nullptr;
}

void integrate_drift(NavigatorError& error) {
  error.north_m = limited(error.north_m + error.velocity_north_mps * radar::kTickSeconds, kMaxError_m);
  error.east_m = limited(error.east_m + error.velocity_east_mps * radar::kTickSeconds, kMaxError_m);
}

}  // namespace

void put_position_error(Step& step) {
  if (NavigatorError* error = error_named(step)) {
    error->north_m = limited(geo::Length::feet(step.event.x).metres(), kMaxError_m);
    error->east_m = limited(geo::Length::feet(step.event.y).metres(), kMaxError_m);
  }
}

void put_drift(Step& step) {
  if (NavigatorError* error = error_named(step)) {
    error->velocity_north_mps = limited(geo::Length::feet(step.event.x).metres(), kMaxDrift_mps);
    error->velocity_east_mps = limited(geo::Length::feet(step.event.y).metres(), kMaxDrift_mps);
  }
}

void put_initial_errors(RadarState& state, const radar::NavigationConfiguration& navigation) {
  state.mission = {navigation.error_north_m, navigation.error_east_m, navigation.drift_north_mps,
                   navigation.drift_east_mps, navigation.drift_down_mps};
  state.ins = state.mission;
}

void advance_navigators(RadarState& state, std::int64_t tick, const Parameters& parameters) {
  if (parameters.navigation.walk_mps > 0.0 && tick % kTicksPerSecond == 0) {
    constexpr double kSecondsPerHour = 3600.0;
    // Standard deviation of one step. The variances of 3600 independent steps add up to walk_mps^2.
    const double step_mps = parameters.navigation.walk_mps / std::sqrt(kSecondsPerHour);
    // Draw numbers below 100 belong to the velocity measurement of the radar model, which uses the same seed.
    constexpr std::uint64_t kFirstDraw = 100;
    const auto walk = [&](double NavigatorError::* component, std::uint64_t draw) {
      const double by_mps =
          step_mps * random::standard_normal(parameters.seed, static_cast<std::uint64_t>(tick), kFirstDraw + draw);
      for (NavigatorError* error : {&state.mission, &state.ins})
        error->*component = limited(error->*component + by_mps, kMaxDrift_mps);
    };
    walk(&NavigatorError::velocity_north_mps, 0);
    walk(&NavigatorError::velocity_east_mps, 1);
    walk(&NavigatorError::velocity_down_mps, 2);
  }
  integrate_drift(state.mission);
  integrate_drift(state.ins);
}

void put_variation(RadarState& state, const Inputs& inputs, const Parameters& parameters) {
  double variation_deg = parameters.magnetic_variation_deg;
  for (const double given_deg : {inputs.field_variation_deg, inputs.nav.magnetic_variation_deg})
    if (!std::isnan(given_deg)) variation_deg = given_deg;
  const bool known = !std::isnan(variation_deg);
  state.magnetic_variation_deg = known ? variation_deg : 0.0;
  set_flag(state, databuffer::kVariationKnown, known);
}

NavigatorError& error_in_use(RadarState& state) {
  return state.navigator == static_cast<std::uint8_t>(radar::Navigator::ins) ? state.ins : state.mission;
}

namespace {

using geo::GeoPoint;

struct Offset {
  double north_m = 0.0;
  double east_m = 0.0;
};

// Offset from the displayed position of the selected point to the cursor; nullopt without a point or a cursor.
std::optional<Offset> offset_to_cursor(const RadarState& state, const Inputs& inputs, const Parameters& parameters) {
  if (!has(state, databuffer::kCursorValid)) return std::nullopt;
  const auto point = selected_point(state, parameters);
  if (!point) return std::nullopt;
  const auto navigator = databuffer::selected_navigator_position(inputs.ownship, inputs.nav, state);
  const auto line = geo::geodesic_inverse(navigator.on_video(point->position), cursor_of(state));
  const double azimuth_rad = line.azimuth_at_start.radians();
  return Offset{line.distance.metres() * std::cos(azimuth_rad), line.distance.metres() * std::sin(azimuth_rad)};
}

// Navigator position for which the point `known` is displayed at the video position `seen`. The geodesic from the
// result to `known` has the initial azimuth and length of the geodesic from the aircraft (`truth`) to `seen`. The
// result is computed backward from `known`. The azimuth of the geodesic at `known` is iterated, because meridians
// converge near a pole.
GeoPoint position_for_display_at(GeoPoint known, GeoPoint seen, GeoPoint truth) {
  constexpr int kPasses = 8;
  const auto wanted = geo::geodesic_inverse(truth, seen);
  geo::Bearing at_known = wanted.azimuth_at_end;
  GeoPoint position = truth;
  for (int pass = 0; pass < kPasses; ++pass) {
    position = geo::geodesic_direct(known, at_known + geo::Angle::degrees(180.0), wanted.distance);
    at_known = at_known + (wanted.azimuth_at_start - geo::geodesic_inverse(position, known).azimuth_at_start);
  }
  return position;
}

// Whole seconds for which the cursor position stays valid for an INS update; 0 = too old.
std::int32_t seconds_left(const RadarState& state, std::int64_t tick, double validity_s) {
  // A negative age counts as 0: the time may have been set back.
  const double age_s =
      static_cast<double>(std::max<std::int64_t>(0, tick - state.cursor_moved_tick)) * radar::kTickSeconds;
  return static_cast<std::int32_t>(std::max(0.0, std::ceil(validity_s - age_s)));
}

}  // namespace

void accept_update(Step& step) {
  RadarState& state = step.state;
  if (refuses_without_cursor(step)) return;
  // The update fields of `state` are from the last tick. The cursor may have jumped since then.
  RadarState present = state;
  advance_update(present, step.inputs, step.parameters);
  if (!has(present, databuffer::kUpdateShown) || has(present, databuffer::kUpdateInvalid)) return;
  const auto offset = offset_to_cursor(state, step.inputs, step.parameters);
  constexpr double kNegligible_m = 1e-3;
  if (!offset || std::hypot(offset->north_m, offset->east_m) < kNegligible_m) return;
  const auto point = selected_point(state, step.parameters);
  databuffer::NavigatorError& error = error_in_use(state);
  error.north_m = error.east_m = 0.0;
  const auto without_error = databuffer::selected_navigator_position(step.inputs.ownship, step.inputs.nav, state);
  const GeoPoint wanted = position_for_display_at(point->position, cursor_of(state), without_error.truth);
  const auto line = geo::geodesic_inverse(without_error.estimated, wanted);
  error.north_m = line.distance.metres() * std::cos(line.azimuth_at_start.radians());
  error.east_m = line.distance.metres() * std::sin(line.azimuth_at_start.radians());
}

void advance_update(RadarState& state, const Inputs& inputs, const Parameters& parameters) {
  const bool updating =
      state.cursor_function == static_cast<std::uint8_t>(radar::CursorFunction::update) && shows_cursor(state);
  const auto offset = updating ? offset_to_cursor(state, inputs, parameters) : std::nullopt;
  set_flag(state, databuffer::kUpdateShown, offset.has_value());
  state.update_north_m = offset ? offset->north_m : 0.0;
  state.update_east_m = offset ? offset->east_m : 0.0;
  const bool ages = offset && state.navigator == static_cast<std::uint8_t>(radar::Navigator::ins);
  state.update_seconds = ages ? seconds_left(state, inputs.tick, parameters.navigation.update_validity_s) : -1;
  set_flag(state, databuffer::kUpdateInvalid, state.update_seconds == 0);
}

namespace {

using databuffer::ModelStatus;

constexpr std::int64_t kShownTicks = 2'000;  // 10 s: docs/pilots_manual.md#rule-16
// Larger differences are not valid measurements. They could take the state beyond the limits of validate().
constexpr double kMaxDifference_mps = 2'000.0;

struct Difference {
  double north_mps = 0.0;
  double east_mps = 0.0;
  double down_mps = 0.0;
};

bool continuous(const RadarState& state) {
  return running_mode(state) == radar::Mode::pvu && power_of(state) == radar::Power::operate;
}

// Velocity measured by the radar minus velocity of the mission navigator.
Difference difference(const RadarState& state, const Inputs& inputs) {
  const ModelStatus& model = inputs.model;
  const databuffer::Nav& nav = inputs.nav;
  return {model.velocity_north_mps - (nav.velocity_north_mps + state.mission.velocity_north_mps),
          model.velocity_east_mps - (nav.velocity_east_mps + state.mission.velocity_east_mps),
          model.velocity_down_mps - (nav.velocity_down_mps + state.mission.velocity_down_mps)};
}

// True if the difference, and the navigator error after correction by it, are within their limits. False for NaN.
bool is_plausible(const Difference& difference, const databuffer::NavigatorError& mission) {
  const auto small = [](double component_mps, double error_mps) {
    return std::abs(component_mps) <= kMaxDifference_mps &&
           std::abs(error_mps + component_mps) <= databuffer::kMaxSpeed_mps;
  };
  return small(difference.north_mps, mission.velocity_north_mps) &&
         small(difference.east_mps, mission.velocity_east_mps) && small(difference.down_mps, mission.velocity_down_mps);
}

void put_differences(RadarState& state, const Difference& difference, const Inputs& inputs) {
  const double track_rad = databuffer::ground_track_of(inputs.ownship).radians();
  state.velocity_along_mps = difference.north_mps * std::cos(track_rad) + difference.east_mps * std::sin(track_rad);
  state.velocity_across_mps = difference.east_mps * std::cos(track_rad) - difference.north_mps * std::sin(track_rad);
  state.velocity_vertical_mps = -difference.down_mps;
  state.velocity_shown_until_tick = inputs.tick + kShownTicks;
  set_flag(state, databuffer::kVelocityShown, true);
}

bool update_is_due(const RadarState& state, std::int64_t tick, double period_s) {
  if (state.velocity_updated_tick < 0 || tick < state.velocity_updated_tick) return true;
  return static_cast<double>(tick - state.velocity_updated_tick) * radar::kTickSeconds >= period_s;
}

// Tick that counts as the time of a correction in `tick`. PVU corrects with the first measurement after a whole period.
// The next period begins where the last one ended, so that corrections follow each other by the period on average.
std::int64_t tick_of_update(const RadarState& state, std::int64_t tick, double period_s) {
  if (!continuous(state) || state.velocity_updated_tick < 0 || tick < state.velocity_updated_tick) return tick;
  const auto period = static_cast<std::int64_t>(std::llround(period_s / radar::kTickSeconds));
  const std::int64_t end = state.velocity_updated_tick + period;
  return period > 0 && tick < end + period ? end : tick;
}

void correct(databuffer::NavigatorError& mission, const Difference& difference) {
  mission.velocity_north_mps += difference.north_mps;
  mission.velocity_east_mps += difference.east_mps;
  mission.velocity_down_mps += difference.down_mps;
}

}  // namespace

void advance_velocity_update(RadarState& state, const Inputs& inputs, const Parameters& parameters) {
  const bool measures = continuous(state) || has(state, databuffer::kIpvu);
  const bool expired = !continuous(state) && inputs.tick >= state.velocity_shown_until_tick;
  if (!measures || expired) set_flag(state, databuffer::kVelocityShown, false);
  if (inputs.model.velocity_count == state.velocity_taken) return;
  state.velocity_taken = inputs.model.velocity_count;
  const Difference measured = difference(state, inputs);
  if (!measures || !is_plausible(measured, state.mission)) return;
  put_differences(state, measured, inputs);
  // IPVU measures only when an update is due, at the end of a scan. PVU measures continuously.
  if (continuous(state) && !update_is_due(state, inputs.tick, parameters.navigation.velocity_period_s)) return;
  state.velocity_updated_tick = tick_of_update(state, inputs.tick, parameters.navigation.velocity_period_s);
  correct(state.mission, measured);
}

}  // namespace yars::statemachine
