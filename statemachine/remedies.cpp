#include "statemachine/remedies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>

#include "databuffer/messages/derived_values.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/sensor.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::statemachine {

namespace {

using databuffer::RadarState;
using geo::Length;

// The refused map: as command_map() or the radar model tried it, from the aircraft's present position.
struct RefusedMap {
  radar::MapViewpoint from;
  radar::MapCentre centre;
  radar::MapWindow window;
  geo::GeodesicInverse path;  // from the aircraft to the centre
  bool again = false;         // the radar maps again by itself as soon as it can
};

RefusedMap refused_map(const RadarState& state, const Inputs& inputs) {
  const databuffer::Ownship& ownship = inputs.ownship;
  RefusedMap map{{{ownship.latitude_deg, ownship.longitude_deg},
                  geo::AltitudeMsl::metres(ownship.altitude_msl_m),
                  databuffer::platform_of(ownship)},
                 {cursor_of(state), std::nullopt},
                 {Length::nautical_miles(state.window_nm)},
                 {}};
  map.again = state.message_until_tick == databuffer::kUntilCauseEnds;
  if (map.again) {
    map.centre.position = {state.map_latitude_deg, state.map_longitude_deg};
    map.window = {Length::nautical_miles(state.map_window_nm), has(state, databuffer::kMapWindowBlank)};
  } else if (std::isfinite(state.cursor_elevation_m)) {
    map.centre.ground_m = state.cursor_elevation_m;
  }
  map.path = geo::geodesic_inverse(map.from.aircraft, map.centre.position);
  return map;
}

template <typename... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 128> buffer;
  const int length = std::snprintf(buffer.data(), buffer.size(), format, values...);
  return {buffer.data(), static_cast<std::size_t>(std::clamp(length, 0, static_cast<int>(buffer.size()) - 1))};
}

// Degrees of a turn, rounded up, at least 1. The allowance keeps 8.0000001 at 8.
int whole_degrees(double degrees) {
  constexpr double kAllowance_deg = 1e-6;
  return std::max(1, static_cast<int>(std::ceil(degrees - kAllowance_deg)));
}

std::string turn_toward(const RefusedMap& map, double limit_deg) {
  const double off_deg = (map.path.azimuth_at_start - map.from.platform.heading).degrees();
  return formatted("turn %d deg or more %s, toward the %s", whole_degrees(std::abs(off_deg) - limit_deg),
                   off_deg > 0.0 ? "right" : "left", map.again ? "map" : "cursor");
}

// Tenths of a value, rounded up, so that the limit is kept. The allowance keeps 4.7000001 at 4.7.
double tenths_up(double value) {
  constexpr double kAllowance = 1e-6;
  return std::ceil(value * 10.0 - kAllowance) / 10.0;
}

// Distance [NM] across the ground track from the cursor to the edge of the blind zone on the cursor's side. `out_deg`:
// angle from the ground track to the cursor, positive toward that edge.
double across_blind_zone_nm(const RefusedMap& map, double out_deg, double blind_zone_deg) {
  const double squint_rad = out_deg * geo::kRadiansPerDegree;
  const double along_nm = map.path.distance.nautical_miles() * std::cos(squint_rad);
  return along_nm * (std::tan(blind_zone_deg * geo::kRadiansPerDegree) - std::tan(squint_rad));
}

// Ahead: a turn away from the cursor. Astern the gimbal forbids the map, too; so the aircraft must turn toward it.
std::string leave_blind_zone(const RefusedMap& map, const radar::MapLimits& limits) {
  const double squint_deg = (map.path.azimuth_at_start - map.from.platform.ground_track).degrees();
  if (std::abs(squint_deg) > 90.0) return turn_toward(map, limits.antenna.azimuth_limit_deg);
  // On the track line the sign of the squint changes from tick to tick. Advice for that line has one fixed side.
  constexpr double kOnTrack_deg = 1.0;
  const bool right = squint_deg >= -kOnTrack_deg;
  const double out_deg = right ? squint_deg : -squint_deg;
  const int turn_deg = whole_degrees(limits.blind_zone_deg - out_deg);
  std::string turn = formatted("turn %d deg or more %s", turn_deg, right ? "left" : "right");
  if (map.again) return turn;
  const double across_nm = across_blind_zone_nm(map, out_deg, limits.blind_zone_deg);
  return turn + formatted(", or move the cursor %.1f NM %s", tenths_up(across_nm), right ? "right" : "left");
}

// True if the gimbal alone forbids the map in this attitude.
bool gimbal_forbids(RefusedMap map, const radar::MapLimits& limits, geo::Angle pitch, geo::Angle roll) {
  map.from.platform.pitch = pitch;
  map.from.platform.roll = roll;
  return radar::map_rejection(map.from, map.centre, map.window, limits) == "GIMBAL";
}

// The largest whole angle nearer to level than `angle_deg`, on the same side, that `forbids` does not forbid.
template <class Forbids>
std::optional<int> largest_allowed(double angle_deg, const Forbids& forbids) {
  for (int degrees = static_cast<int>(std::abs(angle_deg)); degrees >= 0; --degrees)
    if (!forbids(geo::Angle::degrees(std::copysign(degrees, angle_deg)))) return degrees;
  return std::nullopt;
}

std::string level_out(const RefusedMap& map, const radar::MapLimits& limits) {
  const radar::Platform& platform = map.from.platform;
  const auto roll_forbids = [&](geo::Angle roll) { return gimbal_forbids(map, limits, platform.pitch, roll); };
  if (const auto bank_deg = largest_allowed(platform.roll.degrees(), roll_forbids))
    return formatted("level the wings: bank %d deg or less", *bank_deg);
  const auto pitch_forbids = [&](geo::Angle pitch) { return gimbal_forbids(map, limits, pitch, platform.roll); };
  if (const auto pitch_deg = largest_allowed(platform.pitch.degrees(), pitch_forbids))
    return formatted("level the nose: pitch %d deg or less", *pitch_deg);
  return "level wings and nose: bank 0 deg, pitch 0 deg";
}

std::string return_into_gimbal(const RefusedMap& map, const radar::MapLimits& limits) {
  const radar::AntennaConfiguration& antenna = limits.antenna;
  const double off_deg = (map.path.azimuth_at_start - map.from.platform.heading).degrees();
  if (std::abs(off_deg) > antenna.azimuth_limit_deg) return turn_toward(map, antenna.azimuth_limit_deg);
  const double ground_m = map.centre.ground_m.value_or(0.0);
  const double down_deg = -radar::elevation_to_ground(map.from.altitude, map.path.distance, ground_m).degrees();
  if (down_deg <= antenna.elevation_limit_deg) return level_out(map, limits);
  constexpr double kStep_ft = 100.0;  // of altitudes
  const double slope = std::tan(antenna.elevation_limit_deg * geo::kRadiansPerDegree);
  const double height_m = map.from.altitude.metres() - (std::isnan(ground_m) ? 0.0 : ground_m);
  const auto surplus = Length::metres(height_m - map.path.distance.metres() * slope);
  std::string descend = formatted("descend %.0f ft or more", std::ceil(surplus.feet() / kStep_ft) * kStep_ft);
  if (map.again) return descend;
  const auto least = Length::metres(height_m / slope);
  return descend + formatted(", or move the cursor out to %.1f NM or more", tenths_up(least.nautical_miles()));
}

// The window nearest in size that can be mapped at this range; nullopt if none can.
std::optional<double> other_window_nm(const RefusedMap& map, const Parameters& parameters, double range_nm) {
  const double present_nm = map.window.size.nautical_miles();
  std::optional<double> best_nm;
  for (const double window_nm : parameters.windows_nm) {
    const auto limits = radar::cursor_limits(Length::nautical_miles(window_nm), parameters.window_limits);
    if (!limits || !limits->contains(map.path.distance) || window_nm > range_nm) continue;
    if (!best_nm || std::abs(window_nm - present_nm) < std::abs(*best_nm - present_nm)) best_nm = window_nm;
  }
  return best_nm;
}

// Presses of the acquisition switch from one window to another. 0 is the blank window, below all others.
long presses_between(double from_nm, double to_nm, const std::vector<double>& windows_nm) {
  const auto up_to = [&](double size_nm) {
    return std::ranges::count_if(windows_nm, [size_nm](double window_nm) { return window_nm <= size_nm; });
  };
  return std::abs(up_to(to_nm) - up_to(from_nm));
}

// Text ", or take window 1.3: acq fwd (PgUp)" if another window can be mapped at this range; empty if none can.
std::string other_window(const RefusedMap& map, const Parameters& parameters, double range_nm) {
  const auto window_nm = other_window_nm(map, parameters, range_nm);
  if (!window_nm) return {};
  const double present_nm = map.window.size.nautical_miles();
  const long presses = presses_between(present_nm, *window_nm, parameters.windows_nm);
  return formatted(", or take window %g: %s", *window_nm,
                   *window_nm > present_nm ? "acq fwd (PgUp)" : "acq aft (PgDn)") +
         (presses > 1 ? formatted(" %ld times", presses) : std::string());
}

// While re-mapping stops: how far the map is beyond the limit of its window.
std::string fly_into_range(const RefusedMap& map, double limit_nm) {
  const double off_nm = map.path.distance.nautical_miles() - limit_nm;
  return off_nm > 0.0 ? formatted("fly %.1f NM nearer, to %.1f NM or less", tenths_up(off_nm), limit_nm)
                      : formatted("fly %.1f NM away, to %.1f NM or more", tenths_up(-off_nm), limit_nm);
}

std::string into_range(const RefusedMap& map, const Parameters& parameters, double range_nm) {
  const auto limits = radar::cursor_limits(map.window.size, parameters.window_limits);
  if (!limits) return "select another window: acq fwd (PgUp), acq aft (PgDn)";
  const bool near = map.path.distance < limits->min;
  const double limit_nm = (near ? limits->min : limits->max).nautical_miles();
  if (map.again) return fly_into_range(map, limit_nm);
  return formatted(near ? "move the cursor out to %.1f NM or more" : "move the cursor in to %.1f NM or less",
                   limit_nm) +
         other_window(map, parameters, range_nm);
}

std::string into_range_of_blank(const RefusedMap& map, const Parameters& parameters, double range_nm) {
  const radar::WindowLimits& table = parameters.window_limits;
  const double least_nm = table.blank_min_range_nm;
  const double greatest_nm = table.blank_max_range_nm.empty() ? least_nm : table.blank_max_range_nm.back();
  const bool near = map.path.distance.nautical_miles() < least_nm;
  return formatted(near ? "move the cursor out to %.1f NM or more" : "move the cursor in to %.1f NM or less",
                   near ? least_nm : greatest_nm) +
         other_window(map, parameters, range_nm);
}

// What a blank window is: the window that a map at the cursor would have now, and how to select one.
std::string remedy_of_blank_window(const RadarState& state, const Inputs& inputs, const Parameters& parameters) {
  if (parameters.windows_nm.empty()) return {};
  const std::string back = formatted("back to %g NM: acq fwd (PgUp)", parameters.windows_nm.front());
  if (!inputs.ownship_valid || !has(state, databuffer::kCursorValid)) return "by the cursor's range; " + back;
  const RefusedMap map = refused_map(state, inputs);
  const auto window = radar::window_of_blank_selection(map.path.distance, parameters.window_limits);
  if (!window) return "no map at this range; " + back;
  return formatted("by the cursor's range, here %g NM; ", window->nautical_miles()) + back;
}

std::string remedy_of_map(const RadarState& state, const Inputs& inputs, const Parameters& parameters) {
  const RefusedMap map = refused_map(state, inputs);
  const auto limit = radar::map_rejection(map.from, map.centre, map.window, parameters.map_limits);
  if (!limit) return map.again ? "it resumes by itself" : "it is possible now: tdc release (Enter)";
  if (*limit == "BLIND ZONE") return leave_blind_zone(map, parameters.map_limits);
  if (*limit == "GIMBAL") return return_into_gimbal(map, parameters.map_limits);
  if (*limit == "NO WINDOW" && map.window.size == Length()) return into_range_of_blank(map, parameters, state.range_nm);
  return into_range(map, parameters, state.range_nm);
}

// The names of the first points of the route, as many as fit a line of the display.
std::string route_names(const Parameters& parameters) {
  constexpr std::size_t kMaxLength = 60;
  if (parameters.route.empty()) return "the configuration has no route";
  std::string names = "points:";
  for (const radar::RoutePoint& point : parameters.route) {
    if (names.size() + point.name.size() > kMaxLength) return names + " ...";
    names += " " + point.name;
  }
  return names;
}

struct FixedRemedy {
  std::string_view message;
  const char* remedy;
};
constexpr std::array kFixed{
    FixedRemedy{"NO CURSOR", "select a point: sp 1, pb 17 (H)"},
    FixedRemedy{"NO OWNSHIP", databuffer::kRemedyNoOwnship},
    FixedRemedy{"NO MAP", "command it again: tdc release (Enter)"},
    FixedRemedy{"NO FREE NUMBER", "select another point, then designate: pb 17 (H)"},
    FixedRemedy{"NO RECORDER", "start one: Record in the browser, or yars record FILE"},
    FixedRemedy{"VTR FULL", "make room on the disk; it tries again every 5 s"},
};

bool is_limit(std::string_view message) {
  constexpr std::array<std::string_view, 5> kLimits{"BLIND ZONE", "GIMBAL", "MIN RANGE", "MAX RANGE", "NO WINDOW"};
  return std::ranges::find(kLimits, message) != kLimits.end();
}

}  // namespace

std::string remedy_of_message(const RadarState& state, const Inputs& inputs, const Parameters& parameters) {
  const std::string_view message = text::text_of(state.message);
  if (is_limit(message)) return inputs.ownship_valid ? remedy_of_map(state, inputs, parameters) : std::string();
  if (message.starts_with("NO POINT ")) return route_names(parameters);
  if (message == kBlankWindow) return remedy_of_blank_window(state, inputs, parameters);
  const auto fixed = std::ranges::find(kFixed, message, &FixedRemedy::message);
  return fixed == kFixed.end() ? std::string() : fixed->remedy;
}

}  // namespace yars::statemachine
