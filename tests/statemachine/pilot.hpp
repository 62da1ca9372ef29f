// Simulated pilot: sends events as text, advances ticks, and reads the state back in the words of `yars watch`.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <sstream>
#include <string>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/pictures.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/radar/configuration.hpp"
#include "lib/radar/modes.hpp"
#include "statemachine/machine.hpp"

namespace yars::statemachine::testing {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr geo::GeoPoint kAircraftPosition{36.0, -121.0};

inline geo::GeoPoint position(double bearing_deg, double distance_nm) {
  return geo::geodesic_direct(kAircraftPosition, geo::Bearing::degrees(bearing_deg),
                              geo::Length::nautical_miles(distance_nm));
}

inline radar::RoutePoint route_point(const std::string& name, radar::PointKind kind, geo::GeoPoint where,
                                     double elevation_m = 100.0) {
  return {name, kind, where, elevation_m};
}

class Pilot {
 public:
  // Aircraft at 36 N 121 W, 15,000 ft MSL, flying north at 200 m/s. The radar altimeter reads 200 m (656 ft).
  Pilot() {
    using radar::PointKind;
    configuration.route = {route_point("1", PointKind::steer, position(10.0, 12.0)),
                           route_point("1.1", PointKind::steer_offset, position(5.0, 14.0)),
                           route_point("2", PointKind::initial, position(0.0, 18.0)),
                           route_point("2.01", PointKind::target_offset, position(-10.0, 22.0)),
                           route_point("3.", PointKind::target, position(15.0, 30.0))};
    around.ownship_valid = true;
    around.ownship.latitude_deg = kAircraftPosition.latitude_deg;
    around.ownship.longitude_deg = kAircraftPosition.longitude_deg;
    around.ownship.altitude_msl_m = 4572.0;
    around.ownship.velocity_north_mps = 200.0;
    around.ownship.radar_altitude_m = 200.0;
    around.nav.magnetic_variation_deg = kNaN;
    around.model.mappable = 1;
    configuration.high_resolution.blind_zone_deg = 0.0;  // most points lie ahead; tests of the limits set it
    state = initial_state(configuration);
  }

  // Applies an event given as text. True: the event changed the state or was refused. False: it was dead. Text that is
  // not an event is a test failure.
  bool send(const std::string& text) {
    const auto event = databuffer::event_from_text(text);
    EXPECT_TRUE(event.has_value()) << text;
    return event && apply(state, *event, around, configuration) != Effect::none;
  }

  // Advances by ticks of 5 ms. The model answers after each tick.
  void wait(int ticks = 1) {
    for (int tick = 0; tick < ticks; ++tick) {
      ++around.tick;
      advance(state, around, configuration);
      answer();
    }
  }

  // The model's answer to a request for an elevation.
  void answer() {
    around.model.answered_latitude_deg = state.asked_latitude_deg;
    around.model.answered_longitude_deg = state.asked_longitude_deg;
    around.model.answered_elevation_m = ground({state.asked_latitude_deg, state.asked_longitude_deg});
  }

  // Sends an event and advances one tick. Result: as send().
  bool press(const std::string& text) {
    const bool did = send(text);
    wait();
    return did;
  }

  // The model completes the commanded map, or a re-map of the same position, as seen from the aircraft's position.
  // Returns the id of the map.
  std::uint64_t complete_map() {
    databuffer::PatchMap map{};
    map.id = ++around.model.map_newest;
    map.request = around.model.map_done_request = around.model.map_request = state.map_request;
    map.latitude_deg = state.map_latitude_deg;
    map.longitude_deg = state.map_longitude_deg;
    map.window_nm = state.map_window_nm;
    map.apex_latitude_deg = around.ownship.latitude_deg;
    map.apex_longitude_deg = around.ownship.longitude_deg;
    const auto line =
        geo::geodesic_inverse({map.apex_latitude_deg, map.apex_longitude_deg}, {map.latitude_deg, map.longitude_deg});
    map.up_deg = line.azimuth_at_start.degrees();
    map.distance_m = line.distance.metres();
    map.size = 480;
    // The record replaces that of a map which is not NEW, OLD or STORE.
    for (databuffer::PatchMap& known : around.maps) {
      if (known.id != 0 && (known.id == state.map_newest || known.id == state.map_old || known.id == state.map_stored))
        continue;
      known = map;
      break;
    }
    wait();
    return map.id;
  }
  // Commands a map at the cursor and completes it. Returns its id.
  std::uint64_t make_map() {
    EXPECT_TRUE(press("tdc release"));
    return complete_map();
  }

  std::string legend(int button) const { return state.legends[button]; }
  bool boxed(int button) const { return (state.boxed >> button & 1U) != 0; }
  bool is(std::uint32_t flag) const { return (state.flags & flag) != 0; }

  radar::RadarConfiguration configuration;
  std::function<double(geo::GeoPoint)> ground = [](geo::GeoPoint) { return 0.0; };  // [m] MSL
  Inputs around;
  databuffer::RadarState state;
};

inline std::string word_of(radar::Recall recall) {
  switch (recall) {
    case radar::Recall::newest:
      return "NEW";
    case radar::Recall::old:
      return "OLD";
    case radar::Recall::store:
      return "STORE";
    case radar::Recall::none:
      break;
  }
  return "-";
}

inline std::string word_of(databuffer::SteeringLine line) {
  switch (line) {
    case databuffer::SteeringLine::line_of_sight:
      return "LOS";
    case databuffer::SteeringLine::slewing:
      return "SLEW";
    case databuffer::SteeringLine::fixed:
      return "FIXED";
    case databuffer::SteeringLine::none:
      break;
  }
  return "-";
}

inline std::string words_of(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

// Name of the route point under the cursor; "-": none.
inline std::string point_under_cursor(const Pilot& pilot) {
  for (const radar::RoutePoint& point : pilot.configuration.route) {
    const bool here = (pilot.state.flags & databuffer::kCursorValid) != 0 &&
                      point.position.latitude_deg == pilot.state.cursor_latitude_deg &&
                      point.position.longitude_deg == pilot.state.cursor_longitude_deg;
    if (here) return point.name;
  }
  return "-";
}

using Fields = std::map<std::string, std::string>;

// The state as field names and values, for comparison with the tables. `maps`: ids of NEW/OLD/STORE; `shown`: id of the
// map on the display; 0: none.
inline Fields fields_of(const Pilot& pilot) {
  const databuffer::RadarState& state = pilot.state;
  const auto flag = [&state](std::uint32_t bit) { return std::string((state.flags & bit) != 0 ? "true" : "false"); };
  return {
      {"power", std::string(name_of(static_cast<radar::Power>(state.power)))},
      {"mode", std::string(name_of(static_cast<radar::Mode>(state.mode)))},
      {"running", std::string(name_of(static_cast<radar::Mode>(state.resume_mode)))},
      {"master", std::string(name_of(static_cast<radar::Master>(state.master)))},
      {"range_nm", words_of(state.range_nm)},
      {"scan", std::string(name_of(static_cast<radar::ScanWidth>(state.scan)))},
      {"gain", words_of(state.gain)},
      {"brightness", words_of(state.brightness)},
      {"contrast", words_of(state.contrast)},
      {"declutter", flag(databuffer::kDeclutter)},
      {"freeze", flag(databuffer::kFreeze)},
      {"sniff", flag(databuffer::kSniff)},
      {"ipvu", flag(databuffer::kIpvu)},
      {"vtr", flag(databuffer::kVtr)},
      {"set", flag(databuffer::kSet)},
      {"menu", flag(databuffer::kMenu)},
      {"mapping", flag(databuffer::kMapping)},
      {"recall", word_of(static_cast<radar::Recall>(state.recall))},
      {"shown", std::to_string(state.map_shown)},
      {"maps",
       std::to_string(state.map_newest) + "/" + std::to_string(state.map_old) + "/" + std::to_string(state.map_stored)},
      {"cursor_function", std::string(name_of(static_cast<radar::CursorFunction>(state.cursor_function)))},
      {"cursor_on", point_under_cursor(pilot)},
      {"window_nm", words_of(state.window_nm)},
      {"multi_look", flag(databuffer::kMultiLook2) == "true" ? "ML2" : "ML1"},
      {"stabilizing", flag(databuffer::kProgressive) == "true" ? "PROG" : "STAB"},
      {"channel", words_of(state.channel)},
      {"band", std::string(1, static_cast<char>('A' + state.band))},
      {"sequence_point", state.sequence_point},
      {"nav_source", std::string(name_of(static_cast<radar::Navigator>(state.navigator)))},
      {"altimeter", flag(databuffer::kAltimeterFailed) == "true" ? "FAIL" : "ok"},
      {"elevation", words_of(state.antenna_elevation_deg)},
      {"moved", std::hypot(state.mission.north_m, state.mission.east_m) > 1.0 ? "true" : "false"},
      {"drift", state.mission.velocity_north_mps != 0.0 || state.mission.velocity_east_mps != 0.0 ? "true" : "false"},
      {"cues", std::to_string(state.cue_count)},
      {"target", state.target_name},
      {"psl", word_of(static_cast<databuffer::SteeringLine>(state.steering_line))},
      {"marks", std::to_string(state.mark_count)},
      {"vtr_requests", std::to_string(state.vtr_request)},
      {"tdc", words_of(state.tdc_x) + "/" + words_of(state.tdc_y)},
      {"message", state.message}};
}

// Brings a new pilot by events into a mode, or into a state that transitions.csv describes (MAPS, AAMAP, AASET, AGSET).
// The range is then 40 NM, in PVU 20 NM.
inline void bring_into(Pilot& pilot, const std::string& mode, bool frozen) {
  if (mode == "OFF") return;
  const bool map_stands = mode == "AAMAP" || mode == "AASET" || mode == "AGSET";
  const bool patch = mode == "PATCH" || mode == "MAPS" || map_stands;
  pilot.press("power opr");
  if (mode == "HRM" || patch) pilot.press("radar hrm");
  if (mode == "BCN") pilot.press("radar bcn");
  if (mode == "PVU") pilot.press("radar pvu");
  if (mode != "PVU") pilot.press("pb 13");
  if (patch) {
    pilot.make_map();
    pilot.make_map();
  }
  if (mode == "MAPS") pilot.press("pb 14");
  if (frozen) pilot.press("freeze");
  if (mode == "AA" || map_stands) pilot.press("mode aa");
  if (mode == "AASET" || mode == "AGSET") pilot.press("pb 18");
  if (mode == "AGSET") pilot.press("mode ag");
  if (mode == "AGR") pilot.press("mode agr");
  if (mode == "MENU") pilot.press("pb 11");
  if (mode == "STBY") pilot.press("power stby");
}

}  // namespace yars::statemachine::testing
