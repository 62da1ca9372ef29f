// Extreme numbers in each field that comes from outside. Validation refuses a record with NaN or infinity, counts it,
// and reports the field; the last good record stays in use. NaN and infinity that reach the kernel directly do not
// reach a sweep. Denormal numbers act as zero.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "databuffer/messages/validation.hpp"
#include "databuffer/session/receivers.hpp"
#include "tests/extremes/islands.hpp"
#include "tests/model/kernel/cockpit.hpp"

namespace yars {
namespace {

using databuffer::ClockState;
using databuffer::InputEvent;
using databuffer::ModelTick;
using databuffer::Nav;
using databuffer::Ownship;
using databuffer::RadarCommand;
using databuffer::RadarState;
using databuffer::Sweep;
using test::Cockpit;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDenormal = 1e-310;
constexpr double kNonFinite[] = {kNan, -kNan, kInfinity, -kInfinity};

template <class Record>
struct Field {
  const char* name;
  double Record::* position;
  bool may_be_missing = false;  // NaN is valid and means "no value"
};

constexpr Field<Ownship> kOwnshipFields[] = {{"latitude_deg", &Ownship::latitude_deg},
                                             {"longitude_deg", &Ownship::longitude_deg},
                                             {"altitude_msl_m", &Ownship::altitude_msl_m},
                                             {"heading_deg", &Ownship::heading_deg},
                                             {"pitch_deg", &Ownship::pitch_deg},
                                             {"roll_deg", &Ownship::roll_deg},
                                             {"velocity_north_mps", &Ownship::velocity_north_mps},
                                             {"velocity_east_mps", &Ownship::velocity_east_mps},
                                             {"velocity_down_mps", &Ownship::velocity_down_mps},
                                             {"radar_altitude_m", &Ownship::radar_altitude_m, true},
                                             {"flight_time_s", &Ownship::flight_time_s}};
constexpr Field<Nav> kNavFields[] = {{"mission_latitude_deg", &Nav::mission_latitude_deg},
                                     {"mission_longitude_deg", &Nav::mission_longitude_deg},
                                     {"ins_latitude_deg", &Nav::ins_latitude_deg},
                                     {"ins_longitude_deg", &Nav::ins_longitude_deg},
                                     {"velocity_north_mps", &Nav::velocity_north_mps},
                                     {"velocity_east_mps", &Nav::velocity_east_mps},
                                     {"velocity_down_mps", &Nav::velocity_down_mps},
                                     {"magnetic_variation_deg", &Nav::magnetic_variation_deg, true}};
constexpr Field<RadarState> kStateFields[] = {{"range_nm", &RadarState::range_nm},
                                              {"scan_width_deg", &RadarState::scan_width_deg},
                                              {"antenna_elevation_deg", &RadarState::antenna_elevation_deg},
                                              {"cursor_latitude_deg", &RadarState::cursor_latitude_deg},
                                              {"cursor_longitude_deg", &RadarState::cursor_longitude_deg},
                                              {"cursor_elevation_m", &RadarState::cursor_elevation_m, true},
                                              {"cursor_bearing_deg", &RadarState::cursor_bearing_deg},
                                              {"cursor_range_nm", &RadarState::cursor_range_nm},
                                              {"tdc_x", &RadarState::tdc_x},
                                              {"tdc_y", &RadarState::tdc_y},
                                              {"window_nm", &RadarState::window_nm},
                                              {"frame_latitude_deg", &RadarState::frame_latitude_deg},
                                              {"frame_longitude_deg", &RadarState::frame_longitude_deg},
                                              {"frame_track_deg", &RadarState::frame_track_deg}};
// Latitude NaN means: no repositioning. The fields after it are then not validated.
constexpr Field<ClockState> kClockFields[] = {{"rate", &ClockState::rate},
                                              {"reposition_latitude_deg", &ClockState::reposition_latitude_deg, true},
                                              {"reposition_longitude_deg", &ClockState::reposition_longitude_deg},
                                              {"reposition_altitude_m", &ClockState::reposition_altitude_m},
                                              {"reposition_heading_deg", &ClockState::reposition_heading_deg}};
constexpr Field<RadarCommand> kCommandFields[] = {{"range_nm", &RadarCommand::range_nm},
                                                  {"scan_width_deg", &RadarCommand::scan_width_deg},
                                                  {"antenna_elevation_deg", &RadarCommand::antenna_elevation_deg},
                                                  {"cursor_latitude_deg", &RadarCommand::cursor_latitude_deg},
                                                  {"cursor_longitude_deg", &RadarCommand::cursor_longitude_deg},
                                                  {"window_nm", &RadarCommand::window_nm}};

RadarState good_state() {
  RadarState state{};
  state.channel = 1;
  state.flags = databuffer::kCursorValid;
  return state;
}

// Expects that validate() refuses each non-finite value in each field, with the field's name first in the reason.
template <class Record, std::size_t kCount>
void expect_refusals(const Record& good, const Field<Record> (&fields)[kCount]) {
  EXPECT_EQ(validate(good), std::nullopt);
  for (const auto& field : fields) {
    for (const double bad : kNonFinite) {
      Record record = good;
      record.*field.position = bad;
      const bool allowed = field.may_be_missing && std::isnan(bad);
      const auto reason = validate(record);
      ASSERT_EQ(reason.has_value(), !allowed) << field.name << " = " << bad;
      EXPECT_THAT(reason.value_or(""), allowed ? HasSubstr("") : HasSubstr(std::string(field.name) + ": expected ["));
    }
  }
}

TEST(ExtremeNumbers, NanAndInfinityInAnyFieldAreRefusedWithTheFieldsName) {
  expect_refusals(Ownship{}, kOwnshipFields);
  expect_refusals(Nav{}, kNavFields);
  expect_refusals(good_state(), kStateFields);
  expect_refusals(ClockState{}, kClockFields);
}

TEST(ExtremeNumbers, NanAndInfinityInANumberThatAnEventUsesAreRefused) {
  struct Row {
    databuffer::EventKind kind;
    double InputEvent::* position;
  };
  for (const Row row :
       {Row{databuffer::EventKind::tdc, &InputEvent::x}, Row{databuffer::EventKind::tdc, &InputEvent::y},
        Row{databuffer::EventKind::elevation, &InputEvent::x}}) {
    for (const double bad : kNonFinite) {
      InputEvent event{};
      event.kind = static_cast<std::uint16_t>(row.kind);
      EXPECT_EQ(validate(event), std::nullopt);
      event.*row.position = bad;
      EXPECT_TRUE(validate(event));
    }
  }
}

TEST(ExtremeNumbers, ARefusedRecordIsCountedOnceAndTheLastGoodRecordStaysInUse) {
  const auto layout = std::make_unique<databuffer::SessionLayout>();
  databuffer::OwnshipReceiver receiver;
  Ownship good{};
  good.latitude_deg = 38.0;
  std::int64_t now_ns = 0;
  receiver.refresh(*layout, now_ns, 0);
  std::uint64_t refused = 0;
  for (const auto& field : kOwnshipFields) {
    for (const double bad : kNonFinite) {
      if (field.may_be_missing && std::isnan(bad)) continue;
      good.longitude_deg += 1e-4;
      layout->ownship[0].publish(good);
      ASSERT_TRUE(receiver.refresh(*layout, now_ns += 5'000'000, 0).valid);
      Ownship record = good;
      record.longitude_deg += 90.0;
      record.*field.position = bad;
      layout->ownship[0].publish(record);
      // The second call reads the same record again, which is not refused again.
      receiver.refresh(*layout, now_ns += 5'000'000, 0);
      EXPECT_THAT(receiver.refusals(), ElementsAre(HasSubstr(std::string("ownship in lane 0: ") + field.name)));
      const auto& selected = receiver.refresh(*layout, now_ns += 5'000'000, 0);
      EXPECT_EQ(receiver.refused(), ++refused) << field.name;
      EXPECT_THAT(receiver.refusals(), IsEmpty()) << field.name;
      EXPECT_TRUE(selected.valid);
      EXPECT_EQ(selected.ownship.longitude_deg, good.longitude_deg) << field.name;
    }
  }
  for (const auto& field : kNavFields) {
    Nav nav{};
    nav.mission_latitude_deg = 1.0;
    layout->nav[0].publish(nav);
    receiver.refresh(*layout, now_ns, 0);
    nav.mission_latitude_deg = 2.0;
    nav.*field.position = kInfinity;
    layout->nav[0].publish(nav);
    EXPECT_EQ(receiver.refresh(*layout, now_ns, 0).nav.mission_latitude_deg, 1.0) << field.name;
    EXPECT_EQ(receiver.refused(), ++refused);
    EXPECT_THAT(receiver.refusals(), ElementsAre(HasSubstr(std::string("nav in lane 0: ") + field.name)));
  }
}

bool all_fields_are_numbers(const Sweep& sweep) {
  const double fields[] = {
      sweep.apex_latitude_deg, sweep.apex_longitude_deg, sweep.apex_altitude_msl_m, sweep.azimuth_left_deg,
      sweep.azimuth_right_deg, sweep.ground_track_deg,   sweep.elevation_deg,       sweep.range_m};
  return std::all_of(std::begin(fields), std::end(fields), [](double value) { return std::isfinite(value); });
}

TEST(ExtremeNumbers, ANonFiniteNumberInThePoseGivesABlankSweepAtTheLastGoodPosition) {
  for (const auto& field : kOwnshipFields) {
    if (field.may_be_missing || field.position == &Ownship::flight_time_s) continue;  // no part of the pose
    for (const double bad : kNonFinite) {
      Cockpit cockpit(test::bare_configuration(32));
      ASSERT_TRUE(cockpit.run_until(test::is_scan_start));
      const Ownship good = cockpit.tick.ownship;
      cockpit.tick.ownship.*field.position = bad;
      cockpit.step();
      cockpit.tick.ownship = good;
      const Sweep* sweep = cockpit.step();
      ASSERT_NE(sweep, nullptr);
      EXPECT_NE(sweep->flags & databuffer::kSweepBlank, 0U) << field.name << " = " << bad;
      EXPECT_TRUE(std::all_of(sweep->video, sweep->video + 32, [](std::uint8_t level) { return level == 0; }));
      EXPECT_EQ(sweep->apex_latitude_deg, good.latitude_deg);
      EXPECT_TRUE(all_fields_are_numbers(*sweep));
    }
  }
}

TEST(ExtremeNumbers, ANonFiniteNumberInACommandReachesNoSweepAndTheRadarContinuesAfterIt) {
  test::for_each_algorithm(32, [](const radar::RadarConfiguration& configuration) {
    for (const auto& field : kCommandFields) {
      for (const double bad : kNonFinite) {
        SCOPED_TRACE(std::string(field.name) + " = " + std::to_string(bad));
        Cockpit cockpit(configuration);
        ASSERT_TRUE(cockpit.run_until(test::is_scan_start));
        const RadarCommand good = cockpit.tick.command;
        cockpit.tick.command.*field.position = bad;
        for (const Sweep& sweep : cockpit.run(450)) ASSERT_TRUE(all_fields_are_numbers(sweep));
        const auto status = cockpit.status();
        EXPECT_TRUE(std::isfinite(status.scan_width_deg) && std::isfinite(status.scan_range_m) &&
                    std::isfinite(status.antenna_elevation_deg) && std::isfinite(status.antenna_azimuth_deg));
        cockpit.tick.command = good;
        EXPECT_TRUE(cockpit.run_until(test::is_scan_start));
        EXPECT_EQ(cockpit.sweep.range_m, 40.0 * geo::kMetresPerNauticalMile);
      }
    }
  });
}

TEST(ExtremeNumbers, ANonFiniteScanWidthOrElevationKeepsTheLastOne) {
  for (const double bad : kNonFinite) {
    Cockpit undisturbed(test::bare_configuration(32));
    Cockpit cockpit(test::bare_configuration(32));
    undisturbed.run(500);
    cockpit.run(500);
    cockpit.tick.command.scan_width_deg = bad;
    cockpit.tick.command.antenna_elevation_deg = bad;
    const auto expected = undisturbed.run(400);
    const auto sweeps = cockpit.run(400);
    ASSERT_EQ(sweeps.size(), expected.size()) << bad;
    for (std::size_t i = 0; i < sweeps.size(); ++i) ASSERT_EQ(sweeps[i].hash, expected[i].hash) << bad;
  }
}

TEST(ExtremeNumbers, DenormalPositionsAltitudesAndAnglesGiveTheSameVideoAsZero) {
  test::for_each_algorithm_and_beam(64, [](const radar::RadarConfiguration& configuration) {
    const auto video_with = [&configuration](double small) {
      Cockpit cockpit(configuration, model::terrain::plane({{0.0, 0.0}, geo::Bearing()}, -200.0, 0.001));
      Ownship& ownship = cockpit.tick.ownship;
      for (const auto& field : kOwnshipFields) ownship.*field.position = small;
      cockpit.tick.command.antenna_elevation_deg = small;
      cockpit.tick.command.cursor_latitude_deg = cockpit.tick.command.cursor_longitude_deg = small;
      cockpit.tick.command.window_nm = small;
      std::vector<std::vector<std::uint8_t>> video;
      for (const Sweep& sweep : cockpit.run(150)) video.emplace_back(sweep.video, sweep.video + sweep.samples);
      return video;
    };
    const auto zero = video_with(0.0);
    EXPECT_GT(zero.size(), 50U);
    EXPECT_EQ(video_with(kDenormal), zero);
    EXPECT_EQ(video_with(std::numeric_limits<double>::denorm_min()), zero);
    EXPECT_EQ(video_with(-kDenormal), zero);
  });
}

TEST(ExtremeNumbers, ADenormalRangeGivesNoSweepsAndADenormalWidthTheNarrowestScan) {
  test::for_each_algorithm(32, [](const radar::RadarConfiguration& configuration) {
    for (const double small : {kDenormal, std::numeric_limits<double>::denorm_min(), 1e-12}) {
      Cockpit cockpit(configuration);
      cockpit.tick.command.range_nm = small;
      EXPECT_TRUE(cockpit.run(400).empty()) << small;
      EXPECT_FALSE(cockpit.kernel.need(cockpit.tick).ground);
      cockpit.tick.command.range_nm = 40.0;
      cockpit.tick.command.scan_width_deg = small;
      const auto sweeps = cockpit.run(400);
      ASSERT_FALSE(sweeps.empty());
      // At most one degree to each side of the track, 45 degrees.
      for (const Sweep& sweep : sweeps) EXPECT_NEAR(sweep.azimuth_left_deg, 45.0, 1.0);
    }
  });
}

TEST(ExtremeNumbers, RandomExtremesOverRuggedGroundWithVoidsGiveOnlySweepsOfFiniteNumbers) {
  constexpr unsigned kSeed = 19960615;
  RecordProperty("seed", static_cast<int>(kSeed));
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  constexpr double kPool[] = {0.0,        -0.0,   kDenormal, -kDenormal, 1e-9,   0.1,       1.0,
                              4.7,        59.999, 60.0,      -60.0,      89.999, 90.0,      -90.0,
                              179.999999, 180.0,  -180.0,    320.0,      360.0,  -400.0,    8848.0,
                              18288.0,    1e5,    1e300,     -1e300,     kNan,   kInfinity, -kInfinity};
  std::mt19937 random(kSeed);
  const auto pick = [&] { return kPool[random() % std::size(kPool)]; };
  const auto rugged = [](geo::GeoPoint position) {
    const double wave = std::sin(position.latitude_deg * 700.0) * std::cos(position.longitude_deg * 900.0);
    return wave > 0.8 ? kNan : wave < -0.8 ? 0.0 : 8848.0 * wave;
  };
  test::for_each_algorithm_and_beam(24, [&](radar::RadarConfiguration& configuration) {
    configuration.fidelity.slant_range = random() % 2 == 0;
    configuration.fidelity.noise = configuration.fidelity.pulse_smear = configuration.fidelity.azimuth_smear = true;
    configuration.antenna.elevation_beamwidth_deg = 2.5;
    Cockpit cockpit(configuration, rugged);
    const ModelTick good = cockpit.tick;
    for (int round = 0; round < 150; ++round) {
      const std::int64_t tick = cockpit.tick.tick;
      cockpit.tick = good;
      cockpit.tick.tick = tick;
      for (int change = static_cast<int>(random() % 4); change > 0; --change) {
        if (random() % 2 == 0)
          cockpit.tick.ownship.*kOwnshipFields[random() % std::size(kOwnshipFields)].position = pick();
        else
          cockpit.tick.command.*kCommandFields[random() % std::size(kCommandFields)].position = pick();
      }
      for (const Sweep& sweep : cockpit.run(20)) ASSERT_TRUE(all_fields_are_numbers(sweep)) << "round " << round;
      (void)cockpit.status();
    }
  });
}

}  // namespace
}  // namespace yars
