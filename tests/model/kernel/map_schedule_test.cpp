// MapSchedule: which patch map forms when. Formation time, progress, re-maps in STAB and PROG, cancellation.
// Source: docs/pilots_manual.md#rule-5, #rule-6, #rule-7; docs/spec/physics.md#formation-time.
#include "model/kernel/map_schedule.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/model/kernel/map_schedule_fixture.hpp"

namespace yars::model::kernel {
namespace {

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
