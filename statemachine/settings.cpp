#include "statemachine/settings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/mapping.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/world.hpp"
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

}  // namespace yars::statemachine
