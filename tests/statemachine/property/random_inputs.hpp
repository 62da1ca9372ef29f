// Random inputs of a state machine: events of the pilot, and a model that completes maps at random.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <random>
#include <string_view>

#include "databuffer/messages/input_event.hpp"
#include "tests/statemachine/pilot.hpp"

namespace yars::statemachine::testing {

// Random events, and random changes of the inputs other than events.
class EventGenerator {
 public:
  explicit EventGenerator(std::uint64_t seed) : random_(seed) {}

  int pick(int least, int greatest) { return std::uniform_int_distribution(least, greatest)(random_); }
  double number(double least, double greatest) { return std::uniform_real_distribution(least, greatest)(random_); }

  // A random event: mostly valid, one in ten with an invalid argument. Power events are rare, because the radar would
  // otherwise be OFF most of the time. TDC releases are frequent, because there would otherwise be few maps.
  databuffer::InputEvent event() {
    databuffer::InputEvent event{};
    const int greatest_kind = static_cast<int>(databuffer::EventKind::cursor);
    event.kind = static_cast<std::uint16_t>(pick(0, 1) == 0 ? 1 : pick(0, greatest_kind + 1));
    if (event.kind == static_cast<std::uint16_t>(databuffer::EventKind::power) && pick(0, 19) != 0) event.kind = 1;
    if (pick(0, 9) == 0) event.kind = static_cast<std::uint16_t>(databuffer::EventKind::tdc_release);
    event.argument = static_cast<std::int16_t>(pick(0, 9) == 0 ? pick(-32768, 32767) : argument(event.kind));
    event.x = pick(0, 49) == 0 ? kNaN : event.kind == 2 ? number(-2.0, 2.0) : number(-90.0, 90.0);
    event.y = number(-2.0, 2.0);
    // Point names. The last name fills the field without a terminating zero.
    const std::array<std::string_view, 7> names{"1", "1.1", "2", "2.01", "3.", "9", "longer-than-it-is"};
    names[static_cast<std::size_t>(pick(0, 6))].copy(event.text, sizeof event.text);
    return event;
  }

  // Changes recorder, model, ownship and epoch at random.
  void disturb(Inputs& around) {
    around.tick += pick(1, 40);
    around.recorder_present = pick(0, 1) == 0;
    around.recorder_writing = around.recorder_present && pick(0, 1) == 0;
    around.recorder_failed = around.recorder_present && !around.recorder_writing && pick(0, 1) == 0;
    around.model.flags = pick(0, 1) == 0 ? databuffer::kModelFrozen : databuffer::kModelScanning;
    // The latitude drifts to the pole and stays near it. Above 90 degrees, validation would reject the ownship.
    around.ownship.latitude_deg = std::min(90.0, around.ownship.latitude_deg + number(-0.01, 0.012));
    around.ownship.longitude_deg = geo::wrapped_degrees(around.ownship.longitude_deg + number(-0.01, 0.012));
    around.ownship.velocity_east_mps = number(-300.0, 300.0);
    around.ownship.radar_altitude_m = pick(0, 3) == 0 ? kNaN : number(0.0, 500.0);
    if (pick(0, 9) == 0) measure_velocity(around.model);
    if (pick(0, 999) == 0) ++around.epoch;
    if (pick(0, 99) == 0) around.ownship_valid = !around.ownship_valid;
  }

 private:
  // A velocity measurement, sometimes an invalid one.
  void measure_velocity(databuffer::ModelStatus& model) {
    ++model.velocity_count;
    model.velocity_north_mps = number(-300.0, 300.0);
    model.velocity_east_mps = pick(0, 19) == 0 ? kNaN : number(-300.0, 300.0);
    model.velocity_down_mps = pick(0, 19) == 0 ? 1e12 : number(-50.0, 50.0);
  }

  int argument(int kind) {
    switch (static_cast<databuffer::EventKind>(kind)) {
      case databuffer::EventKind::push_button:
        return pick(1, 20);
      case databuffer::EventKind::acquisition:
      case databuffer::EventKind::contrast:
        return pick(0, 1) * 2 - 1;
      case databuffer::EventKind::elevation_step:
        return pick(-10, 10);
      case databuffer::EventKind::navigator_error:
      case databuffer::EventKind::navigator_drift:
        return pick(0, 1);
      case databuffer::EventKind::radar_mode:
        return pick(0, 7);
      case databuffer::EventKind::power:
        return pick(0, 4) == 0 ? 0 : pick(1, 2);
      default:
        return pick(-1, 2);
    }
  }
  std::mt19937_64 random_;
};

// A model that completes maps at random. Most maps answer the current request; some answer the request before it. One
// map in 20 has no readable record.
class MapMaker {
 public:
  // Sets a random reason for stopped re-mapping, answers requests for elevations, and may complete a map.
  void disturb(EventGenerator& generator, Pilot& pilot) {
    databuffer::ModelStatus& model = pilot.around.model;
    switch (generator.pick(0, 3)) {
      case 0:
        put_reason(model, "BLIND ZONE");
        break;
      case 1:
        put_reason(model, "\x07\xff");
        break;
      default:
        put_reason(model, "");
    }
    answer(generator, pilot);
    if (generator.pick(0, 9) == 0) complete(generator, pilot);
    latch_maps(pilot);
  }

 private:
  template <std::size_t N>
  static void put_reason(databuffer::ModelStatus& model, const char (&reason)[N]) {
    std::memcpy(model.map_stopped, reason, N);
  }

  // Answers a request for an elevation: sometimes late, with an unknown elevation, or for another position.
  static void answer(EventGenerator& generator, Pilot& pilot) {
    databuffer::ModelStatus& model = pilot.around.model;
    if (generator.pick(0, 3) == 0) return;
    model.answered_latitude_deg =
        generator.pick(0, 9) == 0 ? generator.number(-90.0, 90.0) : pilot.state.asked_latitude_deg;
    model.answered_longitude_deg = pilot.state.asked_longitude_deg;
    model.answered_elevation_m = generator.pick(0, 4) == 0 ? kNaN : generator.number(-400.0, 8000.0);
  }

  void complete(EventGenerator& generator, Pilot& pilot) {
    databuffer::ModelStatus& model = pilot.around.model;
    databuffer::PatchMap map{};
    map.id = ++model.map_newest;
    model.map_request = pilot.state.map_request;
    model.map_done_request =
        pilot.state.map_request - (generator.pick(0, 4) == 0 && pilot.state.map_request > 0 ? 1 : 0);
    map.latitude_deg = std::min(90.0, pilot.around.ownship.latitude_deg + generator.number(-0.2, 0.2));
    map.longitude_deg = pilot.around.ownship.longitude_deg;
    map.window_nm = 4.7;
    map.apex_latitude_deg = pilot.around.ownship.latitude_deg;
    map.apex_longitude_deg = pilot.around.ownship.longitude_deg;
    map.up_deg = generator.number(0.0, 360.0);
    map.distance_m = generator.number(5'000.0, 100'000.0);
    if (generator.pick(0, 19) != 0) made_[map.id] = map;
  }

  // Gives the state machine the records of NEW, OLD, STORE and the model's newest map, as the program does.
  void latch_maps(Pilot& pilot) const {
    const databuffer::RadarState& state = pilot.state;
    pilot.around.maps = {};
    std::size_t position = 0;
    for (const std::uint64_t id : {state.map_newest, state.map_old, state.map_stored, pilot.around.model.map_newest})
      if (const auto map = made_.find(id); map != made_.end()) pilot.around.maps[position++] = map->second;
  }

  std::map<std::uint64_t, databuffer::PatchMap> made_;
};

}  // namespace yars::statemachine::testing
