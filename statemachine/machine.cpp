#include "statemachine/machine.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "databuffer/messages/derived_values.hpp"
#include "lib/geo/frames.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/radar/mission.hpp"
#include "statemachine/cursor.hpp"
#include "statemachine/designation.hpp"
#include "statemachine/maps.hpp"
#include "statemachine/navigation_errors.hpp"
#include "statemachine/settings.hpp"
#include "statemachine/transition_table.hpp"

namespace yars::statemachine {

namespace {

using databuffer::Outputs;
using databuffer::RadarState;

// Slant range, true bearing, and depression (below the horizontal, positive down) of the target. They are measured
// from the true position of the aircraft to the ground position at which the video shows the target. A target whose
// elevation stayed unknown is taken to be at sea level. Mean sea level counts as the ellipsoid (docs/conventions.md).
void put_ranging(Outputs& outputs, const RadarState& state, const Inputs& inputs) {
  const databuffer::Ownship& ownship = inputs.ownship;
  const auto navigator = databuffer::selected_navigator_position(ownship, inputs.nav, state);
  const double ground_m = std::isnan(state.target_elevation_m) ? 0.0 : state.target_elevation_m;
  using geo::HeightAboveEllipsoid;
  const geo::LocalTangentFrame frame(navigator.truth, HeightAboveEllipsoid::metres(ownship.altitude_msl_m));
  const auto sight =
      frame.enu_from_geodetic(navigator.on_video({state.target_latitude_deg, state.target_longitude_deg}),
                              HeightAboveEllipsoid::metres(ground_m));
  const double horizontal_m = std::hypot(sight.x, sight.y);
  outputs.slant_range_m = std::hypot(horizontal_m, sight.z);
  outputs.bearing_deg = geo::Bearing::radians(std::atan2(sight.x, sight.y)).degrees();
  outputs.depression_deg = std::atan2(-sight.z, horizontal_m) / geo::kRadiansPerDegree;
}

}  // namespace

Outputs outputs_of(const RadarState& state, const Inputs& inputs) {
  Outputs outputs{};
  outputs.tick = inputs.tick;
  outputs.sim_time_ns = inputs.sim_time_ns;
  outputs.epoch = inputs.epoch;
  outputs.cue_count = state.cue_count;
  outputs.cue_latitude_deg = state.cue_latitude_deg;
  outputs.cue_longitude_deg = state.cue_longitude_deg;
  outputs.cue_elevation_m = state.cue_elevation_m;
  outputs.target_count = state.target_count;
  outputs.mark_count = state.mark_count;
  std::ranges::copy(state.marks, outputs.marks);
  outputs.slant_range_m = outputs.bearing_deg = outputs.depression_deg = kUnknown;
  outputs.steering_deg = outputs.approach_deg = kUnknown;
  if (!has(state, databuffer::kTargetDesignated)) return outputs;
  outputs.target_latitude_deg = state.target_latitude_deg;
  outputs.target_longitude_deg = state.target_longitude_deg;
  outputs.target_elevation_m = state.target_elevation_m;
  std::ranges::copy(state.target_name, outputs.target_name);
  if (!inputs.ownship_valid) return outputs;
  put_steering(outputs, state, inputs);
  // Until the radar model has answered, the elevation is unknown. Ranging would use sea level instead and be wrong.
  if ((state.asked_for & databuffer::kAskedForTarget) != 0) return outputs;
  put_ranging(outputs, state, inputs);
  return outputs;
}

namespace {

// Without changes, draw_points is called every 20 ticks, 0.1 s. At 500 m/s the aircraft flies 50 m in that time, which
// hardly changes the nearest points. Each call computes a geodesic for every point of the route.
constexpr std::int64_t kTicksBetweenPoints = 20;

// Begins an epoch (after a jump in position or time): cancels a commanded map, restarts the scan, removes cursor and
// message.
void enter_epoch(RadarState& state, const Inputs& inputs) {
  state.epoch = inputs.epoch;
  cancel_map(state, inputs);
  ++state.scan_restart;
  set_flag(state, databuffer::kCursorValid, false);
  state.message_until_tick = 0;
}

void end_message(RadarState& state, std::int64_t tick) {
  if (state.message[0] == '\0' || state.message_until_tick == databuffer::kUntilCauseEnds) return;
  if (tick < state.message_until_tick) return;
  std::memset(state.message, 0, sizeof(state.message));
  state.message_until_tick = 0;
}

}  // namespace

RadarState initial_state(const Parameters& parameters) {
  RadarState state = power_up_settings(parameters);
  put_initial_errors(state, parameters.navigation);
  return state;
}

Effect apply(RadarState& state, const databuffer::InputEvent& event, const Inputs& inputs,
             const Parameters& parameters) {
  if (is_for_tour(event)) return Effect::done;
  const Action action = action_for(state, event);
  if (!action) return Effect::none;
  if (is_press(event)) return Effect::done;
  const RadarState before = state;
  Step step{state, event, inputs, parameters};
  action(step);
  state.map_shown = map_to_show(state);
  if (step.refused) return Effect::refused;
  if (same_bytes(before, state)) return Effect::none;
  draw_points(state, inputs, parameters);
  return Effect::done;
}

void change_route(RadarState& state, std::span<const radar::RoutePoint> before, const Inputs& inputs,
                  const Parameters& parameters) {
  move_target_with_route(state, before, parameters);
  if (!selected_point(state, parameters)) select_first_sequence_point(state, parameters);
  draw_points(state, inputs, parameters);
}

void advance(RadarState& state, const Inputs& inputs, const Parameters& parameters) {
  bool points_due = inputs.tick % kTicksBetweenPoints == 0;
  if (state.epoch != inputs.epoch) {
    enter_epoch(state, inputs);
    points_due = true;
  }
  take_elevation(state, inputs);
  if (take_map(state, inputs)) enter_patch(state);
  state.map_shown = map_to_show(state);
  if (power_of(state) != radar::Power::off && inputs.ownship_valid) {
    if (!has(state, databuffer::kRangeSet)) {
      set_range_by_height(state, inputs, parameters);
      points_due = true;
    }
    put_variation(state, inputs, parameters);
    advance_cursor(state, inputs, parameters);
    advance_steering_line(state, inputs);
    advance_update(state, inputs, parameters);
    advance_velocity_update(state, inputs, parameters);
  }
  advance_navigators(state, inputs.tick, parameters);
  advance_recorder(state, inputs);
  if (points_due) draw_points(state, inputs, parameters);
  end_message(state, inputs.tick);
  show_remap_stop(state, inputs);
  request_cursor_elevation(state);
  write_legends(state);
}

}  // namespace yars::statemachine
