// The status of radar-model passes its readers' validation in all modes, windows and switch settings, and at all
// positions.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "databuffer/messages/validation.hpp"
#include "tests/model/kernel/cockpit.hpp"

namespace yars::model::kernel {
namespace {

using test::Cockpit;

void expect_valid(const Cockpit& cockpit) {
  auto status = cockpit.status();
  status.ownship = cockpit.tick.ownship;
  EXPECT_EQ(databuffer::validate(status).value_or(""), "") << "mode " << int{cockpit.tick.command.mode};
}

TEST(StatusValidation, BeforeTheFirstOwnshipTheStatusIsValid) {
  Cockpit cockpit;
  cockpit.tick.ownship = {};
  cockpit.tick.flags = 0;
  cockpit.step();
  expect_valid(cockpit);
}

TEST(StatusValidation, EveryModeHasAValidStatus) {
  for (std::uint8_t mode = 0; mode <= 7; ++mode) {
    Cockpit cockpit;
    cockpit.tick.command.mode = mode;
    ++cockpit.tick.command.scan_restart;
    for (int i = 0; i < 8; ++i) {
      for (const auto& sweep : cockpit.run(50)) EXPECT_EQ(databuffer::validate(sweep).value_or(""), "");
      expect_valid(cockpit);
    }
  }
}

TEST(StatusValidation, AFormingMapHasAValidStatus) {
  Cockpit cockpit;
  cockpit.tick.command.map_latitude_deg = 37.3;
  cockpit.tick.command.map_longitude_deg = -121.8;
  cockpit.tick.command.map_window_nm = 4.7F;
  ++cockpit.tick.command.map_request;
  cockpit.set_flag(databuffer::kMapping, true);
  for (int i = 0; i < 20; ++i) {
    cockpit.run(50);
    expect_valid(cockpit);
  }
}

// Random inputs within the ranges that validation admits.
TEST(StatusValidation, AnyAdmittedInputGivesAValidStatusAndValidSweeps) {
  constexpr unsigned kSeed = 20261122;
  RecordProperty("seed", kSeed);
  std::mt19937 random(kSeed);
  const auto number = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Cockpit cockpit;
  for (int round = 0; round < 300; ++round) {
    auto& own = cockpit.tick.ownship;
    own.latitude_deg = number(-90.0, 90.0);
    own.longitude_deg = number(-180.0, 180.0);
    own.altitude_msl_m = number(-1000.0, 200'000.0);
    own.heading_deg = number(0.0, 360.0);
    own.pitch_deg = number(-90.0, 90.0);
    own.roll_deg = number(-180.0, 180.0);
    own.velocity_north_mps = number(-1000.0, 1000.0);
    own.velocity_east_mps = number(-1000.0, 1000.0);
    auto& command = cockpit.tick.command;
    command.mode = static_cast<std::uint8_t>(number(0.0, 7.99));
    command.range_nm = number(0.0, 320.0);
    command.scan_width_deg = number(0.0, 360.0);
    command.antenna_elevation_deg = number(-60.0, 60.0);
    command.cursor_latitude_deg = number(-90.0, 90.0);
    command.cursor_longitude_deg = number(-180.0, 180.0);
    command.window_nm = number(0.0, 80.0);
    command.flags = static_cast<std::uint32_t>(random());
    command.scan_restart += static_cast<std::uint32_t>(number(0.0, 2.0));
    cockpit.tick.epoch += static_cast<std::uint32_t>(number(0.0, 1.2));
    for (const auto& sweep : cockpit.run(20)) ASSERT_EQ(databuffer::validate(sweep).value_or(""), "");
    auto status = cockpit.status();
    status.ownship = own;
    ASSERT_EQ(databuffer::validate(status).value_or(""), "") << "round " << round;
  }
}

}  // namespace
}  // namespace yars::model::kernel
