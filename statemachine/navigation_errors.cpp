#include "statemachine/navigation_errors.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/messages/inspection.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/modes.hpp"
#include "lib/random/counter_rng.hpp"
#include "statemachine/cursor.hpp"

namespace yars::statemachine {

namespace {

using databuffer::NavigatorError;
using databuffer::RadarState;

constexpr std::int64_t kTicksPerSecond = 1'000'000'000 / radar::kTickNanoseconds;
// [m] and [m/s] where an error stops growing: a quarter round the Earth, and far above any aircraft's speed. The
// border, which holds the record to less, would refuse the whole state.
constexpr double kMaxError_m = 1e7;
constexpr double kMaxDrift_mps = 5e3;

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
  error.north_m = bounded(error.north_m + error.velocity_north_mps * radar::kTickSeconds, kMaxError_m);
  error.east_m = bounded(error.east_m + error.velocity_east_mps * radar::kTickSeconds, kMaxError_m);
}

}  // namespace

void put_position_error(Step& step) {
  if (NavigatorError* error = error_named(step)) {
    error->north_m = bounded(geo::Length::feet(step.event.x).metres(), kMaxError_m);
    error->east_m = bounded(geo::Length::feet(step.event.y).metres(), kMaxError_m);
  }
}

void put_drift(Step& step) {
  if (NavigatorError* error = error_named(step)) {
    error->velocity_north_mps = bounded(geo::Length::feet(step.event.x).metres(), kMaxDrift_mps);
    error->velocity_east_mps = bounded(geo::Length::feet(step.event.y).metres(), kMaxDrift_mps);
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
          step_mps * random::standard_normal(configuration.seed, static_cast<std::uint64_t>(tick), kFirstDraw + draw);
      for (NavigatorError* error : {&state.mission, &state.ins})
        error->*component = bounded(error->*component + by_mps, kMaxDrift_mps);
    };
    walk(&NavigatorError::velocity_north_mps, 0);
    walk(&NavigatorError::velocity_east_mps, 1);
    walk(&NavigatorError::velocity_down_mps, 2);
  }
  drift(state.mission);
  drift(state.ins);
}

void put_variation(RadarState& state, const Inputs& inputs, const radar::RadarConfiguration& configuration) {
  state.magnetic_variation_deg = configuration.magnetic_variation_deg;
  for (const double given_deg : {inputs.field_variation_deg, inputs.nav.magnetic_variation_deg})
    if (!std::isnan(given_deg)) state.magnetic_variation_deg = given_deg;
}

NavigatorError& error_in_use(RadarState& state) {
  return state.navigator == static_cast<std::uint8_t>(radar::Navigator::ins) ? state.ins : state.mission;
}

namespace {

using geo::GeoPoint;

// [m] on the ground.
struct Offset {
  double north_m = 0.0;
  double east_m = 0.0;
};

// From the selected point as the glass shows it to the cursor; nothing without one of them.
std::optional<Offset> offset_to_cursor(const RadarState& state, const Inputs& inputs,
                                       const radar::RadarConfiguration& configuration) {
  if (!has(state, databuffer::kCursorValid)) return std::nullopt;
  const auto point = selected_point(state, configuration);
  if (!point) return std::nullopt;
  const auto belief = databuffer::belief_in_use(inputs.ownship, inputs.nav, state);
  const auto line = geo::geodesic_inverse(belief.on_video(point->place), cursor_of(state));
  const double azimuth_rad = line.azimuth_at_start.radians();
  return Offset{line.distance.metres() * std::cos(azimuth_rad), line.distance.metres() * std::sin(azimuth_rad)};
}

// Where the navigator must believe to be for a place known to it to stand at `seen` on the video: the geodesic from
// there has the azimuth and the length of the one from the aircraft to `seen`. Followed backward from the place; the
// azimuth at the place is found by passes, for meridians are not parallel, least of all near a pole.
GeoPoint belief_that_shows(GeoPoint known, GeoPoint seen, GeoPoint truth) {
  constexpr int kPasses = 8;
  const auto wanted = geo::geodesic_inverse(truth, seen);
  geo::Bearing at_place = wanted.azimuth_at_end;
  GeoPoint belief = truth;
  for (int pass = 0; pass < kPasses; ++pass) {
    belief = geo::geodesic_direct(known, at_place + geo::Angle::degrees(180.0), wanted.distance);
    at_place = at_place + (wanted.azimuth_at_start - geo::geodesic_inverse(belief, known).azimuth_at_start);
  }
  return belief;
}

// Whole seconds; 0 = too old.
std::int32_t seconds_left(const RadarState& state, std::int64_t tick, double validity_s) {
  // Time may have been set back since.
  const double age_s =
      static_cast<double>(std::max<std::int64_t>(0, tick - state.cursor_moved_tick)) * radar::kTickSeconds;
  return static_cast<std::int32_t>(std::max(0.0, std::ceil(validity_s - age_s)));
}

}  // namespace

void accept_update(Step& step) {
  RadarState& state = step.state;
  if (!step.inputs.ownship_valid) return;
  // What stands in the state is of the tick before, and the cursor may have jumped since.
  RadarState present = state;
  advance_update(present, step.inputs, step.configuration);
  if (!has(present, databuffer::kUpdateShown) || has(present, databuffer::kUpdateInvalid)) return;
  const auto offset = offset_to_cursor(state, step.inputs, step.configuration);
  constexpr double kNothing_m = 1e-3;
  if (!offset || std::hypot(offset->north_m, offset->east_m) < kNothing_m) return;
  const auto point = selected_point(state, step.configuration);
  databuffer::NavigatorError& error = error_in_use(state);
  error.north_m = error.east_m = 0.0;
  const auto given = databuffer::belief_in_use(step.inputs.ownship, step.inputs.nav, state);
  const GeoPoint wanted = belief_that_shows(point->place, cursor_of(state), given.truth);
  const auto line = geo::geodesic_inverse(given.believed, wanted);
  error.north_m = line.distance.metres() * std::cos(line.azimuth_at_start.radians());
  error.east_m = line.distance.metres() * std::sin(line.azimuth_at_start.radians());
}

void advance_update(RadarState& state, const Inputs& inputs, const radar::RadarConfiguration& configuration) {
  const bool updating =
      state.cursor_function == static_cast<std::uint8_t>(radar::CursorFunction::update) && shows_cursor(state);
  const auto offset = updating ? offset_to_cursor(state, inputs, configuration) : std::nullopt;
  set_flag(state, databuffer::kUpdateShown, offset.has_value());
  state.update_north_m = offset ? offset->north_m : 0.0;
  state.update_east_m = offset ? offset->east_m : 0.0;
  const bool ages = offset && state.navigator == static_cast<std::uint8_t>(radar::Navigator::ins);
  state.update_seconds = ages ? seconds_left(state, inputs.tick, configuration.navigation.update_validity_s) : -1;
  set_flag(state, databuffer::kUpdateInvalid, state.update_seconds == 0);
}

namespace {

using databuffer::ModelStatus;

constexpr std::int64_t kShownTicks = 2'000;  // 10 s: three numbers to read, gone before the next update
// [m/s] A measurement further off than this is none: the border would refuse the state that took it up.
constexpr double kMaxDifference_mps = 2'000.0;

struct Difference {
  double north_mps = 0.0;
  double east_mps = 0.0;
  double down_mps = 0.0;
};

bool continuous(const RadarState& state) {
  return running_mode(state) == radar::Mode::pvu && power_of(state) == radar::Power::operate;
}

// Radar less navigator.
Difference difference(const RadarState& state, const Inputs& inputs) {
  const ModelStatus& model = inputs.model;
  const databuffer::Nav& nav = inputs.nav;
  return {model.velocity_north_mps - (nav.velocity_north_mps + state.mission.velocity_north_mps),
          model.velocity_east_mps - (nav.velocity_east_mps + state.mission.velocity_east_mps),
          model.velocity_down_mps - (nav.velocity_down_mps + state.mission.velocity_down_mps)};
}

// Neither the measurement nor what the navigator's error would be then; written so that NaN fails.
bool believable(const Difference& difference, const databuffer::NavigatorError& mission) {
  const auto small = [](double part_mps, double error_mps) {
    return std::abs(part_mps) <= kMaxDifference_mps && std::abs(error_mps + part_mps) <= databuffer::kLargestSpeed;
  };
  return small(difference.north_mps, mission.velocity_north_mps) &&
         small(difference.east_mps, mission.velocity_east_mps) && small(difference.down_mps, mission.velocity_down_mps);
}

void show(RadarState& state, const Difference& difference, const Inputs& inputs) {
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

void correct(databuffer::NavigatorError& mission, const Difference& difference) {
  mission.velocity_north_mps += difference.north_mps;
  mission.velocity_east_mps += difference.east_mps;
  mission.velocity_down_mps += difference.down_mps;
}

}  // namespace

void advance_velocity_update(RadarState& state, const Inputs& inputs, const radar::RadarConfiguration& configuration) {
  const bool measures = continuous(state) || has(state, databuffer::kIpvu);
  const bool outdated = !continuous(state) && inputs.tick >= state.velocity_shown_until_tick;
  if (!measures || outdated) set_flag(state, databuffer::kVelocityShown, false);
  if (inputs.model.velocity_count == state.velocity_taken) return;
  state.velocity_taken = inputs.model.velocity_count;
  const Difference measured = difference(state, inputs);
  if (!measures || !believable(measured, state.mission)) return;
  show(state, measured, inputs);
  // IPVU measures when an update is due, a scan's end earlier or later; PVU all the time.
  if (continuous(state) && !update_is_due(state, inputs.tick, configuration.navigation.velocity_period_s)) return;
  state.velocity_updated_tick = inputs.tick;
  correct(state.mission, measured);
}

}  // namespace yars::statemachine
