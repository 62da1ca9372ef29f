// Tests of validate(), which checks records at the trust boundary. It returns the first fault as text, or nullopt.
#include "databuffer/messages/validation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "databuffer/messages/inspection.hpp"

namespace yars::databuffer {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDenormal = std::numeric_limits<double>::denorm_min();

Ownship good_ownship() {
  Ownship ownship{};
  ownship.latitude_deg = 38.0;
  ownship.longitude_deg = -123.1;
  ownship.altitude_msl_m = 4572.0;
  ownship.heading_deg = 160.0;
  ownship.velocity_north_mps = 200.0;
  ownship.radar_altitude_m = kNan;
  std::strcpy(ownship.source, "route");
  return ownship;
}

Nav good_nav() {
  Nav nav{};
  nav.mission_latitude_deg = nav.ins_latitude_deg = 38.0;
  nav.mission_longitude_deg = nav.ins_longitude_deg = -123.1;
  nav.magnetic_variation_deg = kNan;
  return nav;
}

RadarState good_state() {
  RadarState state{};
  state.range_nm = 40.0;
  state.scan_width_deg = 100.0;
  state.window_nm = 4.7;
  state.channel = 1;
  state.cursor_elevation_m = kNan;
  state.flags = kCursorValid;
  return state;
}

ClockState last_valid_clock() {
  ClockState clock{};
  clock.rate = 1.0;
  clock.running = 1;
  clock.reposition_latitude_deg = clock.reposition_longitude_deg = kNan;
  clock.reposition_altitude_m = clock.reposition_heading_deg = kNan;
  return clock;
}

InputEvent event_of(EventKind kind, int argument, double x = 0.0, double y = 0.0) {
  InputEvent event{};
  event.kind = static_cast<std::uint16_t>(kind);
  event.argument = static_cast<std::int16_t>(argument);
  event.x = x;
  event.y = y;
  return event;
}

template <class Record>
bool accepts(Record record, double Record::* field, double value) {
  record.*field = value;
  return !validate(record);
}

// Expects that validation accepts both ends of the range, and refuses the next numbers beyond them and infinity.
template <class Record>
void expect_range(const Record& good, double Record::* field, double least, double most) {
  EXPECT_TRUE(accepts(good, field, least)) << least;
  EXPECT_TRUE(accepts(good, field, most)) << most;
  EXPECT_TRUE(accepts(good, field, least + kDenormal));
  EXPECT_FALSE(accepts(good, field, std::nextafter(least, -kInfinity))) << least;
  EXPECT_FALSE(accepts(good, field, std::nextafter(most, kInfinity))) << most;
  EXPECT_FALSE(accepts(good, field, kInfinity));
  EXPECT_FALSE(accepts(good, field, -kInfinity));
}

template <class Record>
void expect_range_without_nan(const Record& good, double Record::* field, double least, double most) {
  expect_range(good, field, least, most);
  EXPECT_FALSE(accepts(good, field, kNan));
  EXPECT_FALSE(accepts(good, field, -kNan));
}

TEST(Validation, GoodRecordsPass) {
  EXPECT_EQ(validate(good_ownship()), std::nullopt);
  EXPECT_EQ(validate(good_nav()), std::nullopt);
  EXPECT_EQ(validate(good_state()), std::nullopt);
  EXPECT_EQ(validate(last_valid_clock()), std::nullopt);
  EXPECT_EQ(validate(event_of(EventKind::freeze, 0)), std::nullopt);
}

TEST(Validation, OwnshipRangesAreChecked) {
  expect_range_without_nan(good_ownship(), &Ownship::latitude_deg, -90.0, 90.0);
  expect_range_without_nan(good_ownship(), &Ownship::longitude_deg, -180.0, 180.0);
  expect_range_without_nan(good_ownship(), &Ownship::altitude_msl_m, -1'000.0, 200'000.0);
  expect_range_without_nan(good_ownship(), &Ownship::heading_deg, 0.0, 360.0);
  expect_range_without_nan(good_ownship(), &Ownship::pitch_deg, -90.0, 90.0);
  expect_range_without_nan(good_ownship(), &Ownship::roll_deg, -180.0, 180.0);
  for (auto field : {&Ownship::velocity_north_mps, &Ownship::velocity_east_mps, &Ownship::velocity_down_mps})
    expect_range_without_nan(good_ownship(), field, -10'000.0, 10'000.0);
  expect_range(good_ownship(), &Ownship::radar_altitude_m, 0.0, 200'000.0);
}

TEST(Validation, DenormalsAndMinusZeroAreNumbers) {
  EXPECT_TRUE(accepts(good_ownship(), &Ownship::latitude_deg, kDenormal));
  EXPECT_TRUE(accepts(good_ownship(), &Ownship::velocity_down_mps, -kDenormal));
  EXPECT_TRUE(accepts(good_ownship(), &Ownship::heading_deg, -0.0));
  EXPECT_FALSE(accepts(good_ownship(), &Ownship::heading_deg, -kDenormal));
}

TEST(Validation, AMissingRadarAltimeterIsNoFault) {
  EXPECT_TRUE(accepts(good_ownship(), &Ownship::radar_altitude_m, kNan));
}

TEST(Validation, TheFirstFaultIsNamedWithRangeAndValue) {
  Ownship ownship = good_ownship();
  ownship.latitude_deg = 91.5;
  EXPECT_EQ(validate(ownship), "latitude_deg: expected [-90, 90], found 91.5");
  ownship.heading_deg = kNan;
  EXPECT_EQ(validate(ownship), "latitude_deg: expected [-90, 90], found 91.5");
}

TEST(Validation, ATextWithoutATerminatingZeroIsRefused) {
  Ownship ownship = good_ownship();
  std::memset(ownship.source, 'x', sizeof ownship.source);
  EXPECT_THAT(validate(ownship).value_or(""), HasSubstr("source: expected a zero at its end"));
}

TEST(Validation, ControlCharactersAreRefused) {
  Ownship ownship = good_ownship();
  std::strcpy(ownship.source, "\x1b[2J");
  EXPECT_THAT(validate(ownship).value_or(""), HasSubstr("printable"));
}

TEST(Validation, NavRangesAreChecked) {
  for (auto field : {&Nav::mission_latitude_deg, &Nav::ins_latitude_deg})
    expect_range_without_nan(good_nav(), field, -90.0, 90.0);
  for (auto field : {&Nav::mission_longitude_deg, &Nav::ins_longitude_deg})
    expect_range_without_nan(good_nav(), field, -180.0, 180.0);
  for (auto field : {&Nav::velocity_north_mps, &Nav::velocity_east_mps, &Nav::velocity_down_mps})
    expect_range_without_nan(good_nav(), field, -10'000.0, 10'000.0);
  expect_range(good_nav(), &Nav::magnetic_variation_deg, -180.0, 180.0);
  EXPECT_TRUE(accepts(good_nav(), &Nav::magnetic_variation_deg, kNan));
}

TEST(Validation, RadarStateRangesAreChecked) {
  expect_range_without_nan(good_state(), &RadarState::antenna_elevation_deg, -60.0, 60.0);
  expect_range_without_nan(good_state(), &RadarState::tdc_x, -1.0, 1.0);
  expect_range_without_nan(good_state(), &RadarState::tdc_y, -1.0, 1.0);
  expect_range_without_nan(good_state(), &RadarState::scan_width_deg, 0.0, 360.0);
  expect_range_without_nan(good_state(), &RadarState::cursor_latitude_deg, -90.0, 90.0);
  expect_range_without_nan(good_state(), &RadarState::cursor_longitude_deg, -180.0, 180.0);
  expect_range_without_nan(good_state(), &RadarState::cursor_bearing_deg, 0.0, 360.0);
  expect_range_without_nan(good_state(), &RadarState::cursor_believed_latitude_deg, -90.0, 90.0);
  expect_range_without_nan(good_state(), &RadarState::cursor_believed_longitude_deg, -180.0, 180.0);
  expect_range_without_nan(good_state(), &RadarState::frame_latitude_deg, -90.0, 90.0);
  expect_range_without_nan(good_state(), &RadarState::frame_longitude_deg, -180.0, 180.0);
  expect_range_without_nan(good_state(), &RadarState::frame_track_deg, 0.0, 360.0);
  EXPECT_FALSE(accepts(good_state(), &RadarState::range_nm, kNan));
  EXPECT_FALSE(accepts(good_state(), &RadarState::window_nm, kInfinity));
}

TEST(Validation, WithoutAValidCursorItsPositionMayBeMissing) {
  RadarState state = good_state();
  state.cursor_latitude_deg = kNan;
  EXPECT_TRUE(validate(state));
  state.flags = 0;
  EXPECT_EQ(validate(state), std::nullopt);
}

TEST(Validation, EachSwitchIsLimitedToItsPositions) {
  struct Switch {
    std::uint8_t RadarState::* field;
    int least, most;
  };
  for (const Switch& position :
       {Switch{&RadarState::power, 0, 2}, Switch{&RadarState::mode, 0, 7}, Switch{&RadarState::master, 0, 2},
        Switch{&RadarState::scan, 0, 2}, Switch{&RadarState::gain, 0, 3}, Switch{&RadarState::brightness, 0, 15},
        Switch{&RadarState::contrast, 0, 15}, Switch{&RadarState::cursor_function, 0, 4},
        Switch{&RadarState::navigator, 0, 1}, Switch{&RadarState::channel, 1, 8}, Switch{&RadarState::band, 0, 4},
        Switch{&RadarState::points_drawn, 0, radar::kMaxPointsDrawn}, Switch{&RadarState::recall, 0, 3}}) {
    for (int value = 0; value < 256; ++value) {
      RadarState state = good_state();
      state.*position.field = static_cast<std::uint8_t>(value);
      EXPECT_EQ(!validate(state), value >= position.least && value <= position.most) << value;
    }
  }
}

TEST(Validation, OnlyDrawnPointsAreChecked) {
  RadarState state = good_state();
  state.points[0].latitude_deg = 91.0;
  EXPECT_EQ(validate(state), std::nullopt);
  state.points_drawn = 1;
  EXPECT_TRUE(validate(state));
}

TEST(Validation, LegendsAndMessageEndWithZero) {
  RadarState state = good_state();
  std::memset(state.legends[20], 'A', sizeof state.legends[20]);
  EXPECT_TRUE(validate(state));
  state = good_state();
  std::memset(state.message, 'A', sizeof state.message);
  EXPECT_TRUE(validate(state));
}

TEST(Validation, EventArgumentsAreChecked) {
  EXPECT_TRUE(validate(event_of(EventKind::none, 0)));
  EXPECT_TRUE(validate(event_of(static_cast<EventKind>(static_cast<int>(EventKind::cursor) + 1), 0)));
  for (int argument = -300; argument <= 300; ++argument) {
    const auto valid = [argument](EventKind kind) { return !validate(event_of(kind, argument)); };
    EXPECT_EQ(valid(EventKind::push_button), argument >= 1 && argument <= 20);
    EXPECT_EQ(valid(EventKind::acquisition), argument == 1 || argument == -1);
    EXPECT_EQ(valid(EventKind::contrast), argument == 1 || argument == -1);
    EXPECT_EQ(valid(EventKind::elevation_step), argument != 0 && std::abs(argument) <= 240);
    EXPECT_EQ(valid(EventKind::master_mode), argument >= 0 && argument <= 2);
    EXPECT_EQ(valid(EventKind::radar_mode), argument == 0 || argument == 1 || argument == 3 || argument == 4);
    EXPECT_EQ(valid(EventKind::power), argument >= 0 && argument <= 2);
    EXPECT_EQ(valid(EventKind::navigator), argument >= -1 && argument <= 1);
    EXPECT_EQ(valid(EventKind::altimeter), argument == 0 || argument == 1);
  }
}

TEST(Validation, TdcAndElevationAreFiniteAndInRange) {
  expect_range_without_nan(event_of(EventKind::tdc, 0), &InputEvent::x, -1.0, 1.0);
  expect_range_without_nan(event_of(EventKind::tdc, 0), &InputEvent::y, -1.0, 1.0);
  expect_range_without_nan(event_of(EventKind::elevation, 0), &InputEvent::x, -60.0, 60.0);
}

TEST(Validation, InjectedErrorsAreLimitedAndNameANavigator) {
  expect_range_without_nan(event_of(EventKind::navigator_error, 1), &InputEvent::x, -600'000.0, 600'000.0);
  expect_range_without_nan(event_of(EventKind::navigator_error, 1), &InputEvent::y, -600'000.0, 600'000.0);
  expect_range_without_nan(event_of(EventKind::navigator_drift, 0), &InputEvent::x, -1'000.0, 1'000.0);
  expect_range_without_nan(event_of(EventKind::navigator_drift, 0), &InputEvent::y, -1'000.0, 1'000.0);
  EXPECT_TRUE(validate(event_of(EventKind::navigator_error, 2)));
  EXPECT_TRUE(validate(event_of(EventKind::navigator_drift, -1)));
}

TEST(Validation, DesignationsAreChecked) {
  const auto refused = [](const auto& change) {
    RadarState state = good_state();
    change(state);
    return validate(state).has_value();
  };
  EXPECT_FALSE(refused([](RadarState& state) { state.target_elevation_m = kNan; })) << "an unknown elevation is valid";
  EXPECT_TRUE(refused([](RadarState& state) { state.target_latitude_deg = 91.0; }));
  EXPECT_TRUE(refused([](RadarState& state) { std::memset(state.target_name, 'A', sizeof state.target_name); }));
  EXPECT_TRUE(refused([](RadarState& state) { state.cue_longitude_deg = kNan; }));
  EXPECT_TRUE(refused([](RadarState& state) { state.mission.north_m = kNan; }));
  EXPECT_TRUE(refused([](RadarState& state) { state.ins.velocity_down_mps = 1e9; }));
  EXPECT_TRUE(refused([](RadarState& state) { state.steering_line = 4; }));
  EXPECT_TRUE(refused([](RadarState& state) { state.steering_line_deg = -1.0; }));
  EXPECT_TRUE(refused([](RadarState& state) { state.mark_count = kMarks + 1; }));
  EXPECT_FALSE(refused([](RadarState& state) { state.marks[0].latitude_deg = 91.0; })) << "the entry is not in use";
  EXPECT_TRUE(refused([](RadarState& state) {
    state.mark_count = 1;
    state.marks[0].latitude_deg = 91.0;
  }));
}

TEST(Validation, RecorderStatusIsChecked) {
  RecorderStatus status{};
  EXPECT_EQ(validate(status), std::nullopt);
  status.writing = 2;
  EXPECT_TRUE(validate(status));
  status = {};
  std::memset(status.problem, 'A', sizeof status.problem);
  EXPECT_TRUE(validate(status));
}

TEST(Validation, CaptionsAreChecked) {
  const auto is_refused = [](auto change) {
    Caption caption{};
    EXPECT_EQ(validate(caption), std::nullopt);
    change(caption);
    return validate(caption).has_value();
  };
  EXPECT_TRUE(is_refused([](Caption& caption) { caption.step = kMaxCaptions + 1; }));
  EXPECT_TRUE(is_refused([](Caption& caption) { caption.step = 1; })) << "caption 1 of 0";
  EXPECT_TRUE(is_refused([](Caption& caption) { caption.waiting = 2; }));
  EXPECT_TRUE(is_refused([](Caption& caption) { caption.sim_time_ns = -1; }));
  EXPECT_TRUE(is_refused([](Caption& caption) { std::strcpy(caption.lines[2].text, "\x1b[2J"); }));
  EXPECT_TRUE(is_refused([](Caption& caption) {
    std::memset(caption.lines[2].text, 'A', sizeof caption.lines[2].text);
  })) << "without a zero at its end";
}

TEST(Validation, TextsOfTheAdviceArePrintableAndEnd) {
  PilotAdvice advice{};
  EXPECT_EQ(validate(advice), std::nullopt);
  std::strcpy(advice.buttons[20], "longer range: 80 NM");
  EXPECT_EQ(validate(advice), std::nullopt);
  advice.buttons[20][3] = '\x1b';
  EXPECT_TRUE(validate(advice));
  advice = {};
  std::memset(advice.remedy, 'A', sizeof advice.remedy);
  EXPECT_TRUE(validate(advice));
}

TEST(Validation, ASequencePointNeedsAName) {
  InputEvent event = event_of(EventKind::sequence_point, 0);
  EXPECT_TRUE(validate(event));
  std::strcpy(event.text, "100.99");
  EXPECT_EQ(validate(event), std::nullopt);
  std::memset(event.text, '1', sizeof event.text);
  EXPECT_TRUE(validate(event));
}

TEST(Validation, ClockRangesAreChecked) {
  expect_range_without_nan(last_valid_clock(), &ClockState::rate, 0.0, kMaxClockRate);
  ClockState clock = last_valid_clock();
  clock.running = 2;
  EXPECT_TRUE(validate(clock));
  clock = last_valid_clock();
  clock.base_sim_ns = -1;
  EXPECT_TRUE(validate(clock));
}

TEST(Validation, ARepositioningNeedsAllItsValues) {
  ClockState clock = last_valid_clock();
  clock.reposition_heading_deg = 1e9;
  EXPECT_EQ(validate(clock), std::nullopt);
  clock.reposition_latitude_deg = 38.0;
  EXPECT_TRUE(validate(clock));
  clock.reposition_longitude_deg = -180.0;
  clock.reposition_altitude_m = 4572.0;
  clock.reposition_heading_deg = 360.0;
  EXPECT_EQ(validate(clock), std::nullopt);
  clock.reposition_heading_deg = 361.0;
  EXPECT_TRUE(validate(clock));
}

PatchMap good_map() {
  PatchMap map{};
  map.id = 1;
  map.size = 480;
  map.latitude_deg = 38.0;
  map.longitude_deg = -123.1;
  map.window_nm = 0.67;
  map.apex_latitude_deg = 38.2;
  map.apex_longitude_deg = -123.1;
  map.apex_altitude_msl_m = 4572.0;
  map.distance_m = 20'000.0;
  return map;
}

TEST(Validation, OnlyUsedEntitiesOfTrafficAreChecked) {
  Traffic traffic{};
  traffic.count = 2;
  EXPECT_EQ(validate(traffic), std::nullopt);
  traffic.entities[2].latitude_deg = 100.0;
  EXPECT_EQ(validate(traffic), std::nullopt) << "the entity is not in use";
  traffic.entities[1].velocity_east_mps = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(validate(traffic), "entities.velocity_east_mps: expected [-10000, 10000], found nan");
  traffic = Traffic{};
  traffic.count = 65;
  EXPECT_EQ(validate(traffic), "count: expected [0, 64], found 65");
}

TEST(Validation, TicksAndTimesArePositiveAndLeaveRoomForSums) {
  const auto is_refused = [](auto record, auto field, std::int64_t value) {
    record.*field = value;
    return validate(record).has_value();
  };
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t wrong : {kLeast, kMost}) {
    EXPECT_TRUE(is_refused(good_map(), &PatchMap::start_tick, wrong));
    EXPECT_TRUE(is_refused(good_map(), &PatchMap::end_tick, wrong));
    EXPECT_TRUE(is_refused(Outputs{}, &Outputs::tick, wrong));
    EXPECT_TRUE(is_refused(Outputs{}, &Outputs::sim_time_ns, wrong));
    EXPECT_TRUE(is_refused(RecorderStatus{}, &RecorderStatus::tick, wrong));
    EXPECT_TRUE(is_refused(RecorderStatus{}, &RecorderStatus::sim_time_ns, wrong));
    EXPECT_TRUE(is_refused(Traffic{}, &Traffic::tick, wrong));
    EXPECT_TRUE(is_refused(event_of(EventKind::freeze, 0), &InputEvent::session_time_ns, wrong));
    EXPECT_TRUE(is_refused(event_of(EventKind::freeze, 0), &InputEvent::monotonic_ns, wrong));
    GlassFrame frame{};
    frame.width = frame.height = 1;
    EXPECT_TRUE(is_refused(frame, &GlassFrame::tick, wrong));
    EXPECT_TRUE(is_refused(frame, &GlassFrame::sim_time_ns, wrong));
  }
  RadarState state = good_state();
  state.mark_count = 1;
  state.marks[0].sim_time_ns = -1;
  EXPECT_TRUE(validate(state));
}

ModelTick good_tick() {
  ModelTick tick{};
  tick.ownship = good_ownship();
  tick.command.channel = 1;
  return tick;
}

// Expects a range of a number of the command in a tick.
void expect_command_range(double RadarCommand::* field, double least, double most) {
  const auto is_valid = [field](double value) {
    ModelTick tick = good_tick();
    tick.command.flags = kCursorValid;
    tick.command.*field = value;
    return !validate(tick);
  };
  EXPECT_TRUE(is_valid(least) && is_valid(most));
  for (const double wrong : {std::nextafter(least, -kInfinity), std::nextafter(most, kInfinity), kNan})
    EXPECT_FALSE(is_valid(wrong)) << wrong;
}

TEST(Validation, ATickIsRefusedForAnyFieldOfItsCommand) {
  EXPECT_EQ(validate(ModelTick{}), std::nullopt) << "before a radar state has arrived";
  EXPECT_EQ(validate(good_tick()), std::nullopt);
  expect_command_range(&RadarCommand::range_nm, 0.0, kMaxRange_nm);
  expect_command_range(&RadarCommand::window_nm, 0.0, kMaxRange_nm);
  expect_command_range(&RadarCommand::cursor_latitude_deg, -90.0, 90.0);
  expect_command_range(&RadarCommand::cursor_longitude_deg, -180.0, 180.0);
  expect_command_range(&RadarCommand::map_latitude_deg, -90.0, 90.0);
  expect_command_range(&RadarCommand::map_longitude_deg, -180.0, 180.0);
  ModelTick tick = good_tick();
  tick.command.map_window_nm = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(validate(tick), "command.map_window_nm: expected [0, 10800], found nan");
  tick = good_tick();
  tick.command.cursor_latitude_deg = kNan;
  EXPECT_EQ(validate(tick), std::nullopt) << "without kCursorValid";
  struct Switch {
    std::uint8_t RadarCommand::* field;
    int most;
  };
  for (const Switch& position :
       {Switch{&RadarCommand::power, 2}, Switch{&RadarCommand::mode, 7}, Switch{&RadarCommand::scan, 2},
        Switch{&RadarCommand::gain, 3}, Switch{&RadarCommand::range_index, 15}, Switch{&RadarCommand::channel, 8},
        Switch{&RadarCommand::band, 4}})
    for (int value = 0; value < 256; ++value) {
      tick = good_tick();
      tick.command.*position.field = static_cast<std::uint8_t>(value);
      EXPECT_EQ(!validate(tick), value <= position.most) << value;
    }
}

Outputs good_outputs() {
  Outputs outputs{};
  outputs.slant_range_m = outputs.bearing_deg = outputs.depression_deg = kNan;
  outputs.steering_deg = outputs.approach_deg = outputs.cue_elevation_m = kNan;
  return outputs;
}

TEST(Validation, PositionsAndAnglesOfTheOutputsAreChecked) {
  EXPECT_EQ(validate(good_outputs()), std::nullopt);
  for (auto field : {&Outputs::cue_latitude_deg, &Outputs::target_latitude_deg})
    expect_range_without_nan(good_outputs(), field, -90.0, 90.0);
  for (auto field : {&Outputs::cue_longitude_deg, &Outputs::target_longitude_deg})
    expect_range_without_nan(good_outputs(), field, -180.0, 180.0);
  for (auto field : {&Outputs::cue_elevation_m, &Outputs::target_elevation_m})
    expect_range(good_outputs(), field, kLowestGround, kHighestGround);
  expect_range(good_outputs(), &Outputs::slant_range_m, 0.0, kFarthest_m);
  expect_range(good_outputs(), &Outputs::bearing_deg, 0.0, 360.0);
  expect_range(good_outputs(), &Outputs::depression_deg, -90.0, 90.0);
  expect_range(good_outputs(), &Outputs::steering_deg, -180.0, 180.0);
  expect_range(good_outputs(), &Outputs::approach_deg, 0.0, 360.0);
  Outputs outputs = good_outputs();
  outputs.marks[0].elevation_m = kInfinity;
  EXPECT_EQ(validate(outputs), std::nullopt) << "the mark is not in use";
  outputs.mark_count = 1;
  EXPECT_EQ(validate(outputs), "marks.elevation_m: expected [-12000, 10000], found inf");
}

TEST(Validation, AnAppliedEventIsCheckedWithItsEvent) {
  AppliedEvent applied{};
  applied.event = event_of(EventKind::push_button, 20);
  EXPECT_EQ(validate(applied), std::nullopt);
  applied.effective = kEventRefused + 1;
  EXPECT_EQ(validate(applied), "effective: expected [0, 2], found 3");
  applied.effective = kEventDone;
  applied.tick = -1;
  EXPECT_TRUE(validate(applied));
  applied.tick = 0;
  applied.event.argument = 21;
  EXPECT_TRUE(validate(applied));
  applied.event.argument = 20;
  applied.event.monotonic_ns = -1;
  EXPECT_EQ(validate(applied), "event: monotonic_ns: expected [0, 4611686018427387904], found -1");
}

TEST(Validation, SwitchesOfModelAndClockAreChecked) {
  ModelStatus status{};
  status.ownship = good_ownship();
  EXPECT_EQ(validate(status), std::nullopt);
  status.velocity_beam = 9;
  EXPECT_EQ(validate(status), "velocity_beam: expected [0, 8], found 9");
  status.velocity_beam = 0;
  status.scan_noise_only = 2;
  EXPECT_TRUE(validate(status));
  ClockState clock = last_valid_clock();
  clock.followed = 2;
  EXPECT_TRUE(validate(clock));
  RadarState state = good_state();
  state.range_index = 16;
  EXPECT_TRUE(validate(state));
}

TEST(Validation, PatchMapRangesAreCheckedAndItsNumbersMustBeFinite) {
  expect_range_without_nan(good_map(), &PatchMap::latitude_deg, -90.0, 90.0);
  expect_range_without_nan(good_map(), &PatchMap::longitude_deg, -180.0, 180.0);
  expect_range_without_nan(good_map(), &PatchMap::up_deg, 0.0, 360.0);
  expect_range_without_nan(good_map(), &PatchMap::apex_latitude_deg, -90.0, 90.0);
  expect_range_without_nan(good_map(), &PatchMap::apex_longitude_deg, -180.0, 180.0);
  expect_range_without_nan(good_map(), &PatchMap::distance_m, 0.0, 1e6);
  for (double PatchMap::* field : {&PatchMap::elevation_msl_m, &PatchMap::apex_altitude_msl_m, &PatchMap::squint_deg,
                                   &PatchMap::resolution_m, &PatchMap::formation_s, &PatchMap::window_nm}) {
    for (const double wrong : {kNan, kInfinity}) {
      PatchMap map = good_map();
      map.*field = wrong;
      EXPECT_TRUE(validate(map));
    }
  }
}

TEST(Validation, APatchMapHas1To1024PixelsPerSideAndAWindow) {
  for (const std::uint32_t size : {0U, 1025U, 4'000'000'000U}) {
    PatchMap map = good_map();
    map.size = size;
    EXPECT_TRUE(validate(map)) << size;
  }
  PatchMap map = good_map();
  map.size = 1024;
  EXPECT_EQ(validate(map), std::nullopt);
  map.window_nm = 0.0;
  EXPECT_TRUE(validate(map));
}

}  // namespace
}  // namespace yars::databuffer
