#include "statemachine/settings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/world.hpp"
#include "statemachine/cursor.hpp"
#include "statemachine/maps.hpp"
#include "statemachine/remedies.hpp"

namespace yars::statemachine {

namespace {

using databuffer::RadarState;
using geo::Length;

constexpr std::uint8_t kBlankIndex = 255;   // value of window_index while no window is selected
constexpr double kElevationStep_deg = 0.5;  // docs/pilots_manual.md#elevation: the keys [ and ]

void choose_range(Step& step, std::size_t index) {
  set_flag(step.state, databuffer::kRangeSet, true);
  set_range_index(step.state, index, step.parameters);
}

void put_window(RadarState& state, std::optional<std::size_t> index, const Parameters& parameters) {
  state.window_index = index ? static_cast<std::uint8_t>(*index) : kBlankIndex;
  state.window_nm = index ? parameters.windows_nm[*index] : 0.0;
}

void put_elevation(Step& step, double elevation_deg) {
  if (!std::isfinite(elevation_deg)) return;
  const double limit_deg = step.parameters.elevation_limit_deg;
  step.state.antenna_elevation_deg = std::clamp(elevation_deg, -limit_deg, limit_deg);
}

// Elevation [m MSL] of the route point nearest to the aircraft; nullopt if there is no point or the nearest one's
// elevation is unknown.
std::optional<double> nearest_point_elevation_m(const databuffer::Ownship& ownship, const Parameters& parameters) {
  const geo::GeoPoint aircraft{ownship.latitude_deg, ownship.longitude_deg};
  const radar::RoutePoint* nearest = nullptr;
  Length nearest_distance;
  for (const radar::RoutePoint& point : parameters.route) {
    const Length distance = geo::geodesic_inverse(aircraft, point.position).distance;
    if (nearest && distance >= nearest_distance) continue;
    nearest = &point;
    nearest_distance = distance;
  }
  if (!nearest || std::isnan(nearest->elevation_m)) return std::nullopt;
  return nearest->elevation_m;
}

// Reading that a radar altimeter would have, from the radar model's height above ground. NaN if this height is unknown
// or above the altimeter's limit.
double terrain_clearance_m(const Inputs& inputs) {
  constexpr double kAltimeterLimit_m = 1524.0;  // 5,000 ft: docs/pilots_manual.md#rule-1
  return inputs.height_above_ground_m <= kAltimeterLimit_m ? inputs.height_above_ground_m : kUnknown;
}

// Height that selects the range: above the ground by the radar altimeter, else above the nearest route point, else MSL.
// Source: docs/pilots_manual.md#rule-1.
Length height_for_range(const RadarState& state, const Inputs& inputs, const Parameters& parameters) {
  const databuffer::Ownship& ownship = inputs.ownship;
  const double radar_altitude_m =
      std::isnan(ownship.radar_altitude_m) ? terrain_clearance_m(inputs) : ownship.radar_altitude_m;
  const bool altimeter = !has(state, databuffer::kAltimeterFailed) && !std::isnan(radar_altitude_m);
  if (altimeter) return Length::metres(radar_altitude_m);
  const double ground_m = nearest_point_elevation_m(ownship, parameters).value_or(0.0);
  return Length::metres(ownship.altitude_msl_m - ground_m);
}

}  // namespace

void range_up(Step& step) {
  const std::size_t next = step.state.range_index + std::size_t{1};
  if (next < step.parameters.ranges_nm.size()) choose_range(step, next);
}

void range_down(Step& step) {
  if (step.state.range_index > 0) choose_range(step, step.state.range_index - std::size_t{1});
}

void next_scan_width(Step& step) {
  constexpr std::size_t kNamedWidths = 3;
  const std::size_t widths = std::min(step.parameters.scan_widths_deg.size(), kNamedWidths);
  set_scan_width(step.state, static_cast<radar::ScanWidth>((step.state.scan + 1U) % widths), step.parameters);
}

void step_window(Step& step) {
  const bool blank = step.state.window_index == kBlankIndex;
  const int present = blank ? -1 : step.state.window_index;
  const int wanted = std::max(-1, present + std::clamp<int>(step.event.argument, -1, 1));
  if (wanted < 0) {
    if (!blank) show_message(step.state, step.inputs, kBlankWindow);
    return put_window(step.state, std::nullopt, step.parameters);
  }
  const auto largest =
      radar::largest_window_that_fits(Length::nautical_miles(step.state.range_nm), step.parameters.windows_nm);
  if (largest) put_window(step.state, std::min(static_cast<std::size_t>(wanted), *largest), step.parameters);
}

void set_elevation(Step& step) {
  put_elevation(step, step.event.x);
}

void step_elevation(Step& step) {
  put_elevation(step, step.state.antenna_elevation_deg + kElevationStep_deg * step.event.argument);
}

void set_range_index(RadarState& state, std::size_t index, const Parameters& parameters) {
  // The state may be from an earlier run with more ranges. Its index may then exceed ranges_nm.
  index = std::min(index, parameters.ranges_nm.size() - 1);
  const double range_nm = parameters.ranges_nm[index];
  if (range_nm != state.range_nm) ++state.scan_restart;
  state.range_index = static_cast<std::uint8_t>(index);
  state.range_nm = range_nm;
  if (state.window_nm > range_nm) select_window(state, Length::nautical_miles(range_nm), parameters);
}

void set_scan_width(RadarState& state, radar::ScanWidth scan, const Parameters& parameters) {
  state.scan = static_cast<std::uint8_t>(scan);
  state.scan_width_deg = parameters.scan_widths_deg[state.scan];
  ++state.scan_restart;
}

void select_window(RadarState& state, Length window, const Parameters& parameters) {
  const Length limit = std::min(window, Length::nautical_miles(state.range_nm));
  put_window(state, radar::largest_window_that_fits(limit, parameters.windows_nm), parameters);
}

void set_range_by_height(RadarState& state, const Inputs& inputs, const Parameters& parameters) {
  if (!inputs.ownship_valid) return;
  const Length height = height_for_range(state, inputs, parameters);
  set_range_index(
      state, radar::range_index_for(radar::range_by_height(height, parameters.height_ranges), parameters.ranges_nm),
      parameters);
  set_flag(state, databuffer::kRangeSet, true);
}

namespace {

constexpr int kMaxLevel = 15;  // maximum of brightness and contrast; the display assumes this value
constexpr std::uint8_t kMaxGain = 3;
constexpr std::uint8_t kBands = 5;

void toggle(Step& step, std::uint32_t flag) {
  step.state.flags ^= flag;
}

void step_level(std::uint8_t& level, int by) {
  level = static_cast<std::uint8_t>(std::clamp(level + by, 0, kMaxLevel));
}

}  // namespace

void toggle_declutter(Step& step) {
  toggle(step, databuffer::kDeclutter);
}
void toggle_looks(Step& step) {
  toggle(step, databuffer::kMultiLook2);
}
void toggle_stabilizing(Step& step) {
  toggle(step, databuffer::kProgressive);
}
void toggle_ipvu(Step& step) {
  toggle(step, databuffer::kIpvu);
}

void cycle_gain(Step& step) {
  std::uint8_t& gain = step.state.gain;
  gain = gain == 0 ? kMaxGain : static_cast<std::uint8_t>(gain - 1);
}

void brightness_up(Step& step) {
  step_level(step.state.brightness, 1);
}
void brightness_down(Step& step) {
  step_level(step.state.brightness, -1);
}
void step_contrast(Step& step) {
  step_level(step.state.contrast, std::clamp<int>(step.event.argument, -1, 1));
}

std::string_view recorder_problem(bool recorder_present) {
  return recorder_present ? "VTR FULL" : "NO RECORDER";
}

void toggle_recorder(Step& step) {
  if (!step.inputs.recorder_present || step.inputs.recorder_failed)
    return refuse(step, recorder_problem(step.inputs.recorder_present));
  ++step.state.vtr_request;
}

// The box around the legend VTR shows whether the recorder writes, not whether the pilot requested it.
void advance_recorder(databuffer::RadarState& state, const Inputs& inputs) {
  const bool was_writing = has(state, databuffer::kVtr);
  set_flag(state, databuffer::kVtr, inputs.recorder_present && inputs.recorder_writing);
  if (was_writing && inputs.recorder_present && inputs.recorder_failed)
    show_message(state, inputs, recorder_problem(true));
}

void toggle_sniff(Step& step) {
  toggle(step, databuffer::kSniff);
  // With SNIFF on, HRM stops the transmitter at once. A map in progress needs the transmitter and is cancelled.
  if (has(step.state, databuffer::kSniff)) cancel_map(step.state, step.inputs);
  freeze_silent_hrm(step.state);
}

void next_channel(Step& step) {
  step.state.channel = static_cast<std::uint8_t>(step.state.channel % radar::kChannels + 1);
}

void next_band(Step& step) {
  step.state.band = static_cast<std::uint8_t>((step.state.band + 1) % kBands);
}

void select_navigator(Step& step) {
  constexpr std::int16_t kToggle = -1;
  const std::int16_t argument = step.event.argument;
  if (argument == kToggle) {
    step.state.navigator ^= 1U;
  } else if (argument >= 0 && argument <= static_cast<std::int16_t>(radar::Navigator::ins)) {
    step.state.navigator = static_cast<std::uint8_t>(argument);
  }
}

void switch_altimeter(Step& step) {
  set_flag(step.state, databuffer::kAltimeterFailed, step.event.argument == 0);
}

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
