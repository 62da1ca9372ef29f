// Fixture: a radar in one process, by default that of config/apg68.guf. It steps the state machine and the radar kernel
// over made-up terrain, tick by tick, and makes the display's input from their records.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "config/schema/load.hpp"
#include "databuffer/messages/derived_values.hpp"
#include "databuffer/messages/input_event.hpp"
#include "display/symbology/plan_view.hpp"
#include "lib/radar/modes.hpp"
#include "model/kernel/radar_kernel.hpp"
#include "model/terrain/sampling/analytic_terrain.hpp"
#include "statemachine/machine.hpp"

namespace yars::apg68 {

inline radar::RadarConfiguration configuration_of(const std::string& file) {
  const auto loaded = config::load_configuration(std::string(YARS_SOURCE_DIR) + "/config/" + file);
  EXPECT_TRUE(loaded) << (loaded ? "" : loaded.error().message());
  return loaded ? loaded->radar : radar::RadarConfiguration{};
}

// Elevation [m MSL] of the made-up terrain: ridges up to 900 m high, and sea east of longitude -121.7 deg.
inline double hills(geo::GeoPoint position) {
  const double wave = std::sin(position.latitude_deg * 40.0) * std::cos(position.longitude_deg * 55.0);
  return position.longitude_deg > -121.7 ? 0.0 : 450.0 + 450.0 * wave;
}

class Radar {
 public:
  explicit Radar(const radar::RadarConfiguration& given = configuration_of("apg68.guf"))
      : configuration(given), kernel(given), terrain(hills), state(statemachine::initial_state(given)) {
    databuffer::Ownship& ownship = around.ownship;
    ownship.latitude_deg = 37.0;
    ownship.longitude_deg = -122.0;
    ownship.altitude_msl_m = 3048.0;
    ownship.heading_deg = 20.0;
    ownship.velocity_north_mps = 220.0 * std::cos(20.0 * geo::kRadiansPerDegree);
    ownship.velocity_east_mps = 220.0 * std::sin(20.0 * geo::kRadiansPerDegree);
    ownship.radar_altitude_m = 3048.0;
    around.ownship_valid = true;
    around.nav.mission_latitude_deg = around.nav.ins_latitude_deg = ownship.latitude_deg;
    around.nav.mission_longitude_deg = around.nav.ins_longitude_deg = ownship.longitude_deg;
    around.nav.magnetic_variation_deg = std::numeric_limits<double>::quiet_NaN();
  }

  // Steps state machine and kernel by one tick. Returns true if the kernel made a sweep, which is then in `sweep`.
  bool step() {
    ++around.tick;
    advance(state, around, configuration);
    tick.tick = around.tick;
    tick.sim_time_ns = around.tick * radar::kTickNanoseconds;
    tick.epoch = 1;
    tick.flags = databuffer::kTickOwnshipValid | (due_ ? databuffer::kTickMapComplete : 0U);
    tick.ownship = around.ownship;
    tick.command = databuffer::command_from_state(state);
    const bool has_sweep = kernel.step(tick, {terrain, nullptr, true}, sweep);
    kernel.describe(terrain, around.model);
    model::kernel::answer_elevation(state, terrain, around.model);
    return has_sweep;
  }
  // As step(). If a patch map is due in this tick, its record also goes to the inputs of the state machine.
  void step_with_maps() {
    due_ = kernel.maps().due(around.tick + 1);
    if (due_) {
      const model::kernel::PendingMap& forming_map = kernel.maps().map();
      databuffer::PatchMap& map = around.maps[forming_map.id % around.maps.size()];
      map = {};
      map.id = forming_map.id;
      map.request = forming_map.request;
      map.latitude_deg = forming_map.order.centre.latitude_deg;
      map.longitude_deg = forming_map.order.centre.longitude_deg;
      map.window_nm = forming_map.order.window.nautical_miles();
      map.apex_latitude_deg = forming_map.order.apex.latitude_deg;
      map.apex_longitude_deg = forming_map.order.apex.longitude_deg;
      map.up_deg = forming_map.up_deg;
      map.distance_m = forming_map.distance_m;
    }
    step();
    due_ = false;
  }
  void fly(double metres) {
    databuffer::Ownship& ownship = around.ownship;
    const auto there = geo::geodesic_direct({ownship.latitude_deg, ownship.longitude_deg},
                                            geo::Bearing::degrees(ownship.heading_deg), geo::Length::metres(metres));
    ownship.latitude_deg = there.latitude_deg;
    ownship.longitude_deg = there.longitude_deg;
  }
  void turn_to(double heading_deg) {
    databuffer::Ownship& ownship = around.ownship;
    ownship.heading_deg = heading_deg;
    ownship.velocity_north_mps = 220.0 * std::cos(heading_deg * geo::kRadiansPerDegree);
    ownship.velocity_east_mps = 220.0 * std::sin(heading_deg * geo::kRadiansPerDegree);
  }
  std::vector<databuffer::Sweep> run(double seconds) {
    std::vector<databuffer::Sweep> sweeps;
    for (int i = 0; i < seconds / radar::kTickSeconds; ++i) {
      if (step()) sweeps.push_back(sweep);
    }
    return sweeps;
  }
  // The sweeps of one complete scan, from its first to its last; empty if none is complete after 20,000 ticks.
  std::vector<databuffer::Sweep> scan() {
    std::vector<databuffer::Sweep> sweeps;
    for (int i = 0; i < 20'000; ++i) {
      if (!step()) continue;
      if ((sweep.flags & databuffer::kSweepScanStart) != 0U) sweeps.clear();
      sweeps.push_back(sweep);
      const bool complete = (sweeps.front().flags & databuffer::kSweepScanStart) != 0U;
      if (complete && (sweep.flags & databuffer::kSweepScanEnd) != 0U) return sweeps;
    }
    return {};
  }
  bool send(const std::string& text) {
    const auto event = databuffer::event_from_text(text);
    EXPECT_TRUE(event.has_value()) << text;
    return event && apply(state, *event, around, configuration) != statemachine::Effect::none;
  }
  // Puts the cursor at this angle right of the initial ground track, 20 deg, and at this range from the aircraft.
  void put_cursor(double right_of_track_deg, double range_nm) {
    const geo::GeoPoint position =
        geo::geodesic_direct({around.ownship.latitude_deg, around.ownship.longitude_deg},
                             geo::Bearing::degrees(20.0 + right_of_track_deg), geo::Length::nautical_miles(range_nm));
    state.cursor_latitude_deg = position.latitude_deg;
    state.cursor_longitude_deg = position.longitude_deg;
    state.flags |= databuffer::kCursorValid;
    step();
  }
  display::DisplayInput display_input() const {
    display::DisplayInput input;
    input.state = state;
    input.model = around.model;
    input.ownship = around.ownship;
    input.nav = around.nav;
    return input;
  }

  radar::RadarConfiguration configuration;
  model::kernel::RadarKernel kernel;
  model::terrain::AnalyticTerrain terrain;
  databuffer::RadarState state;
  statemachine::Inputs around{};  // ownship, navigators, model status and patch maps
  databuffer::ModelTick tick{};
  databuffer::Sweep sweep{};

 private:
  bool due_ = false;  // a patch map completes in this tick
};

}  // namespace yars::apg68
