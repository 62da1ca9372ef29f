// MapSchedule: which patch map forms when. Formation time, progress, re-maps in STAB and PROG, limits, cancellation.
// Source: docs/spec/pilots_interface.md#rule-5, #rule-6, #rule-7; docs/spec/physics.md#formation-time.
#include "model/kernel/map_schedule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "lib/radar/configuration.hpp"
#include "lib/radar/mapping.hpp"
#include "lib/radar/modes.hpp"

namespace yars::model::kernel {
namespace {

constexpr double kGround_m = 0.0;

// The aircraft flies north at 480 kt and 15,000 ft. The commanded map of 4.7 NM is 15 NM away at a squint of 30
// degrees.
class MapScheduleTest : public testing::Test {
 protected:
  MapScheduleTest() {
    pose_.position = {37.0, -122.0};
    pose_.altitude = geo::AltitudeMsl::feet(15000.0);
    pose_.platform.heading = pose_.platform.ground_track = geo::Bearing::degrees(0.0);
    pose_.ground_speed = geo::Speed::knots(480.0);
    const geo::GeoPoint target = position_at(30.0, 15.0);
    tick_.command.power = static_cast<std::uint8_t>(radar::Power::operate);
    tick_.command.mode = static_cast<std::uint8_t>(radar::Mode::rbm);
    tick_.command.range_nm = 20.0;
    tick_.command.map_latitude_deg = target.latitude_deg;
    tick_.command.map_longitude_deg = target.longitude_deg;
    tick_.command.map_window_nm = 4.7F;
    tick_.epoch = 1;
    schedule_->step(tick_, pose_, kGround_m);
  }

  geo::GeoPoint position_at(double bearing_deg, double range_nm) const {
    return geo::geodesic_direct(pose_.position, geo::Bearing::degrees(bearing_deg),
                                geo::Length::nautical_miles(range_nm));
  }
  void command_at(double bearing_deg, double range_nm) {
    const geo::GeoPoint target = position_at(bearing_deg, range_nm);
    tick_.command.map_latitude_deg = target.latitude_deg;
    tick_.command.map_longitude_deg = target.longitude_deg;
  }
  void restart() {
    schedule_.emplace(configuration_);
    tick_.command.flags = 0;
    tick_.command.mode = static_cast<std::uint8_t>(radar::Mode::rbm);
    tick_.command.map_request = 0;
    schedule_->step(tick_, pose_, kGround_m);
  }
  databuffer::ModelStatus status() const {
    databuffer::ModelStatus status{};
    schedule_->describe(tick_.tick, status);
    return status;
  }
  void command_map() {
    ++tick_.command.map_request;
    tick_.command.flags |= databuffer::kMapping;
    step();
  }
  void step() {
    ++tick_.tick;
    schedule_->step(tick_, pose_, kGround_m);
  }
  // Steps until the map is due, then completes it. Returns the number of ticks.
  int ticks_until_done() {
    int ticks = 0;
    while (schedule_->forming() && !schedule_->due(tick_.tick) && ticks < 100'000) {
      step();
      ++ticks;
    }
    if (schedule_->forming()) schedule_->complete();
    return ticks;
  }
  void show_patch() {
    tick_.command.flags &= ~databuffer::kMapping;
    tick_.command.mode = static_cast<std::uint8_t>(radar::Mode::patch);
  }

  radar::RadarConfiguration configuration_;
  Pose pose_;
  databuffer::ModelTick tick_{};
  std::optional<MapSchedule> schedule_{configuration_};
};

TEST_F(MapScheduleTest, NothingFormsUntilAMapIsCommanded) {
  step();
  EXPECT_FALSE(schedule_->forming());
  EXPECT_FALSE(schedule_->blocks_scanning(tick_.command));
}

TEST_F(MapScheduleTest, AMapTakesItsFormationTimeAndBlocksScanning) {
  command_map();
  ASSERT_TRUE(schedule_->forming());
  EXPECT_TRUE(schedule_->blocks_scanning(tick_.command));
  const double formation_s = schedule_->map().formation.seconds();
  EXPECT_NEAR(ticks_until_done() * radar::kTickSeconds, formation_s, radar::kTickSeconds);
  // looks x strips x k lambda R / (2 V rho sin 30 deg). Looks: 2. Strips: 2.5 degrees wide. k: 1.2. V: 246.933 m/s.
  const double slant_m = std::hypot(15.0 * 1852.0, 4572.0);
  const double lambda_m = 299792458.0 / 9.6e9;
  const double rho_m = 4.7 * 1852.0 / 480.0;
  const double strips = std::ceil(4.7 * 1852.0 / (slant_m * 2.5 * geo::kRadiansPerDegree));
  EXPECT_NEAR(formation_s, 2.0 * strips * 1.2 * lambda_m * slant_m / (2.0 * 246.933 * rho_m * 0.5), 0.01 * formation_s);
}

TEST_F(MapScheduleTest, ProgressAndRemainingTimeAreReportedWhileAMapForms) {
  command_map();
  databuffer::ModelStatus status{};
  schedule_->describe(tick_.tick, status);
  EXPECT_NEAR(status.map_progress, 0.0, 1e-9);
  EXPECT_NEAR(status.map_timer_s, schedule_->map().formation.seconds(), 2.0 * radar::kTickSeconds);
  EXPECT_NEAR(status.map_window_nm, 4.7, 1e-6);
  EXPECT_EQ(status.map_request, 1U);
  EXPECT_EQ(status.map_newest, 0U);
  const std::int64_t middle = (schedule_->map().start_tick + schedule_->map().end_tick) / 2;
  schedule_->describe(middle, status);
  EXPECT_NEAR(status.map_progress, 0.5, 0.02);
  ticks_until_done();
  schedule_->describe(tick_.tick, status);
  EXPECT_EQ(status.map_newest, 1U);
  EXPECT_EQ(status.map_done_request, 1U);
  EXPECT_EQ(status.map_window_nm, 0.0);
}

TEST_F(MapScheduleTest, ACompletedCommandDoesNotStartAnotherMap) {
  command_map();
  ticks_until_done();
  step();
  step();
  EXPECT_FALSE(schedule_->forming());
}

TEST_F(MapScheduleTest, StabMapsTheSameGroundAgainAndProgTheSameBearingAndRange) {
  command_map();
  ticks_until_done();
  show_patch();
  pose_.position = geo::geodesic_direct(pose_.position, geo::Bearing::degrees(0.0), geo::Length::nautical_miles(2.0));
  step();
  ASSERT_TRUE(schedule_->forming());
  EXPECT_NEAR(schedule_->map().order.centre.latitude_deg, tick_.command.map_latitude_deg, 1e-9);
  ticks_until_done();
  tick_.command.flags |= databuffer::kProgressive;
  step();
  ASSERT_TRUE(schedule_->forming());
  const auto to_centre = geo::geodesic_inverse(pose_.position, schedule_->map().order.centre);
  // The angle was wider for the re-map 2 NM farther on. PROG keeps the angle of this re-map.
  EXPECT_GT(to_centre.azimuth_at_start.degrees(), 30.0);
  const auto before =
      geo::geodesic_inverse(pose_.position, {tick_.command.map_latitude_deg, tick_.command.map_longitude_deg});
  EXPECT_NEAR(to_centre.azimuth_at_start.degrees(), before.azimuth_at_start.degrees(), 1e-6);
  EXPECT_NEAR(to_centre.distance.metres(), before.distance.metres(), 1e-3);
}

// Range limits of a 4.7 NM window, blind zone and gimbal limit.
TEST_F(MapScheduleTest, ReMappingStopsOutsideTheLimitsOfAFirstMapAndResumesWithinThem) {
  struct Case {
    double right_deg, range_nm;
    const char* why;
  };
  for (const std::uint32_t mode : {0U, databuffer::kProgressive}) {
    for (const Case& limit_case :
         {Case{7.9, 15.0, "BLIND ZONE"}, Case{-60.1, 15.0, "GIMBAL"}, Case{122.0, 15.0, "GIMBAL"},
          Case{30.0, 4.6, "MIN RANGE"}, Case{30.0, 80.1, "MAX RANGE"}}) {
      restart();
      tick_.command.flags |= mode;
      command_at(limit_case.right_deg, limit_case.range_nm);
      command_map();
      ticks_until_done();
      const std::uint64_t newest = schedule_->newest();
      show_patch();
      step();
      EXPECT_FALSE(schedule_->forming()) << limit_case.why;
      EXPECT_STREQ(status().map_stopped, limit_case.why);
      EXPECT_FALSE(schedule_->pointing_target(tick_, pose_)) << "the antenna is not driven against its stop";
      EXPECT_EQ(schedule_->newest(), newest) << "the completed map remains the newest";
      command_at(30.0, 15.0);
      if (mode == 0U) {
        step();
        EXPECT_TRUE(schedule_->forming()) << limit_case.why;
        EXPECT_STREQ(status().map_stopped, "");
      }
    }
  }
}

TEST_F(MapScheduleTest, ATargetPassedAbeamIsMappedUpToTheGimbalLimit) {
  command_map();
  ticks_until_done();
  show_patch();
  double last_formed_deg = 0.0;
  const geo::GeoPoint target{tick_.command.map_latitude_deg, tick_.command.map_longitude_deg};
  for (int leg = 0; leg < 120; ++leg) {  // 30 NM to the north, past the target
    pose_.position =
        geo::geodesic_direct(pose_.position, geo::Bearing::degrees(0.0), geo::Length::nautical_miles(0.25));
    step();
    const double off_deg = geo::geodesic_inverse(pose_.position, target).azimuth_at_start.degrees();
    EXPECT_EQ(schedule_->forming(), off_deg <= 60.0) << off_deg;
    EXPECT_STREQ(status().map_stopped, off_deg <= 60.0 ? "" : "GIMBAL") << off_deg;
    if (schedule_->forming()) last_formed_deg = off_deg;
    if (schedule_->forming()) schedule_->complete();
  }
  EXPECT_GT(last_formed_deg, 55.0);
  // A turn to 140 degrees brings the target within the gimbal limit again.
  pose_.platform.heading = pose_.platform.ground_track = geo::Bearing::degrees(140.0);
  step();
  EXPECT_TRUE(schedule_->forming());
  EXPECT_STREQ(status().map_stopped, "");
}

TEST_F(MapScheduleTest, AReMapOfABlankSelectionHasTheLimitsOfTheBlankSelection) {
  for (const std::uint32_t blank : {0U, databuffer::kMapWindowBlank}) {
    restart();
    tick_.command.flags |= blank;
    tick_.command.map_window_nm = 3.3F;
    command_at(30.0, 3.0);
    command_map();
    ticks_until_done();
    show_patch();
    step();
    EXPECT_EQ(schedule_->forming(), blank != 0U);
    EXPECT_STREQ(status().map_stopped, blank != 0U ? "" : "MIN RANGE");
  }
}

TEST_F(MapScheduleTest, NoReasonIsReportedWhileFrozenAndOutsideOfPatch) {
  command_at(122.0, 15.0);
  command_map();
  ticks_until_done();
  show_patch();
  step();
  ASSERT_STREQ(status().map_stopped, "GIMBAL");
  tick_.command.flags |= databuffer::kFreeze;
  step();
  EXPECT_STREQ(status().map_stopped, "");
  tick_.command.flags &= ~databuffer::kFreeze;
  tick_.command.mode = static_cast<std::uint8_t>(radar::Mode::rbm);
  step();
  EXPECT_STREQ(status().map_stopped, "");
}

TEST_F(MapScheduleTest, AFrozenMapIsNotReMapped) {
  command_map();
  ticks_until_done();
  show_patch();
  tick_.command.flags |= databuffer::kFreeze;
  step();
  EXPECT_FALSE(schedule_->forming());
}

TEST_F(MapScheduleTest, SniffCancelsAReMap) {
  command_map();
  ticks_until_done();
  show_patch();
  step();
  ASSERT_TRUE(schedule_->forming());
  tick_.command.flags |= databuffer::kFreeze;
  step();
  EXPECT_TRUE(schedule_->forming());
  tick_.command.flags |= databuffer::kSniff;
  step();
  EXPECT_FALSE(schedule_->forming());
}

TEST_F(MapScheduleTest, ACancelledMapStopsForming) {
  command_map();
  tick_.command.flags &= ~databuffer::kMapping;
  step();
  EXPECT_FALSE(schedule_->forming());
}

TEST_F(MapScheduleTest, AJumpOfPositionRestartsTheMap) {
  command_map();
  for (int i = 0; i < 50; ++i) step();
  const std::int64_t before = schedule_->map().start_tick;
  ++tick_.epoch;
  pose_.position = position_at(180.0, 2.0);
  step();
  ASSERT_TRUE(schedule_->forming());
  EXPECT_GT(schedule_->map().start_tick, before);
  EXPECT_NEAR(schedule_->map().order.apex.latitude_deg, pose_.position.latitude_deg, 1e-12);
}

TEST_F(MapScheduleTest, ACommandBelowTheAircraftCompletesWithoutAMap) {
  tick_.command.map_latitude_deg = pose_.position.latitude_deg;
  tick_.command.map_longitude_deg = pose_.position.longitude_deg;
  command_map();
  EXPECT_FALSE(schedule_->forming());
  databuffer::ModelStatus status{};
  schedule_->describe(tick_.tick, status);
  EXPECT_EQ(status.map_done_request, 1U);
  EXPECT_EQ(status.map_newest, 0U);
}

TEST_F(MapScheduleTest, ParametersThatAreNotFiniteMakeNoMap) {
  tick_.command.map_window_nm = NAN;
  command_map();
  EXPECT_FALSE(schedule_->forming());
  tick_.command.map_window_nm = 4.7F;
  tick_.command.map_latitude_deg = INFINITY;
  command_map();
  EXPECT_FALSE(schedule_->forming());
}

TEST_F(MapScheduleTest, ARestartedModelRestartsTheMap) {
  command_map();
  databuffer::ModelStatus status{};
  schedule_->describe(tick_.tick, status);
  MapSchedule successor(configuration_);
  successor.resume(status);
  ++tick_.tick;
  successor.step(tick_, pose_, kGround_m);
  ASSERT_TRUE(successor.forming());
  EXPECT_EQ(successor.map().start_tick, tick_.tick);
}

}  // namespace
}  // namespace yars::model::kernel
