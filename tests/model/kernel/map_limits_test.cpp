// Limits of commanded maps and of re-maps: blind zone, gimbal, ranges of the window.
// Source: docs/pilots_manual.md#rule-2, #rule-3, #rule-4, #rule-5, #rule-7.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "model/kernel/map_schedule.hpp"
#include "tests/model/kernel/map_schedule_fixture.hpp"

namespace yars::model::kernel {
namespace {

using MapLimitsTest = MapScheduleTest;

struct LimitCase {
  double right_deg, range_nm;
  const char* why;
};
// Beyond the range limits of a 4.7 NM window, in the blind zone, and beyond the gimbal limit in azimuth.
constexpr std::array kBeyondLimits{LimitCase{7.9, 15.0, "BLIND ZONE"}, LimitCase{-60.1, 15.0, "GIMBAL"},
                                   LimitCase{122.0, 15.0, "GIMBAL"}, LimitCase{30.0, 4.6, "MIN RANGE"},
                                   LimitCase{30.0, 80.1, "MAX RANGE"}};

TEST_F(MapLimitsTest, ReMappingStopsOutsideTheLimitsOfAFirstMapAndResumesWithinThem) {
  for (const LimitCase& limit_case : kBeyondLimits) {
    show_first_map();
    const std::uint64_t newest = schedule_->newest();
    ASSERT_NE(newest, 0U);
    command_at(limit_case.right_deg, limit_case.range_nm);
    step();
    EXPECT_FALSE(schedule_->forming()) << limit_case.why;
    EXPECT_STREQ(status().map_stopped, limit_case.why);
    EXPECT_FALSE(schedule_->pointing_target(tick_, pose_)) << "the antenna is not driven against its stop";
    EXPECT_EQ(schedule_->newest(), newest) << "the completed map remains the newest";
    command_at(30.0, 15.0);
    step();
    EXPECT_TRUE(schedule_->forming()) << limit_case.why;
    EXPECT_STREQ(status().map_stopped, "");
  }
}

// The state machine checks a command with the values of its own tick. The aircraft may have moved since.
TEST_F(MapLimitsTest, ACommandBeyondALimitIsAnsweredWithTheLimitAndWithoutAMap) {
  for (const LimitCase& limit_case : kBeyondLimits) {
    restart();
    command_at(limit_case.right_deg, limit_case.range_nm);
    command_map();
    for (int tick = 0; tick < 3; ++tick, step()) {
      EXPECT_FALSE(schedule_->forming()) << limit_case.why;
      EXPECT_EQ(status().map_done_request, tick_.command.map_request);
      EXPECT_EQ(status().map_newest, 0U);
      EXPECT_STREQ(status().map_stopped, limit_case.why) << "the reason remains until the command ends";
    }
    command_at(30.0, 15.0);
    command_map();
    EXPECT_TRUE(schedule_->forming());
    EXPECT_STREQ(status().map_stopped, "");
  }
}

// Attitudes and heights at which the antenna reaches a target on one side of a limit of 60 degrees and not on the
// other.
struct ElevationCase {
  const char* what;
  double altitude_ft, ground_m, pitch_deg, roll_deg;
  bool reached;
};
constexpr std::array kElevationCases{
    // The target is 15 NM away. From 157,000 ft it is 59.9 degrees below the horizon, from 160,000 ft 60.3.
    ElevationCase{"high", 157'000.0, 0.0, 0.0, 0.0, true},
    ElevationCase{"too high", 160'000.0, 0.0, 0.0, 0.0, false},
    ElevationCase{"too high over sea, but over high ground", 160'000.0, 1000.0, 0.0, 0.0, true},
    ElevationCase{"too high over a void, which counts as sea", 160'000.0, NAN, 0.0, 0.0, false},
    // From 15,000 ft the target is 9.3 degrees below the horizon.
    ElevationCase{"steep climb", 15'000.0, 0.0, 45.0, 0.0, true},
    ElevationCase{"steeper climb", 15'000.0, 0.0, 70.0, 0.0, false},
    // In a dive the gimbal reaches the target in airframe axes, but the servo does not against the horizon.
    ElevationCase{"dive", 160'000.0, 0.0, -40.0, 0.0, false},
    ElevationCase{"bank to the target", 15'000.0, 0.0, 0.0, 45.0, true},
    ElevationCase{"near-vertical dive, beyond the azimuth limit in airframe axes", 15'000.0, 0.0, -85.0, 0.0, false},
};

TEST_F(MapLimitsTest, ElevationLimitsFirstMapsAndReMapsInTheHorizonAndInTheAirframe) {
  const Pose level = pose_;
  for (const std::uint32_t mode : {0U, databuffer::kProgressive}) {
    for (const ElevationCase& one : kElevationCases) {
      SCOPED_TRACE(one.what);
      const auto fly = [&] {
        pose_.altitude = geo::AltitudeMsl::feet(one.altitude_ft);
        pose_.platform.pitch = geo::Angle::degrees(one.pitch_deg);
        pose_.platform.roll = geo::Angle::degrees(one.roll_deg);
        ground_m_ = one.ground_m;
      };
      fly();
      restart();
      command_at(30.0, 15.0);
      command_map();
      EXPECT_EQ(schedule_->forming(), one.reached);
      EXPECT_STREQ(status().map_stopped, one.reached ? "" : "GIMBAL");
      pose_ = level;
      ground_m_ = kGround_m;
      show_first_map();
      tick_.command.flags |= mode;
      fly();
      step();
      EXPECT_EQ(schedule_->forming(), one.reached);
      EXPECT_STREQ(status().map_stopped, one.reached ? "" : "GIMBAL");
      pose_ = level;
      ground_m_ = kGround_m;
      step();
      EXPECT_TRUE(schedule_->forming()) << "re-mapping resumes";
      EXPECT_STREQ(status().map_stopped, "");
    }
  }
}

// The target of a PROG re-map moves with the aircraft, so its elevation is not that of the commanded position.
TEST_F(MapLimitsTest, TheNextCentreIsTheCommandedPositionAndInProgTheLastAngleAndRange) {
  show_first_map();
  const geo::GeoPoint commanded{tick_.command.map_latitude_deg, tick_.command.map_longitude_deg};
  pose_.position = geo::geodesic_direct(pose_.position, geo::Bearing::degrees(0.0), geo::Length::nautical_miles(3.0));
  const auto next_off_m = [&] {
    return geo::geodesic_inverse(schedule_->next_centre(tick_.command, pose_), commanded).distance.metres();
  };
  EXPECT_EQ(next_off_m(), 0.0);
  tick_.command.flags |= databuffer::kProgressive;
  EXPECT_NEAR(next_off_m(), geo::Length::nautical_miles(3.0).metres(), 10.0);
  tick_.command.flags |= databuffer::kMapping;
  EXPECT_EQ(next_off_m(), 0.0);
}

TEST_F(MapLimitsTest, ATargetPassedAbeamIsMappedUpToTheGimbalLimit) {
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

TEST_F(MapLimitsTest, AReMapOfABlankSelectionHasTheLimitsOfTheBlankSelection) {
  for (const std::uint32_t blank : {0U, databuffer::kMapWindowBlank}) {
    restart();
    tick_.command.flags |= blank;
    tick_.command.map_window_nm = 3.3F;
    command_at(30.0, 3.0);
    command_map();
    EXPECT_EQ(schedule_->forming(), blank != 0U);
    EXPECT_STREQ(status().map_stopped, blank != 0U ? "" : "MIN RANGE");
    ticks_until_done();
    show_patch();
    step();
    EXPECT_EQ(schedule_->forming(), blank != 0U);
    EXPECT_STREQ(status().map_stopped, blank != 0U ? "" : "MIN RANGE");
  }
}

TEST_F(MapLimitsTest, NoReasonIsReportedWhileFrozenAndOutsideOfPatch) {
  show_first_map();
  command_at(122.0, 15.0);
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

}  // namespace
}  // namespace yars::model::kernel
