#include "statemachine/machine.hpp"

#include <algorithm>
#include <cstring>
#include <span>

#include "statemachine/cursor.hpp"
#include "statemachine/elevations.hpp"
#include "statemachine/freezing.hpp"
#include "statemachine/legends.hpp"
#include "statemachine/maps.hpp"
#include "statemachine/modes.hpp"
#include "statemachine/navigators.hpp"
#include "statemachine/scanning.hpp"
#include "statemachine/sequence_points.hpp"
#include "statemachine/steering.hpp"
#include "statemachine/switches.hpp"
#include "statemachine/transition_table.hpp"
#include "statemachine/updating.hpp"
#include "statemachine/velocity_update.hpp"

namespace yars::statemachine {

namespace {

using databuffer::RadarState;

// 0.1 s: the aircraft flies 50 m meanwhile, which decides nothing about which points are near; each tick would cost
// a geodesic for every point of the route.
constexpr std::int64_t kTicksBetweenPoints = 20;

// A jump in place or time leaves nothing for the cursor, the scan, a map under way and a message's end to stand on.
void enter_epoch(RadarState& state, const Surroundings& surroundings) {
  state.epoch = surroundings.epoch;
  cancel_map(state, surroundings);
  ++state.scan_restart;
  set_flag(state, databuffer::kCursorValid, false);
  state.message_until_tick = 0;
}

// Bytes, not values: NaN must equal itself, and whoever publishes compares bytes too.
bool same_bytes(const RadarState& a, const RadarState& b) {
  return std::ranges::equal(std::as_bytes(std::span(&a, 1)), std::as_bytes(std::span(&b, 1)));
}

void end_message(RadarState& state, std::int64_t tick) {
  if (state.message[0] == '\0' || state.message_until_tick == databuffer::kUntilCauseEnds) return;
  if (tick < state.message_until_tick) return;
  std::memset(state.message, 0, sizeof(state.message));
  state.message_until_tick = 0;
}

}  // namespace

RadarState initial_state(const radar::RadarConfiguration& configuration) {
  RadarState state = power_up_settings(configuration);
  put_first_errors(state, configuration.navigation);
  return state;
}

Effect apply(RadarState& state, const databuffer::InputEvent& event, const Surroundings& surroundings,
             const radar::RadarConfiguration& configuration) {
  const Action action = action_for(state, event);
  if (!action) return Effect::none;
  const RadarState before = state;
  Step step{state, event, surroundings, configuration};
  action(step);
  state.map_shown = map_to_show(state);
  if (step.refused) return Effect::refused;
  if (same_bytes(before, state)) return Effect::none;
  draw_points(state, surroundings, configuration);
  return Effect::done;
}

void advance(RadarState& state, const Surroundings& surroundings, const radar::RadarConfiguration& configuration) {
  bool points_due = surroundings.tick % kTicksBetweenPoints == 0;
  if (state.epoch != surroundings.epoch) {
    enter_epoch(state, surroundings);
    points_due = true;
  }
  take_elevation(state, surroundings);
  take_map(state, surroundings);
  state.map_shown = map_to_show(state);
  if (power_of(state) != radar::Power::off && surroundings.ownship_valid) {
    if (!has(state, databuffer::kRangeSet)) {
      set_range_by_height(state, surroundings, configuration);
      points_due = true;
    }
    put_variation(state, surroundings, configuration);
    advance_cursor(state, surroundings, configuration);
    advance_steering_line(state, surroundings);
    advance_update(state, surroundings, configuration);
    advance_velocity_update(state, surroundings, configuration);
  }
  advance_navigators(state, surroundings.tick, configuration);
  advance_recorder(state, surroundings);
  if (points_due) draw_points(state, surroundings, configuration);
  end_message(state, surroundings.tick);
  tell_why_map_stopped(state, surroundings);
  ask_for_cursor(state);
  write_legends(state);
}

}  // namespace yars::statemachine
