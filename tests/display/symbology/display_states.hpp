// Inputs of the display for tests: radar state, ownship and status as the programs of a set publish them.
#pragma once

#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <string>

#include "display/symbology/plan_view.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::display::testing {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

template <std::size_t N>
void set_text(char (&field)[N], const std::string& text) {
  field[text.copy(field, N - 1)] = '\0';
}

// Legends of a mode, by push button.
inline std::map<int, std::string> legends_of(radar::Mode mode) {
  using radar::Mode;
  std::map<int, std::string> common{{11, "M"}, {12, "VTR"}, {16, "IPVU"}, {17, "2.01"}, {18, "SNIFF"},
                                    {19, "1"}, {20, "A"},   {4, "BRT+"},  {5, "BRT-"},  {2, "DCL"}};
  const auto with = [&](std::map<int, std::string> more) {
    more.merge(common);
    return more;
  };
  switch (mode) {
    case Mode::rbm:
      return with({{3, "GAIN 3"}, {6, "RBM"}, {7, "UPDT"}, {9, "FULL"}, {13, "^"}, {14, "v"}});
    case Mode::hrm:
      return with({{3, "ML1"}, {6, "HRM"}, {7, "MARK"}, {9, "HALF"}, {10, "STORE"}, {13, "^"}, {14, "v"}, {15, "STO"}});
    case Mode::patch:
      return with({{3, "ML2"}, {6, "HRM"}, {7, "MARK"}, {8, "STAB"}, {10, "STORE"}, {14, "PPI"}, {15, "STO"}});
    case Mode::beacon:
      return with({{3, "GAIN 0"}, {6, "BCN"}, {7, "CUE"}, {9, "QTR"}, {13, "^"}, {14, "v"}});
    case Mode::pvu:
      common.erase(16);
      return with({{6, "PVU"}});
    case Mode::air_to_air:
    case Mode::ranging:
      return {{2, "DCL"}, {4, "BRT+"}, {5, "BRT-"}, {7, "UPDT"}, {11, "M"}, {12, "VTR"}, {17, "2.01"}, {18, "SET"}};
    case Mode::menu:
      return {{6, "A/G RDR"}};
  }
  return {};
}

inline void put_legends(databuffer::RadarState& state, radar::Mode mode) {
  for (const auto& [button, legend] : legends_of(mode)) set_text(state.legends[button], legend);
}

inline constexpr geo::GeoPoint kAircraftPosition{34.2, -120.6};  // off Point Conception, California

// Input with the radar in operation. The aircraft flies at 15,000 ft on the ground track 030 at 450 kt, with a drift of
// 4 deg to the right.
inline DisplayInput operating(radar::Mode mode, double range_nm) {
  DisplayInput input;
  input.ownship.latitude_deg = kAircraftPosition.latitude_deg;
  input.ownship.longitude_deg = kAircraftPosition.longitude_deg;
  input.ownship.altitude_msl_m = 4572.0;
  input.ownship.heading_deg = 26.0;
  input.ownship.velocity_north_mps = 231.5 * std::cos(30.0 * geo::kRadiansPerDegree);
  input.ownship.velocity_east_mps = 231.5 * std::sin(30.0 * geo::kRadiansPerDegree);
  input.nav.mission_latitude_deg = input.nav.ins_latitude_deg = kAircraftPosition.latitude_deg;
  input.nav.mission_longitude_deg = input.nav.ins_longitude_deg = kAircraftPosition.longitude_deg;
  input.model.mappable = 1;
  input.model.map_timer_s = input.model.map_progress = kNone;
  databuffer::RadarState& state = input.state;
  state.power = static_cast<std::uint8_t>(radar::Power::operate);
  state.mode = static_cast<std::uint8_t>(mode);
  state.range_nm = range_nm;
  state.brightness = 8;
  state.contrast = 8;
  state.window_nm = 4.7;
  put_legends(state, mode);
  return input;
}

// Position at a true bearing and a distance from kAircraftPosition.
inline geo::GeoPoint at(double bearing_deg, double range_nm) {
  return geo::geodesic_direct(kAircraftPosition, geo::Bearing::degrees(bearing_deg),
                              geo::Length::nautical_miles(range_nm));
}

inline void put_cursor(DisplayInput& input, double bearing_deg, double range_nm) {
  const geo::GeoPoint position = at(bearing_deg, range_nm);
  input.state.flags |= databuffer::kCursorValid;
  input.state.cursor_latitude_deg = position.latitude_deg;
  input.state.cursor_longitude_deg = position.longitude_deg;
  input.state.cursor_bearing_deg = bearing_deg;
  input.state.cursor_range_nm = range_nm;
}

// Shows a patch map that was made from kAircraftPosition; its centre is at this bearing and range.
inline void put_map(DisplayInput& input, double bearing_deg, double range_nm, double window_nm) {
  const geo::GeoPoint centre = at(bearing_deg, range_nm);
  databuffer::PatchMap& map = input.map;
  map.id = input.state.map_newest = input.state.map_shown = 1;
  map.size = 480;
  map.latitude_deg = centre.latitude_deg;
  map.longitude_deg = centre.longitude_deg;
  map.up_deg = bearing_deg;
  map.window_nm = window_nm;
  map.apex_latitude_deg = kAircraftPosition.latitude_deg;
  map.apex_longitude_deg = kAircraftPosition.longitude_deg;
  map.distance_m = range_nm * geo::kMetresPerNauticalMile;
}

// Ground position at the display position `at` [units]: on the patch map that is shown, else in the default view with
// the ground track 030 up. The default view has its apex at (240, 440) and 400 units per range.
inline geo::GeoPoint ground_at(const DisplayInput& input, Point on_display) {
  double up_deg = 30.0, forward_nm = (440.0 - on_display.y) / 400.0 * input.state.range_nm;
  double right_nm = (on_display.x - 240.0) / 400.0 * input.state.range_nm;
  if (input.map.id != 0) {
    up_deg = input.map.up_deg;
    forward_nm =
        input.map.distance_m / geo::kMetresPerNauticalMile + (240.0 - on_display.y) / 480.0 * input.map.window_nm;
    right_nm = (on_display.x - 240.0) / 480.0 * input.map.window_nm;
  }
  return at(up_deg + std::atan2(right_nm, forward_nm) / geo::kRadiansPerDegree, std::hypot(right_nm, forward_nm));
}

// Puts a commanded patch map in formation; its centre is at this bearing and range.
inline void put_forming_map(DisplayInput& input, double bearing_deg, double range_nm, double window_nm) {
  const geo::GeoPoint centre = at(bearing_deg, range_nm);
  input.state.flags |= databuffer::kMapping;
  input.state.map_request = input.model.map_request = 4;
  input.model.map_latitude_deg = centre.latitude_deg;
  input.model.map_longitude_deg = centre.longitude_deg;
  input.model.map_up_deg = bearing_deg;
  input.model.map_window_nm = window_nm;
}

// Designates the target "4." at a position, with its pattern steering line.
inline void put_target(DisplayInput& input, geo::GeoPoint position, double approach_deg,
                       databuffer::SteeringLine line) {
  databuffer::RadarState& state = input.state;
  state.flags |= databuffer::kTargetDesignated;
  state.target_latitude_deg = position.latitude_deg;
  state.target_longitude_deg = position.longitude_deg;
  state.steering_line_deg = approach_deg;
  state.steering_line = static_cast<std::uint8_t>(line);
  set_text(state.target_name, "4.");
}

// Shows the errors of UPDT, from the selected point to the cursor, and the seconds of the counter; -1: no counter.
inline void put_update(DisplayInput& input, double north_ft, double east_ft, int seconds) {
  input.state.flags |= databuffer::kUpdateShown;
  input.state.update_north_m = north_ft * geo::kMetresPerFoot;
  input.state.update_east_m = east_ft * geo::kMetresPerFoot;
  input.state.update_seconds = seconds;
}

// Shows the velocity differences of PVU.
inline void put_velocities(DisplayInput& input, double along_fps, double across_fps, double vertical_fps) {
  input.state.flags |= databuffer::kVelocityShown;
  input.state.velocity_along_mps = along_fps * geo::kMetresPerFoot;
  input.state.velocity_across_mps = across_fps * geo::kMetresPerFoot;
  input.state.velocity_vertical_mps = vertical_fps * geo::kMetresPerFoot;
}

inline void add_point(DisplayInput& input, const std::string& name, radar::PointKind kind, geo::GeoPoint position) {
  databuffer::DrawnPoint& point = input.state.points[input.state.points_drawn++];
  point.latitude_deg = position.latitude_deg;
  point.longitude_deg = position.longitude_deg;
  point.kind = static_cast<std::uint8_t>(kind);
  set_text(point.name, name);
}

}  // namespace yars::display::testing
