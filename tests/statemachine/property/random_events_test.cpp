// Random events: the state keeps its invariants after each event, and can always return to a running real beam map.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <ostream>
#include <random>
#include <string>
#include <utility>

#include "config/schema/load.hpp"
#include "databuffer/messages/derived_values.hpp"
#include "databuffer/messages/validation.hpp"
#include "tests/statemachine/pilot.hpp"

namespace yars::statemachine::testing {
namespace {

using databuffer::EventKind;
using databuffer::InputEvent;
using databuffer::RadarState;

struct RandomRun {
  const char* file;  // of a configuration; empty: the APG-70
  int events;
  // For stable names of the tests: the default prints the bytes of the pointer, which differ in each run.
  friend void PrintTo(const RandomRun& run, std::ostream* out) {
    *out << (*run.file == '\0' ? "built-in" : run.file) << ", " << run.events << " events";
  }
};

// Seed of the random events. YARS_SEED repeats a failed run.
std::uint64_t random_seed() {
  const char* given = std::getenv("YARS_SEED");
  return given ? std::strtoull(given, nullptr, 10) : std::random_device{}();
}

class EventGenerator {
 public:
  explicit EventGenerator(std::uint64_t seed) : random_(seed) {}

  int pick(int least, int greatest) { return std::uniform_int_distribution(least, greatest)(random_); }
  double number(double least, double greatest) { return std::uniform_real_distribution(least, greatest)(random_); }

  // A random event: mostly valid, one in ten with an invalid argument. Power events are rare, because the radar would
  // otherwise be OFF most of the time. TDC releases are frequent, because there would otherwise be few maps.
  InputEvent event() {
    InputEvent event{};
    const int greatest_kind = static_cast<int>(EventKind::navigator_drift);
    event.kind = static_cast<std::uint16_t>(pick(0, 1) == 0 ? 1 : pick(0, greatest_kind + 1));
    if (event.kind == static_cast<std::uint16_t>(EventKind::power) && pick(0, 19) != 0) event.kind = 1;
    if (pick(0, 9) == 0) event.kind = static_cast<std::uint16_t>(EventKind::tdc_release);
    event.argument = static_cast<std::int16_t>(pick(0, 9) == 0 ? pick(-32768, 32767) : argument(event.kind));
    event.x = pick(0, 49) == 0 ? kNaN : event.kind == 2 ? number(-2.0, 2.0) : number(-90.0, 90.0);
    event.y = number(-2.0, 2.0);
    // The last name fills the field without a terminating zero.
    const std::array<std::string_view, 7> names{"1", "1.1", "2", "2.01", "3.", "9", "longer-than-it-is"};
    names[static_cast<std::size_t>(pick(0, 6))].copy(event.text, sizeof event.text);
    return event;
  }

  void disturb(Inputs& around) {
    around.tick += pick(1, 40);
    around.recorder_present = pick(0, 1) == 0;
    around.recorder_writing = around.recorder_present && pick(0, 1) == 0;
    around.recorder_failed = around.recorder_present && !around.recorder_writing && pick(0, 1) == 0;
    around.model.flags = pick(0, 1) == 0 ? databuffer::kModelFrozen : databuffer::kModelScanning;
    // Drifts to the pole and stays about it; beyond, the border refuses the ownship.
    around.ownship.latitude_deg = std::min(90.0, around.ownship.latitude_deg + number(-0.01, 0.012));
    around.ownship.longitude_deg = geo::wrapped_degrees(around.ownship.longitude_deg + number(-0.01, 0.012));
    around.ownship.velocity_east_mps = number(-300.0, 300.0);
    around.ownship.radar_altitude_m = pick(0, 3) == 0 ? kNaN : number(0.0, 500.0);
    if (pick(0, 9) == 0) measure_velocity(around.model);
    if (pick(0, 999) == 0) ++around.epoch;
    if (pick(0, 99) == 0) around.ownship_valid = !around.ownship_valid;
  }

 private:
  // As the model would, and now and then as no model should.
  void measure_velocity(databuffer::ModelStatus& model) {
    ++model.velocity_count;
    model.velocity_north_mps = number(-300.0, 300.0);
    model.velocity_east_mps = pick(0, 19) == 0 ? kNaN : number(-300.0, 300.0);
    model.velocity_down_mps = pick(0, 19) == 0 ? 1e12 : number(-50.0, 50.0);
  }

  int argument(int kind) {
    switch (static_cast<EventKind>(kind)) {
      case EventKind::push_button:
        return pick(1, 20);
      case EventKind::acquisition:
      case EventKind::contrast:
        return pick(0, 1) * 2 - 1;
      case EventKind::elevation_step:
        return pick(-10, 10);
      case EventKind::navigator_error:
      case EventKind::navigator_drift:
        return pick(0, 1);
      case EventKind::radar_mode:
        return pick(0, 7);
      case EventKind::power:
        return pick(0, 4) == 0 ? 0 : pick(1, 2);
      default:
        return pick(-1, 2);
    }
  }
  std::mt19937_64 random_;
};

// A model that completes maps when it likes: mostly the one asked for, now and then one that nobody waits for, and
// seldom one of which no record can be read.
class MapMaker {
 public:
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
    know(pilot);
  }

 private:
  template <std::size_t N>
  static void put_reason(databuffer::ModelStatus& model, const char (&reason)[N]) {
    std::memcpy(model.map_stopped, reason, N);
  }

  // Late, now and then; of ground that it does not know, sometimes; and once in a while of ground that nobody asked
  // for.
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

  // As the shell latches them.
  void know(Pilot& pilot) const {
    const RadarState& state = pilot.state;
    pilot.around.maps = {};
    std::size_t position = 0;
    for (const std::uint64_t id : {state.map_newest, state.map_old, state.map_stored, pilot.around.model.map_newest})
      if (const auto map = made_.find(id); map != made_.end()) pilot.around.maps[position++] = map->second;
  }

  std::map<std::uint64_t, databuffer::PatchMap> made_;
};

template <class Values, class Value>
bool contains(const Values& values, Value value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

void expect_switches_in_their_positions(const RadarState& state) {
  EXPECT_LE(state.power, 2);
  EXPECT_LE(state.gain, 3);
  EXPECT_LE(state.brightness, 15);
  EXPECT_LE(state.contrast, 15);
  EXPECT_LE(state.scan, 2);
  EXPECT_LE(state.cursor_function, 4);
  EXPECT_LE(state.navigator, 1);
  EXPECT_LE(state.band, 4);
  EXPECT_LE(state.points_drawn, 5);
  EXPECT_TRUE(state.channel >= 1 && state.channel <= 8);
  EXPECT_TRUE(std::abs(state.antenna_elevation_deg) <= 60.0);
  EXPECT_TRUE(std::abs(state.tdc_x) <= 1.0 && std::abs(state.tdc_y) <= 1.0);
}

void expect_range_and_window_in_the_tables(const RadarState& state, const radar::RadarConfiguration& configuration) {
  ASSERT_LT(state.range_index, configuration.ranges_nm.size());
  EXPECT_EQ(state.range_nm, configuration.ranges_nm[state.range_index]);
  EXPECT_EQ(state.scan_width_deg, configuration.scan_widths_deg[state.scan]);
  EXPECT_TRUE(state.window_nm == 0.0 || contains(configuration.windows_nm, state.window_nm));
  EXPECT_EQ(state.window_nm == 0.0, state.window_index == 255);
  EXPECT_LE(state.window_nm, state.range_nm);
}

void expect_one_mode(const RadarState& state) {
  using radar::Mode;
  const auto running = static_cast<Mode>(state.resume_mode);
  const bool menu = (state.flags & databuffer::kMenu) != 0;
  EXPECT_EQ(state.mode, menu ? static_cast<std::uint8_t>(Mode::menu) : state.resume_mode);
  const Mode of_master[] = {static_cast<Mode>(state.ground_mode), Mode::air_to_air, Mode::ranging};
  ASSERT_LE(state.master, 2);
  EXPECT_EQ(running, of_master[state.master]);
  EXPECT_TRUE(contains(std::vector{Mode::rbm, Mode::hrm, Mode::patch, Mode::beacon, Mode::pvu}, of_master[0]));
  EXPECT_EQ(databuffer::command_from_state(state).mode, state.resume_mode);
  const bool silent_hrm = (running == Mode::hrm || running == Mode::patch) && (state.flags & databuffer::kSniff) != 0;
  EXPECT_TRUE(!silent_hrm || (state.flags & databuffer::kFreeze) != 0);
}

void expect_maps_in_order(const RadarState& before, const RadarState& state) {
  using radar::Recall;
  const auto has = [&state](std::uint32_t flag) { return (state.flags & flag) != 0; };
  const bool frozen = has(databuffer::kFreeze);
  const std::uint64_t recalled[] = {0, state.map_newest, state.map_old, state.map_stored};
  ASSERT_LE(state.recall, 3);
  const bool recalls = state.recall != static_cast<std::uint8_t>(Recall::none);
  const bool patch = state.ground_mode == static_cast<std::uint8_t>(radar::Mode::patch);
  EXPECT_EQ(state.map_shown, recalls ? recalled[state.recall] : patch ? state.map_newest : 0U);
  EXPECT_TRUE(!patch || state.map_shown != 0) << "a patch without a map cannot occur";
  EXPECT_TRUE(!recalls || (frozen && state.map_shown != 0));
  EXPECT_TRUE(state.map_stored == 0 || frozen);
  EXPECT_TRUE(state.map_newest >= state.map_old && state.map_newest >= state.map_stored);
  EXPECT_TRUE(state.map_old != state.map_newest || state.map_old == 0);
  EXPECT_TRUE(state.map_newest >= before.map_newest || state.power == 0) << "maps are forgotten by power off alone";
  EXPECT_GE(state.map_request, before.map_request);
}

void expect_a_map_forms_only_where_it_can(const RadarState& state) {
  using radar::Mode;
  if ((state.flags & databuffer::kMapping) == 0) return;
  EXPECT_EQ(state.power, static_cast<std::uint8_t>(radar::Power::operate));
  EXPECT_TRUE(
      contains(std::vector{Mode::rbm, Mode::hrm, Mode::patch, Mode::pvu}, static_cast<Mode>(state.resume_mode)));
  EXPECT_EQ(state.flags & databuffer::kSniff, 0U);
  EXPECT_GT(state.map_window_nm, 0.0);
  EXPECT_GT(state.map_request, 0U);
}

void expect_set_over_a_frozen_map(const RadarState& state) {
  const bool set = (state.flags & databuffer::kSet) != 0;
  const bool frozen = (state.flags & databuffer::kFreeze) != 0;
  EXPECT_TRUE(!set || (frozen && state.map_shown != 0));
  EXPECT_TRUE(!set || state.cursor_function != static_cast<std::uint8_t>(radar::CursorFunction::map));
  const bool by_exit = (state.flags & databuffer::kFrozenByHrmExit) != 0;
  EXPECT_TRUE(!by_exit || (frozen && (state.master != 0 || set)));
}

void expect_designations_as_the_functions_leave_them(const RadarState& state) {
  using databuffer::SteeringLine;
  const auto has = [&state](std::uint32_t flag) { return (state.flags & flag) != 0; };
  const auto function = static_cast<radar::CursorFunction>(state.cursor_function);
  const auto line = static_cast<SteeringLine>(state.steering_line);
  EXPECT_EQ(line != SteeringLine::none, has(databuffer::kTargetDesignated));
  EXPECT_TRUE(line != SteeringLine::slewing || function == radar::CursorFunction::target) << "the TDC is kept";
  EXPECT_EQ(state.target_name[0] != '\0', has(databuffer::kTargetDesignated));
  EXPECT_LE(state.mark_count, databuffer::kMarks);
  EXPECT_TRUE(!has(databuffer::kUpdateInvalid) || state.update_seconds == 0);
  EXPECT_TRUE(state.update_seconds >= -1 && state.update_seconds <= 30);
}

void expect_text_terminated_and_numbers_finite(const RadarState& state) {
  for (const auto& legend : state.legends) EXPECT_NE(std::memchr(legend, 0, sizeof legend), nullptr);
  EXPECT_NE(std::memchr(state.sequence_point, 0, sizeof state.sequence_point), nullptr);
  EXPECT_NE(std::memchr(state.message, 0, sizeof state.message), nullptr);
  for (const double value : {state.cursor_latitude_deg, state.cursor_longitude_deg, state.cursor_bearing_deg,
                             state.cursor_range_nm, state.frame_latitude_deg, state.frame_track_deg})
    EXPECT_TRUE(std::isfinite(value));
  EXPECT_TRUE(state.cursor_bearing_deg >= 0.0 && state.cursor_bearing_deg < 360.0);
}

// A box is around a legend that is there.
void expect_boxes_around_legends(const RadarState& state) {
  EXPECT_EQ(state.boxed >> 21, 0U);
  for (int button = 0; button <= 20; ++button) {
    const bool boxed = (state.boxed >> button & 1U) != 0;
    EXPECT_TRUE(!boxed || state.legends[button][0] != '\0') << button;
  }
}

// From any state, a pilot can return to a running real beam map.
void expect_a_way_out(Pilot pilot) {
  pilot.around.ownship_valid = true;
  pilot.send("power opr");
  pilot.press("mode ag");
  if (pilot.is(databuffer::kMenu)) pilot.press("pb 6");
  if (pilot.is(databuffer::kSet)) pilot.press("pb 18");
  if (pilot.is(databuffer::kSniff)) pilot.press("pb 18");
  if (pilot.is(databuffer::kFreeze)) pilot.press("freeze");
  pilot.press("radar rbm");
  if (pilot.state.steering_line == static_cast<std::uint8_t>(databuffer::SteeringLine::slewing)) {
    EXPECT_TRUE(pilot.press("acq fwd")) << "a line that slews can always be given up";
  }
  EXPECT_EQ(fields_of(pilot).at("mode"), "RBM");
  EXPECT_EQ(fields_of(pilot).at("freeze"), "false");
  EXPECT_EQ(fields_of(pilot).at("sniff"), "false");
}

// Of the APG-70 when `file` is empty. The route is the pilot's.
Pilot pilot_of(const std::string& file) {
  Pilot pilot;
  if (file.empty()) return pilot;
  auto loaded = config::load_configuration(std::string(YARS_SOURCE_DIR) + "/config/" + file);
  EXPECT_TRUE(loaded) << file;
  if (!loaded) return pilot;
  loaded->radar.route = pilot.configuration.route;
  pilot.configuration = std::move(loaded->radar);
  pilot.state = initial_state(pilot.configuration);
  return pilot;
}

class RandomEvents : public ::testing::TestWithParam<RandomRun> {};

TEST_P(RandomEvents, KeepsEveryInvariantAndNeverWedges) {
  const int events = GetParam().events;
  const std::uint64_t seed = random_seed();
  SCOPED_TRACE("YARS_SEED=" + std::to_string(seed));
  EventGenerator generator(seed);
  Pilot pilot = pilot_of(GetParam().file);
  MapMaker model;
  int dead = 0;
  int patches = 0, targets = 0, updates = 0;
  for (int count = 0; count < events && !::testing::Test::HasFailure(); ++count) {
    const RadarState before = pilot.state;
    const InputEvent event = generator.event();
    SCOPED_TRACE("event " + std::to_string(count) + ": " + databuffer::text_of(event));
    const Effect effect = apply(pilot.state, event, pilot.around, pilot.configuration);
    const bool did = effect != Effect::none;
    // A refused event shows a message, which may be shown already.
    if (effect != Effect::refused) {
      ASSERT_EQ(did, std::memcmp(&before, &pilot.state, sizeof before) != 0);
    }
    dead += did ? 0 : 1;
    generator.disturb(pilot.around);
    model.disturb(generator, pilot);
    advance(pilot.state, pilot.around, pilot.configuration);

    expect_switches_in_their_positions(pilot.state);
    expect_range_and_window_in_the_tables(pilot.state, pilot.configuration);
    expect_one_mode(pilot.state);
    expect_maps_in_order(before, pilot.state);
    expect_a_map_forms_only_where_it_can(pilot.state);
    expect_set_over_a_frozen_map(pilot.state);
    expect_designations_as_the_functions_leave_them(pilot.state);
    targets += did && pilot.state.target_count != before.target_count ? 1 : 0;
    updates += did && event.kind == static_cast<std::uint16_t>(EventKind::tdc_release) &&
                       (before.flags & databuffer::kUpdateShown) != 0
                   ? 1
                   : 0;
    patches += pilot.state.map_shown != 0 ? 1 : 0;
    expect_text_terminated_and_numbers_finite(pilot.state);
    expect_boxes_around_legends(pilot.state);
    // A restarted state machine resumes only a state that passes validation.
    EXPECT_EQ(databuffer::validate(pilot.state).value_or(""), "");
    if (count % 100 == 0) expect_a_way_out(pilot);
  }
  // A run with only dead events, or with none, would test little.
  EXPECT_GT(dead, events / 10);
  EXPECT_LT(dead, events * 9 / 10);
  // In a million events a map is shown after one in 6 and one in 530 designates a target. A run may stay for tens of
  // thousands of events in states without maps, so short runs differ by a factor of ten.
  EXPECT_GT(patches, events / 100);
  EXPECT_GT(targets, events / 5000);
  EXPECT_GT(updates, events / 1000);
}

INSTANTIATE_TEST_SUITE_P(OfEachRadar, RandomEvents,
                         ::testing::Values(RandomRun{"", 1'000'000}, RandomRun{"apg68.guf", 400'000}),
                         [](const auto& run) { return std::string(run.index == 0 ? "Apg70" : "Apg68"); });

// A cursor on its ground point may leave the display. A slewed cursor stays on it.
TEST(RandomCursor, ASlewedCursorIsOnTheDisplay) {
  const std::uint64_t seed = random_seed();
  SCOPED_TRACE("YARS_SEED=" + std::to_string(seed));
  EventGenerator generator(seed);
  Pilot pilot;
  pilot.press("power opr");
  for (int count = 0; count < 20'000 && !::testing::Test::HasFailure(); ++count) {
    generator.disturb(pilot.around);
    pilot.around.ownship_valid = true;
    pilot.around.model.flags = 0;
    if (generator.pick(0, 9) == 0) pilot.send(generator.pick(0, 1) == 0 ? "pb 13" : "pb 14");
    if (generator.pick(0, 9) == 0) pilot.send("pb 17");
    InputEvent tdc{};
    tdc.kind = static_cast<std::uint16_t>(EventKind::tdc);
    tdc.x = generator.number(0.01, 1.0);
    tdc.y = generator.number(-1.0, 1.0);
    apply(pilot.state, tdc, pilot.around, pilot.configuration);
    advance(pilot.state, pilot.around, pilot.configuration);

    const auto inverse = geo::geodesic_inverse({pilot.state.frame_latitude_deg, pilot.state.frame_longitude_deg},
                                               {pilot.state.cursor_latitude_deg, pilot.state.cursor_longitude_deg});
    const double angle_rad =
        (inverse.azimuth_at_start.degrees() - pilot.state.frame_track_deg) * geo::kRadiansPerDegree;
    const double radius = inverse.distance.nautical_miles() / pilot.state.range_nm;
    constexpr double kRounding = 1e-9;
    EXPECT_LE(std::abs(radius * std::sin(angle_rad)), 0.6 + kRounding);
    EXPECT_LE(radius * std::cos(angle_rad), 1.1 + kRounding);
    EXPECT_GE(radius * std::cos(angle_rad), -0.1 - kRounding);
  }
}

}  // namespace
}  // namespace yars::statemachine::testing
