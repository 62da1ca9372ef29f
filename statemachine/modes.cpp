#include "statemachine/modes.hpp"

#include "lib/radar/ranges.hpp"
#include "statemachine/scanning.hpp"
#include "statemachine/sequence_points.hpp"

namespace yars::statemachine {

namespace {

using databuffer::RadarState;
using radar::Mode;

// The menu stays on the glass while the mode below it changes.
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

// A mode change by the pilot's hand also sets the range (rule 1).
void change_mode(Step& step, Mode mode) {
  if (mode == running_mode(step.state)) return;
  run_ground_mode(step.state, mode);
  set_range_by_height(step.state, step.surroundings, step.configuration);
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

// What no loss of power may take: whose session this is, and the counters that others compare.
RadarState forgotten(const Step& step) {
  RadarState fresh = power_up_settings(step.configuration);
  fresh.tick = step.state.tick;
  fresh.epoch = step.state.epoch;
  fresh.events_applied = step.state.events_applied;
  fresh.scan_restart = step.state.scan_restart;
  return fresh;
}

}  // namespace

RadarState power_up_settings(const radar::RadarConfiguration& configuration) {
  RadarState state{};
  state.gain = 3;
  state.brightness = 8;
  state.contrast = 8;
  state.channel = 1;
  set_range_index(state, radar::range_index_for(geo::Length::nautical_miles(40.0), configuration.ranges_nm),
                  configuration);
  set_scan_width(state, radar::ScanWidth::full, configuration);
  select_window(state, geo::Length::nautical_miles(4.7), configuration);
  select_first_sequence_point(state, configuration);
  state.scan_restart = 0;
  return state;
}

void switch_power(Step& step) {
  RadarState& state = step.state;
  const auto power = step.event.argument;
  if (power < 0 || power > static_cast<std::int16_t>(radar::Power::operate) || power == state.power) return;
  // Losing power forgets: what comes on again is as new.
  if (power == static_cast<std::int16_t>(radar::Power::off)) state = forgotten(step);
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
      return;  // no switch position
  }
}

void leave_patch(Step& step) {
  run_ground_mode(step.state, Mode::hrm);
}

void select_master(Step& step) {
  RadarState& state = step.state;
  const auto master = static_cast<radar::Master>(step.event.argument);
  if (master == master_of(state)) return;
  switch (master) {
    case radar::Master::air_to_ground:
      run(state, static_cast<Mode>(state.ground_mode));
      break;
    case radar::Master::air_to_air:
      run(state, Mode::air_to_air);
      break;
    case radar::Master::ranging:
      run(state, Mode::ranging);
      break;
    default:
      return;  // no switch position
  }
  state.master = static_cast<std::uint8_t>(master);
}

void open_menu(Step& step) {
  show_menu(step.state, true);
}
void close_menu(Step& step) {
  show_menu(step.state, false);
}

void toggle_freeze(Step& step) {
  step.state.flags ^= databuffer::kFreeze;
}

void freeze_silent_hrm(RadarState& state) {
  const Mode mode = running_mode(state);
  const bool silent = has(state, databuffer::kSniff) && (mode == Mode::hrm || mode == Mode::patch);
  if (silent) set_flag(state, databuffer::kFreeze, true);
}

}  // namespace yars::statemachine
