#include "databuffer/messages/derived_values.hpp"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "lib/radar/modes.hpp"

namespace yars::radar {

geo::Bearing ground_track(geo::Speed north, geo::Speed east, geo::Bearing heading) {
  const double north_mps = north.metres_per_second();
  const double east_mps = east.metres_per_second();
  // [m/s] Below this speed the aircraft is parked or towed, and noise dominates the direction of its velocity.
  constexpr double kMinMoving_mps = 1.0;
  if (std::hypot(north_mps, east_mps) < kMinMoving_mps) return heading;
  return geo::Bearing::radians(std::atan2(east_mps, north_mps));
}

}  // namespace yars::radar

namespace yars::databuffer {

namespace {

using geo::GeoPoint;

bool same(GeoPoint a, GeoPoint b) {
  return a.latitude_deg == b.latitude_deg && a.longitude_deg == b.longitude_deg;
}

// False for NaN, infinity and 0 N 0 E. A source that does not provide a navigator's position sends one of these.
bool is_set(GeoPoint point) {
  return std::isfinite(point.latitude_deg) && std::isfinite(point.longitude_deg) &&
         (point.latitude_deg != 0.0 || point.longitude_deg != 0.0);
}

// The point that has the same bearing and range from `to` as `position` has from `from`.
GeoPoint transferred(GeoPoint from, GeoPoint to, GeoPoint position) {
  if (same(from, to)) return position;
  const geo::GeodesicInverse line = geo::geodesic_inverse(from, position);
  return geo::geodesic_direct(to, line.azimuth_at_start, line.distance);
}

GeoPoint displaced(GeoPoint position, double north_m, double east_m) {
  return geo::AzimuthalEquidistant(position).geodetic_from_plane({east_m, north_m});
}

}  // namespace

geo::Bearing ground_track_of(const Ownship& ownship) {
  return radar::ground_track(geo::Speed::metres_per_second(ownship.velocity_north_mps),
                             geo::Speed::metres_per_second(ownship.velocity_east_mps),
                             geo::Bearing::degrees(ownship.heading_deg));
}

radar::Platform platform_of(const Ownship& ownship) {
  return {geo::Bearing::degrees(ownship.heading_deg), geo::Angle::degrees(ownship.pitch_deg),
          geo::Angle::degrees(ownship.roll_deg), ground_track_of(ownship)};
}

GeoPoint NavigatorPosition::on_video(GeoPoint known) const {
  return transferred(estimated, truth, known);
}

GeoPoint NavigatorPosition::coordinates_from_video(GeoPoint position) const {
  return transferred(truth, estimated, position);
}

NavigatorPosition navigator_position(radar::Navigator navigator, const Ownship& ownship, const Nav& nav,
                                     const RadarState& state) {
  const bool ins = navigator == radar::Navigator::ins;
  const GeoPoint truth{ownship.latitude_deg, ownship.longitude_deg};
  const GeoPoint given = ins ? GeoPoint{nav.ins_latitude_deg, nav.ins_longitude_deg}
                             : GeoPoint{nav.mission_latitude_deg, nav.mission_longitude_deg};
  const NavigatorError& error = ins ? state.ins : state.mission;
  return {truth, displaced(is_set(given) ? given : truth, error.north_m, error.east_m)};
}

NavigatorPosition selected_navigator_position(const Ownship& ownship, const Nav& nav, const RadarState& state) {
  return navigator_position(static_cast<radar::Navigator>(state.navigator), ownship, nav, state);
}

RadarCommand command_from_state(const RadarState& state) {
  RadarCommand command{};
  command.range_nm = state.range_nm;
  command.scan_width_deg = state.scan_width_deg;
  command.antenna_elevation_deg = state.antenna_elevation_deg;
  command.cursor_latitude_deg = state.cursor_latitude_deg;
  command.cursor_longitude_deg = state.cursor_longitude_deg;
  command.window_nm = state.window_nm;
  command.scan_restart = state.scan_restart;
  command.flags =
      state.flags & (kFreeze | kSniff | kIpvu | kMultiLook2 | kProgressive | kCursorValid | kMapping | kMapWindowBlank);
  command.power = state.power;
  // While the main menu is open, the radar continues in the mode that was active before.
  const bool menu = state.mode == static_cast<std::uint8_t>(radar::Mode::menu);
  command.mode = menu ? state.resume_mode : state.mode;
  command.scan = state.scan;
  command.gain = state.gain;
  command.range_index = state.range_index;
  command.channel = state.channel;
  command.band = state.band;
  command.map_latitude_deg = state.map_latitude_deg;
  command.map_longitude_deg = state.map_longitude_deg;
  command.map_window_nm = static_cast<float>(state.map_window_nm);
  command.map_request = state.map_request;
  return command;
}

namespace {

bool can_map_in(radar::Mode mode) {
  return mode == radar::Mode::rbm || mode == radar::Mode::hrm || mode == radar::Mode::patch;
}

}  // namespace

std::optional<double> map_timer_s(const RadarState& state, const ModelStatus& model) {
  if (!std::isfinite(model.map_timer_s)) return std::nullopt;
  const bool forms = model.map_window_nm > 0.0;
  const bool could_form = can_map_in(static_cast<radar::Mode>(state.resume_mode)) &&
                          state.cursor_function == static_cast<std::uint8_t>(radar::CursorFunction::map) &&
                          state.window_nm > 0.0 && model.mappable != 0;
  if (!forms && !could_form) return std::nullopt;
  return model.map_timer_s;
}

std::uint64_t sweep_hash(const Sweep& sweep) {
  const std::array<double, 8> fields{
      sweep.apex_latitude_deg, sweep.apex_longitude_deg, sweep.apex_altitude_msl_m, sweep.azimuth_left_deg,
      sweep.azimuth_right_deg, sweep.ground_track_deg,   sweep.elevation_deg,       sweep.range_m};
  const std::size_t used = std::min<std::size_t>(sweep.samples, radar::kMaxSamples);
  return XXH3_64bits_withSeed(sweep.video, used, XXH3_64bits(fields.data(), sizeof fields));
}

std::uint64_t map_hash(const PatchMap& map, std::span<const std::uint8_t> pixels) {
  const std::array<double, 12> fields{
      map.latitude_deg, map.longitude_deg,     map.elevation_msl_m,    map.up_deg,
      map.window_nm,    map.apex_latitude_deg, map.apex_longitude_deg, map.apex_altitude_msl_m,
      map.distance_m,   map.squint_deg,        map.resolution_m,       map.formation_s};
  return XXH3_64bits_withSeed(pixels.data(), pixels.size(), XXH3_64bits(fields.data(), sizeof fields));
}

}  // namespace yars::databuffer
