// Random events: the state keeps its invariants after each event, and can always return to a running real beam map.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <ostream>
#include <random>
#include <string>
#include <utility>

#include "config/schema/load.hpp"
#include "databuffer/messages/derived_values.hpp"
#include "databuffer/messages/validation.hpp"
#include "tests/statemachine/pilot.hpp"
#include "tests/statemachine/property/random_inputs.hpp"

namespace yars::statemachine::testing {
namespace {

using databuffer::EventKind;
using databuffer::InputEvent;
using databuffer::RadarState;

struct RandomRun {
  const char* file;  // configuration file in config/; empty: the built-in APG-70
  int events;
  // Text of the parameter in test output. By default, gtest prints the pointer's bytes, which differ in each run.
  friend void PrintTo(const RandomRun& run, std::ostream* out) {
    *out << (*run.file == '\0' ? "built-in" : run.file) << ", " << run.events << " events";
  }
};

// Seed of the random events. YARS_SEED repeats a failed run.
std::uint64_t random_seed() {
  const char* given = std::getenv("YARS_SEED");
  return given ? std::strtoull(given, nullptr, 10) : std::random_device{}();
}

template <class Values, class Value>
bool contains(const Values& values, Value value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

void expect_switches_within_their_positions(const RadarState& state) {
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

void expect_consistent_modes(const RadarState& state) {
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
  EXPECT_TRUE(!patch || state.map_shown != 0) << "the patch display needs a map";
  EXPECT_TRUE(!recalls || (frozen && state.map_shown != 0));
  EXPECT_TRUE(state.map_stored == 0 || frozen);
  EXPECT_TRUE(state.map_newest >= state.map_old && state.map_newest >= state.map_stored);
  EXPECT_TRUE(state.map_old != state.map_newest || state.map_old == 0);
  EXPECT_TRUE(state.map_newest >= before.map_newest || state.power == 0) << "only power off forgets maps";
  EXPECT_GE(state.map_request, before.map_request);
}

void expect_mapping_only_where_allowed(const RadarState& state) {
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

void expect_consistent_designations(const RadarState& state) {
  using databuffer::SteeringLine;
  const auto has = [&state](std::uint32_t flag) { return (state.flags & flag) != 0; };
  const auto function = static_cast<radar::CursorFunction>(state.cursor_function);
  const auto line = static_cast<SteeringLine>(state.steering_line);
  EXPECT_EQ(line != SteeringLine::none, has(databuffer::kTargetDesignated));
  EXPECT_TRUE(line != SteeringLine::slewing || function == radar::CursorFunction::target) << "only TGT slews the line";
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

// Only a button with a legend is boxed.
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
    EXPECT_TRUE(pilot.press("acq fwd")) << "slewing of the line can always be cancelled";
  }
  EXPECT_EQ(fields_of(pilot).at("mode"), "RBM");
  EXPECT_EQ(fields_of(pilot).at("freeze"), "false");
  EXPECT_EQ(fields_of(pilot).at("sniff"), "false");
}

// A pilot of the configuration `file`, or of the built-in APG-70 if `file` is empty. The route is always that of Pilot.
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

TEST_P(RandomEvents, KeepEveryInvariantAndAllowTheReturnToARunningRbm) {
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
    const bool changed = std::memcmp(&before, &pilot.state, sizeof before) != 0;
    // A refused event shows a message. If the message is already shown, the state stays the same. A press of the TDC
    // acts on release; `next` is for a tour.
    if (event.kind == static_cast<std::uint16_t>(EventKind::tdc_press) ||
        event.kind == static_cast<std::uint16_t>(EventKind::next)) {
      ASSERT_FALSE(changed);
    } else if (effect != Effect::refused) {
      ASSERT_EQ(did, changed);
    }
    dead += did ? 0 : 1;
    generator.disturb(pilot.around);
    model.disturb(generator, pilot);
    advance(pilot.state, pilot.around, pilot.configuration);

    expect_switches_within_their_positions(pilot.state);
    expect_range_and_window_in_the_tables(pilot.state, pilot.configuration);
    expect_consistent_modes(pilot.state);
    expect_maps_in_order(before, pilot.state);
    expect_mapping_only_where_allowed(pilot.state);
    expect_set_over_a_frozen_map(pilot.state);
    expect_consistent_designations(pilot.state);
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
  // Measured over a million events: a map is shown after 1 event in 6, and 1 event in 530 designates a target. A run
  // may stay for tens of thousands of events in states without maps. The counts of short runs therefore vary by a
  // factor of 10.
  EXPECT_GT(patches, events / 100);
  EXPECT_GT(targets, events / 5000);
  EXPECT_GT(updates, events / 1000);
}

INSTANTIATE_TEST_SUITE_P(OfEachRadar, RandomEvents,
                         ::testing::Values(RandomRun{"", 150'000}, RandomRun{"apg68.guf", 100'000},
                                           RandomRun{"", 500'000}),
                         [](const auto& run) {
                           return std::string(run.index == 0 ? "Apg70" : run.index == 1 ? "Apg68" : "Apg70ForLong");
                         });

// A cursor at rest may leave the display, because it stays on its ground point. A slewed cursor stays on the display.
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
