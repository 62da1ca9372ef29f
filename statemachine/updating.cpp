#include "statemachine/updating.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "databuffer/records/navigation.hpp"
#include "lib/geo/geodesic.hpp"
#include "statemachine/cursor.hpp"
#include "statemachine/navigators.hpp"
#include "statemachine/sequence_points.hpp"

namespace yars::statemachine {

namespace {

using databuffer::RadarState;
using geo::GeoPoint;

// [m] on the ground.
struct Offset {
  double north_m = 0.0;
  double east_m = 0.0;
};

GeoPoint cursor_of(const RadarState& state) {
  return {state.cursor_latitude_deg, state.cursor_longitude_deg};
}

// From the selected point as the glass shows it to the cursor; nothing without one of them.
std::optional<Offset> offset_to_cursor(const RadarState& state, const Surroundings& surroundings,
                                       const radar::RadarConfiguration& configuration) {
  if (!has(state, databuffer::kCursorValid)) return std::nullopt;
  const auto point = selected_point(state, configuration);
  if (!point) return std::nullopt;
  const auto belief = databuffer::belief_in_use(surroundings.ownship, surroundings.nav, state);
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
  if (!step.surroundings.ownship_valid) return;
  // What stands in the state is of the tick before, and the cursor may have jumped since.
  RadarState present = state;
  advance_update(present, step.surroundings, step.configuration);
  if (!has(present, databuffer::kUpdateShown) || has(present, databuffer::kUpdateInvalid)) return;
  const auto offset = offset_to_cursor(state, step.surroundings, step.configuration);
  constexpr double kNothing_m = 1e-3;
  if (!offset || std::hypot(offset->north_m, offset->east_m) < kNothing_m) return;
  const auto point = selected_point(state, step.configuration);
  databuffer::NavigatorError& error = error_in_use(state);
  error.north_m = error.east_m = 0.0;
  const auto given = databuffer::belief_in_use(step.surroundings.ownship, step.surroundings.nav, state);
  const GeoPoint wanted = belief_that_shows(point->place, cursor_of(state), given.truth);
  const auto line = geo::geodesic_inverse(given.believed, wanted);
  error.north_m = line.distance.metres() * std::cos(line.azimuth_at_start.radians());
  error.east_m = line.distance.metres() * std::sin(line.azimuth_at_start.radians());
}

void advance_update(RadarState& state, const Surroundings& surroundings,
                    const radar::RadarConfiguration& configuration) {
  const bool updating =
      state.cursor_function == static_cast<std::uint8_t>(radar::CursorFunction::update) && shows_cursor(state);
  const auto offset = updating ? offset_to_cursor(state, surroundings, configuration) : std::nullopt;
  set_flag(state, databuffer::kUpdateShown, offset.has_value());
  state.update_north_m = offset ? offset->north_m : 0.0;
  state.update_east_m = offset ? offset->east_m : 0.0;
  const bool ages = offset && state.navigator == static_cast<std::uint8_t>(radar::Navigator::ins);
  state.update_seconds = ages ? seconds_left(state, surroundings.tick, configuration.navigation.update_validity_s) : -1;
  set_flag(state, databuffer::kUpdateInvalid, state.update_seconds == 0);
}

}  // namespace yars::statemachine
