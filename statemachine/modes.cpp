#include "statemachine/modes.hpp"

#include <algorithm>
#include <optional>

#include "lib/radar/mapping.hpp"
#include "lib/radar/mission.hpp"
#include "statemachine/cursor.hpp"
#include "statemachine/maps.hpp"
#include "statemachine/settings.hpp"

namespace yars::statemachine {

namespace {

using databuffer::RadarState;
using radar::Mode;

const geo::Length kUnknownHeight = geo::Length::feet(kUnknown);

// Starts a mode. An open main menu stays on the display.
void run(RadarState& state, Mode mode) {
  state.resume_mode = static_cast<std::uint8_t>(mode);
  state.mode = static_cast<std::uint8_t>(has(state, databuffer::kMenu) ? Mode::menu : mode);
  ++state.scan_restart;
  freeze_silent_hrm(state);
}

void run_ground_mode(RadarState& state, Mode mode) {
  state.ground_mode = static_cast<std::uint8_t>(mode);
  run(state, mode);
}

void show_menu(RadarState& state, bool on) {
  set_flag(state, databuffer::kMenu, on);
  state.mode = on ? static_cast<std::uint8_t>(Mode::menu) : state.resume_mode;
}

// Mode change by the pilot: also sets the range by the aircraft's height (docs/pilots_manual.md#rule-1).
void change_mode(Step& step, Mode mode) {
  if (mode == running_mode(step.state)) return;
  cancel_map(step.state, step.inputs);
  run_ground_mode(step.state, mode);
  set_range_by_height(step.state, step.inputs, step.parameters);
}

Mode mode_after(Mode mode) {
  switch (mode) {
    case Mode::rbm:
      return Mode::hrm;
    case Mode::hrm:
    case Mode::patch:
      return Mode::beacon;
    case Mode::beacon:
      return Mode::pvu;
    default:
      return Mode::rbm;
  }
}

// Radar mode that a master mode runs; nullopt for an invalid argument.
std::optional<Mode> mode_of(radar::Master master, const RadarState& state) {
  switch (master) {
    case radar::Master::air_to_ground:
      return static_cast<Mode>(state.ground_mode);
    case radar::Master::air_to_air:
      return Mode::air_to_air;
    case radar::Master::ranging:
      return Mode::ranging;
  }
  return std::nullopt;
}

// State after power off: power-up settings. Ticks, counters, cues, marks and navigator errors keep their values.
RadarState state_after_power_off(const Step& step) {
  RadarState fresh = power_up_settings(step.parameters);
  fresh.tick = step.state.tick;
  fresh.epoch = step.state.epoch;
  fresh.events_applied = step.state.events_applied;
  fresh.scan_restart = step.state.scan_restart;
  fresh.map_request = step.state.map_request;
  fresh.vtr_request = step.state.vtr_request;
  // Cues already published stay published.
  fresh.cue_count = step.state.cue_count;
  fresh.cue_latitude_deg = step.state.cue_latitude_deg;
  fresh.cue_longitude_deg = step.state.cue_longitude_deg;
  fresh.cue_elevation_m = step.state.cue_elevation_m;
  fresh.target_count = step.state.target_count;
  // Navigators and marks do not depend on radar power (docs/pilots_manual.md#rule-18).
  fresh.mission = step.state.mission;
  fresh.ins = step.state.ins;
  fresh.asked_latitude_deg = step.state.asked_latitude_deg;
  fresh.asked_longitude_deg = step.state.asked_longitude_deg;
  fresh.asked_tick = step.state.asked_tick;
  fresh.asked_for = step.state.asked_for & ~databuffer::kAskedForTarget;
  fresh.mark_count = step.state.mark_count;
  std::ranges::copy(step.state.marks, fresh.marks);
  fresh.velocity_taken = step.state.velocity_taken;
  return fresh;
}

}  // namespace

RadarState power_up_settings(const Parameters& parameters) {
  RadarState state{};
  state.gain = 3;
  state.brightness = 8;
  state.contrast = 8;
  state.channel = 1;
  state.update_seconds = -1;
  state.velocity_updated_tick = -1;
  // Until the height is known, the range for large heights applies.
  const geo::Length high = radar::range_by_height(kUnknownHeight, parameters.height_ranges);
  set_range_index(state, radar::range_index_for(high, parameters.ranges_nm), parameters);
  set_scan_width(state, radar::ScanWidth::full, parameters);
  select_window(state, geo::Length::nautical_miles(parameters.window_limits.power_up_nm), parameters);
  const double limit_deg = parameters.elevation_limit_deg;
  state.antenna_elevation_deg = std::clamp(parameters.start_elevation_deg, -limit_deg, limit_deg);
  select_first_sequence_point(state, parameters);
  state.scan_restart = 0;
  return state;
}

void switch_power(Step& step) {
  RadarState& state = step.state;
  const auto power = step.event.argument;
  if (power < 0 || power > static_cast<std::int16_t>(radar::Power::operate) || power == state.power) return;
  cancel_map(state, step.inputs);
  if (power == static_cast<std::int16_t>(radar::Power::off)) state = state_after_power_off(step);
  state.power = static_cast<std::uint8_t>(power);
  ++state.scan_restart;
}

void next_mode(Step& step) {
  change_mode(step, mode_after(running_mode(step.state)));
}

void select_mode(Step& step) {
  switch (const auto wanted = static_cast<Mode>(step.event.argument)) {
    case Mode::rbm:
    case Mode::hrm:
    case Mode::beacon:
    case Mode::pvu:
      return change_mode(step, wanted);
    default:
      return;  // the control has no position for other modes
  }
}

void leave_patch(Step& step) {
  cancel_map(step.state, step.inputs);
  run_ground_mode(step.state, Mode::hrm);
}

void select_master(Step& step) {
  RadarState& state = step.state;
  const auto master = static_cast<radar::Master>(step.event.argument);
  const std::optional<Mode> mode = mode_of(master, state);
  if (!mode || master == master_of(state)) return;
  cancel_map(state, step.inputs);
  if (master == radar::Master::air_to_ground) {
    thaw_on_return(state);
  } else {
    freeze_on_leaving(state);
  }
  run(state, *mode);
  state.master = static_cast<std::uint8_t>(master);
}

void open_menu(Step& step) {
  show_menu(step.state, true);
}
void close_menu(Step& step) {
  show_menu(step.state, false);
}

void enter_patch(RadarState& state) {
  run_ground_mode(state, Mode::patch);
}

}  // namespace yars::statemachine
