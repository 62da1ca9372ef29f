// Rules of docs/pilots_manual.md#rules that need no patch map and no designation: power-up, controls, SNIFF,
// recorder, restart.
#include <gtest/gtest.h>

#include "databuffer/messages/derived_values.hpp"
#include "tests/statemachine/pilot.hpp"

namespace yars::statemachine::testing {
namespace {

using databuffer::kDeclutter;
using databuffer::kFreeze;
using databuffer::kIpvu;
using databuffer::kSniff;

class Rules : public ::testing::Test {
 protected:
  Rules() { pilot.press("power opr"); }
  std::string field(const std::string& name) const { return fields_of(pilot).at(name); }
  Pilot pilot;
};

TEST(PowerUp, ASessionBeginsInOffWithoutLegends) {
  Pilot pilot;
  pilot.wait();
  EXPECT_EQ(fields_of(pilot).at("power"), "OFF");
  for (int button = 1; button <= 20; ++button) EXPECT_EQ(pilot.legend(button), "");
}

TEST_F(Rules, PowerUpSetsTheValuesOfTheSpec) {
  const Fields expected{
      {"power", "OPR"},        {"mode", "RBM"},        {"running", "RBM"},   {"master", "AG"},
      {"range_nm", "20"},      {"scan", "FULL"},       {"gain", "3"},        {"brightness", "8"},
      {"contrast", "8"},       {"declutter", "false"}, {"freeze", "false"},  {"sniff", "false"},
      {"ipvu", "false"},       {"vtr", "false"},       {"menu", "false"},    {"cursor_function", "MAP"},
      {"set", "false"},        {"mapping", "false"},   {"recall", "-"},      {"shown", "0"},
      {"maps", "0/0/0"},       {"cursor_on", "1"},     {"window_nm", "4.7"}, {"multi_look", "ML1"},
      {"stabilizing", "STAB"}, {"channel", "1"},       {"band", "A"},        {"sequence_point", "1"},
      {"nav_source", "MN"},    {"altimeter", "ok"},    {"elevation", "0"},   {"tdc", "0/0"},
      {"message", ""},         {"moved", "false"},     {"drift", "false"},   {"cues", "0"},
      {"target", ""},          {"psl", "-"},           {"marks", "0"},       {"vtr_requests", "0"}};
  EXPECT_EQ(fields_of(pilot), expected);
}

TEST_F(Rules, AfterOffAPowerUpGivesTheInitialStateAgain) {
  pilot.around.epoch = 3;
  pilot.wait(3);
  const databuffer::RadarState fresh = pilot.state;
  for (const char* event : {"pb 2", "pb 3", "pb 9", "pb 13", "pb 17", "pb 18", "freeze", "contrast up", "nav ins",
                            "altimeter fail", "mode aa", "pb 11"})
    pilot.press(event);
  pilot.send("power off");
  EXPECT_EQ(pilot.state.epoch, fresh.epoch);
  pilot.press("power opr");
  pilot.wait(3);
  databuffer::RadarState again = pilot.state;
  // Counts that other programs compare continue.
  EXPECT_GT(again.scan_restart, fresh.scan_restart);
  again.scan_restart = fresh.scan_restart;
  // The cursor was set to its initial position at a later tick.
  again.cursor_moved_tick = fresh.cursor_moved_tick;
  EXPECT_EQ(std::memcmp(&again, &fresh, sizeof again), 0);
}

TEST_F(Rules, StandbyKeepsTheStateAndOperateResumesIt) {
  for (const char* event : {"pb 3", "pb 9", "pb 18", "radar bcn", "pb 13"}) pilot.press(event);
  Fields expected = fields_of(pilot);
  pilot.press("power stby");
  expected["power"] = "STBY";
  EXPECT_EQ(fields_of(pilot), expected);
  pilot.press("power opr");
  expected["power"] = "OPR";
  EXPECT_EQ(fields_of(pilot), expected);
}

TEST_F(Rules, GainCyclesDownwards) {
  for (const char* legend : {"GAIN 2", "GAIN 1", "GAIN 0", "GAIN 3"}) {
    pilot.press("pb 3");
    EXPECT_EQ(pilot.legend(3), legend);
  }
}

TEST_F(Rules, CursorFunctionCycles) {
  for (const char* legend : {"UPDT", "CUE", "TGT", "MARK", "MAP"}) {
    pilot.press("pb 7");
    EXPECT_EQ(pilot.legend(7), legend);
  }
}

TEST_F(Rules, ChannelAndBandCycle) {
  for (const char* legend : {"2", "3", "4", "5", "6", "7", "8", "1"}) {
    pilot.press("pb 19");
    EXPECT_EQ(pilot.legend(19), legend);
  }
  for (const char* legend : {"B", "C", "D", "E", "A"}) {
    pilot.press("pb 20");
    EXPECT_EQ(pilot.legend(20), legend);
  }
}

TEST_F(Rules, ModeCycles) {
  for (const char* legend : {"HRM", "BCN", "PVU", "RBM"}) {
    pilot.press("pb 6");
    EXPECT_EQ(pilot.legend(6), legend);
  }
}

TEST_F(Rules, BrightnessAndContrastStopAt0And15) {
  const std::vector<std::array<std::string, 3>> levels{{"pb 4", "pb 5", "brightness"},
                                                       {"contrast up", "contrast down", "contrast"}};
  for (const auto& [up, down, name] : levels) {
    for (int press = 8; press < 15; ++press) EXPECT_TRUE(pilot.press(up));
    EXPECT_EQ(field(name), "15");
    EXPECT_FALSE(pilot.press(up));
    for (int press = 15; press > 0; --press) EXPECT_TRUE(pilot.press(down));
    EXPECT_EQ(field(name), "0");
    EXPECT_FALSE(pilot.press(down));
  }
}

TEST_F(Rules, ALegendIsBoxedWhileItsFunctionIsOn) {
  const std::vector<std::pair<int, std::uint32_t>> switches{{2, kDeclutter}, {16, kIpvu}, {18, kSniff}};
  for (const auto& [button, flag] : switches) {
    pilot.press("pb " + std::to_string(button));
    EXPECT_TRUE(pilot.is(flag));
    EXPECT_EQ(pilot.state.boxed, 1U << button);
    pilot.press("pb " + std::to_string(button));
    EXPECT_FALSE(pilot.is(flag));
    EXPECT_EQ(pilot.state.boxed, 0U);
  }
}

TEST_F(Rules, SniffInHrmFreezesThePictureEvenAfterSniffEnds) {
  pilot.press("radar hrm");
  pilot.press("pb 18");
  EXPECT_TRUE(pilot.is(kFreeze));
  EXPECT_FALSE(pilot.press("freeze"));
  pilot.press("pb 18");
  EXPECT_TRUE(pilot.is(kFreeze));
  EXPECT_TRUE(pilot.press("freeze"));
  EXPECT_FALSE(pilot.is(kFreeze));
}

TEST_F(Rules, HrmEnteredWithSniffOnIsFrozenAtOnce) {
  pilot.press("pb 18");
  EXPECT_FALSE(pilot.is(kFreeze));
  pilot.press("pb 6");
  EXPECT_EQ(field("mode"), "HRM");
  EXPECT_TRUE(pilot.is(kFreeze));
}

TEST_F(Rules, BackInAirToGroundTheRadarResumesItsMode) {
  pilot.press("radar bcn");
  pilot.press("pb 13");
  pilot.press("mode aa");
  pilot.press("mode agr");
  EXPECT_EQ(field("mode"), "AGR");
  pilot.press("mode ag");
  EXPECT_EQ(field("mode"), "BCN");
  EXPECT_EQ(pilot.state.range_nm, 40.0) << "a change of master mode keeps the range";
}

TEST_F(Rules, UnderTheMenuTheRadarRunsAndHandsOnControlsWork) {
  pilot.press("pb 11");
  EXPECT_EQ(databuffer::command_from_state(pilot.state).mode, static_cast<std::uint8_t>(radar::Mode::rbm));
  pilot.press("radar bcn");
  EXPECT_EQ(field("mode"), "MENU");
  EXPECT_EQ(databuffer::command_from_state(pilot.state).mode, static_cast<std::uint8_t>(radar::Mode::beacon));
  pilot.press("pb 6");
  EXPECT_EQ(field("mode"), "BCN");
}

TEST_F(Rules, AModeChangeKeepsWhatRule23Lists) {
  for (const char* event : {"pb 17", "pb 2", "pb 3", "pb 4", "pb 9", "pb 16", "pb 19", "pb 20", "acq aft", "pb 7"})
    ASSERT_TRUE(pilot.press(event)) << event;
  Fields expected = fields_of(pilot);
  for (const char* mode : {"HRM", "BCN", "PVU", "RBM"}) {
    pilot.press("pb 6");
    expected["mode"] = expected["running"] = mode;
    EXPECT_EQ(fields_of(pilot), expected);
  }
}

TEST_F(Rules, TheVtrIsBoxedOnlyWhileARecorderWrites) {
  EXPECT_TRUE(pilot.press("pb 12"));
  EXPECT_STREQ(pilot.state.message, "NO RECORDER");
  EXPECT_FALSE(pilot.boxed(12));
  // The box shows that the recorder reports writing. Neither its presence nor the button sets the box.
  pilot.around.recorder_present = true;
  pilot.press("pb 12");
  EXPECT_FALSE(pilot.boxed(12));
  pilot.around.recorder_writing = true;
  pilot.wait();
  EXPECT_TRUE(pilot.boxed(12));
  pilot.press("pb 12");
  EXPECT_TRUE(pilot.boxed(12));
  EXPECT_EQ(pilot.state.vtr_request, 2U);
  pilot.around.recorder_writing = false;
  pilot.wait();
  EXPECT_FALSE(pilot.boxed(12));
  pilot.around.recorder_writing = true;
  pilot.around.recorder_present = false;  // the recorder has ended; its last report stays in the inputs
  pilot.wait();
  EXPECT_FALSE(pilot.boxed(12));
}

TEST_F(Rules, AFullDiskRemovesTheBoxAndShowsVtrFull) {
  pilot.around.recorder_present = pilot.around.recorder_writing = true;
  pilot.wait();
  pilot.around.recorder_writing = false;
  pilot.around.recorder_failed = true;
  pilot.wait();
  EXPECT_FALSE(pilot.boxed(12));
  EXPECT_STREQ(pilot.state.message, "VTR FULL");
  pilot.wait(700);
  EXPECT_STREQ(pilot.state.message, "");
  pilot.press("pb 12");
  EXPECT_STREQ(pilot.state.message, "VTR FULL");
  EXPECT_EQ(pilot.state.vtr_request, 0U);
}

TEST_F(Rules, StoppingTheVtrShowsNoMessage) {
  pilot.around.recorder_present = pilot.around.recorder_writing = true;
  pilot.wait();
  pilot.around.recorder_writing = false;
  pilot.wait();
  EXPECT_STREQ(pilot.state.message, "");
}

TEST_F(Rules, TheRequestToTheRecorderRemainsAfterPowerOff) {
  pilot.around.recorder_present = true;
  pilot.press("pb 12");
  pilot.press("power off");
  EXPECT_EQ(pilot.state.vtr_request, 1U);
}

TEST_F(Rules, AMessageDisappearsAfterThreeSeconds) {
  pilot.press("pb 12");
  pilot.wait(500);
  EXPECT_STREQ(pilot.state.message, "NO RECORDER");
  pilot.wait(200);
  EXPECT_STREQ(pilot.state.message, "");
}

TEST_F(Rules, ANewEpochRestartsTheScanAndResetsTheCursor) {
  pilot.press("pb 17");
  pilot.press("pb 12");
  const auto before = pilot.state.scan_restart;
  pilot.around.epoch = 7;
  pilot.around.ownship.latitude_deg = 45.0;
  pilot.wait();
  EXPECT_GT(pilot.state.scan_restart, before);
  EXPECT_EQ(pilot.state.epoch, 7U);
  EXPECT_STREQ(pilot.state.message, "");
  EXPECT_NEAR(pilot.state.cursor_range_nm, 0.5 * pilot.state.range_nm, 1e-6);
}

TEST_F(Rules, ARestartedStateMachineContinuesFromTheState) {
  for (const char* event : {"pb 9", "pb 3", "pb 3", "tdc 0.3 0.2", "freeze", "pb 11"}) pilot.press(event);
  Pilot successor;
  successor.around = pilot.around;
  successor.state = pilot.state;
  pilot.wait(50);
  successor.wait(50);
  EXPECT_EQ(std::memcmp(&pilot.state, &successor.state, sizeof pilot.state), 0);
  EXPECT_EQ(fields_of(successor).at("scan"), "HALF");
  EXPECT_EQ(fields_of(successor).at("gain"), "1");
  EXPECT_EQ(fields_of(successor).at("freeze"), "true");
}

TEST_F(Rules, NextIsForATourAndChangesNothingInAnyPower) {
  for (const char* power : {"power off", "power stby", "power opr"}) {
    pilot.send(power);
    const databuffer::RadarState before = pilot.state;
    const auto next = databuffer::event_from_text("next");
    ASSERT_TRUE(next);
    EXPECT_EQ(apply(pilot.state, *next, pilot.around, pilot.configuration), Effect::done) << power;
    EXPECT_EQ(std::memcmp(&pilot.state, &before, sizeof before), 0) << power;
  }
}

TEST_F(Rules, EventsWithInvalidNumbersAreDead) {
  using databuffer::EventKind;
  databuffer::InputEvent event{};
  const databuffer::RadarState untouched = pilot.state;
  for (const auto kind : {EventKind::push_button, EventKind::master_mode, EventKind::radar_mode, EventKind::power,
                          EventKind::navigator}) {
    for (const int argument : {-2, 0, 21, 300, 32767}) {
      // Argument 0 is the current position of these switches. Exceptions: no push button is 0, and power 0 is OFF.
      event.kind = static_cast<std::uint16_t>(kind);
      event.argument = static_cast<std::int16_t>(argument);
      if (kind == EventKind::power && argument == 0) continue;
      EXPECT_EQ(apply(pilot.state, event, pilot.around, pilot.configuration), Effect::none)
          << event.kind << " " << argument;
    }
  }
  event.x = kNaN;
  for (const auto kind : {EventKind::elevation, EventKind::tdc}) {
    event.kind = static_cast<std::uint16_t>(kind);
    EXPECT_EQ(apply(pilot.state, event, pilot.around, pilot.configuration), Effect::none);
  }
  EXPECT_EQ(std::memcmp(&pilot.state, &untouched, sizeof untouched), 0);
}

}  // namespace
}  // namespace yars::statemachine::testing
