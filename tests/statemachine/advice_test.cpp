// Advice for the pilot: what each button does now, or why it is dead, agrees with what the button does.
// Source: docs/pilots_manual.md#remedies.
#include "statemachine/advice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "databuffer/messages/validation.hpp"
#include "tests/statemachine/pilot.hpp"

namespace yars::statemachine::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

databuffer::PilotAdvice advice_of(const Pilot& pilot) {
  databuffer::PilotAdvice advice{};
  advise(advice, pilot.state, pilot.around, pilot.configuration);
  return advice;
}

std::string words(const Pilot& pilot, int button) {
  return advice_of(pilot).buttons[button];
}

TEST(Advice, ALiveButtonSaysWhatThePressWillGive) {
  Pilot pilot;
  pilot.press("power opr");
  pilot.press("pb 13");
  EXPECT_EQ(words(pilot, 2), "declutter: on");
  EXPECT_EQ(words(pilot, 3), "receiver gain: GAIN 2");
  EXPECT_EQ(words(pilot, 6), "next mode: HRM");
  EXPECT_EQ(words(pilot, 7), "cursor function: UPDT");
  EXPECT_EQ(words(pilot, 9), "scan width: HALF");
  EXPECT_EQ(words(pilot, 14), "shorter range: 20 NM");
  EXPECT_EQ(words(pilot, 17), "next sequence point: 1.1");
  pilot.press("pb 2");
  EXPECT_EQ(words(pilot, 2), "declutter: off");
}

TEST(Advice, ADeadButtonSaysWhyAndWhatToDo) {
  Pilot pilot;
  EXPECT_EQ(words(pilot, 13), "dead while the power is OFF; switch on: power opr (O)");
  pilot.press("power opr");
  EXPECT_EQ(words(pilot, 1), "dead in every mode");
  EXPECT_EQ(words(pilot, 8), "dead in RBM; live in patch map");
  EXPECT_EQ(words(pilot, 12), "NO RECORDER; start one: Record in the browser, or yars record FILE");
  pilot.press("freeze");
  EXPECT_EQ(words(pilot, 6), "dead while frozen; end the freeze: freeze (Space)");
  pilot.press("freeze");
  pilot.press("pb 11");
  EXPECT_EQ(words(pilot, 9), "dead in MENU; back to the radar: pb 6 (6)");
  pilot.press("pb 6");
  pilot.press("mode aa");
  EXPECT_EQ(words(pilot, 9), "dead in AA; back to A/G: mode ag (F5)");
}

TEST(Advice, TheTdcsSwitchSaysWhatItDoesByTheCursorFunctionOrWhyNot) {
  Pilot pilot;
  pilot.press("power opr");
  pilot.configuration.high_resolution.blind_zone_deg = 8.0;
  pilot.press("sp 2");
  EXPECT_THAT(words(pilot, 0), StartsWith("BLIND ZONE; turn 8 deg or more left"));
  pilot.press("sp 1");
  EXPECT_EQ(words(pilot, 0), "commands a map at the cursor");
  for (int press = 0; press < 3; ++press) pilot.press("pb 7");
  EXPECT_EQ(words(pilot, 0), "designates a target at the cursor");
}

TEST(Advice, TheTdcsSwitchNamesABlankWindowAndACursorOffTheDisplay) {
  Pilot pilot;
  pilot.press("power opr");
  for (int step = 0; step < 4; ++step) pilot.press("acq aft");
  EXPECT_EQ(words(pilot, 0), "commands a map at the cursor; blank window: 3.3 NM; acq fwd (PgUp)");
  pilot.press("acq fwd");
  EXPECT_EQ(words(pilot, 0), "commands a map at the cursor");
  for (int press = 0; press < 2; ++press) pilot.press("pb 14");
  EXPECT_EQ(words(pilot, 0), "commands a map at the cursor; off the display: tdc (arrows)");
  pilot.press("tdc 0 1");
  pilot.press("tdc 0 0");
  EXPECT_EQ(words(pilot, 0), "commands a map at the cursor") << "at the edge";
}

TEST(Advice, ALongRemedyIsCutAtAnAlternative) {
  Pilot pilot;
  pilot.configuration.route.push_back(route_point("9", radar::PointKind::steer, position(30.0, 30.0)));
  pilot.press("power opr");
  pilot.press("pb 13");
  pilot.press("sp 9");
  for (int step = 0; step < 3; ++step) pilot.press("acq aft");
  EXPECT_EQ(words(pilot, 0), "MAX RANGE; move the cursor in to 20.0 NM or less");
}

TEST(Advice, LiveBitsAgreeWithThePressInEveryMode) {
  for (const char* mode :
       {"OFF", "STBY", "RBM", "HRM", "MAPS", "PATCH", "BCN", "PVU", "AA", "AGR", "MENU", "AAMAP", "AASET", "AGSET"}) {
    for (const bool frozen : {false, true}) {
      Pilot pilot;
      bring_into(pilot, mode, frozen);
      const databuffer::PilotAdvice advice = advice_of(pilot);
      EXPECT_EQ(validate(advice), std::nullopt);
      for (int button = 1; button <= 20; ++button) {
        Pilot other = pilot;
        const auto event = databuffer::event_from_text("pb " + std::to_string(button));
        const bool done = apply(other.state, *event, other.around, other.configuration) == Effect::done;
        EXPECT_EQ((advice.live >> button & 1U) != 0, done)
            << mode << " PB " << button << ": " << advice.buttons[button];
        EXPECT_STRNE(advice.buttons[button], "") << mode << " PB " << button;
      }
    }
  }
}

TEST(Advice, TryingTheButtonsLeavesTheStateAlone) {
  Pilot pilot;
  bring_into(pilot, "PATCH", false);
  const databuffer::RadarState before = pilot.state;
  advice_of(pilot);
  EXPECT_EQ(std::memcmp(&before, &pilot.state, sizeof before), 0);
}

TEST(Advice, AnEventWithoutEffectIsNotedWithItsReason) {
  Pilot pilot;
  pilot.press("power opr");
  databuffer::PilotAdvice advice{};
  auto event = *databuffer::event_from_text("pb 8");
  event.number = 7;
  note_idle(advice, {event, 3, false}, pilot.state, pilot.around, pilot.configuration);
  EXPECT_EQ(advice.idle_count, 1U);
  EXPECT_EQ(advice.idle_lane, 3U);
  EXPECT_EQ(advice.idle_number, 7U);
  EXPECT_STREQ(advice.idle_reason, "dead in RBM; live in patch map");
}

// Reason and remedy of a dead event.
std::string without_effect(const Pilot& pilot, const char* event) {
  return text_of(reason_without_effect(pilot.state, *databuffer::event_from_text(event)));
}

TEST(Advice, UpdtNamesThePointTheAgeOrTheZeroError) {
  Pilot pilot;
  pilot.press("power opr");
  pilot.press("pb 7");
  pilot.press("sp 1");
  pilot.wait(2);
  EXPECT_FALSE(pilot.press("tdc release"));
  EXPECT_THAT(without_effect(pilot, "tdc release"), StartsWith("changed nothing: the errors are 0"));
  pilot.press("nav ins");
  pilot.wait(6'100);
  EXPECT_FALSE(pilot.press("tdc release"));
  EXPECT_THAT(without_effect(pilot, "tdc release"), StartsWith("INV: the cursor is too old"));
  pilot.state.sequence_point[0] = '\0';
  EXPECT_THAT(without_effect(pilot, "tdc release"), HasSubstr("no sequence point is selected; select one: sp 1"));
}

TEST(Advice, AcqWithTgtNamesTheMissingTarget) {
  Pilot pilot;
  pilot.press("power opr");
  for (int press = 0; press < 3; ++press) pilot.press("pb 7");
  EXPECT_FALSE(pilot.press("acq aft"));
  EXPECT_EQ(without_effect(pilot, "acq aft"), "dead without a target; designate one first: tdc release (Enter)");
  pilot.press("tdc release");
  EXPECT_FALSE(pilot.press("acq fwd"));
  EXPECT_THAT(without_effect(pilot, "acq fwd"), HasSubstr("follows the line of sight"));
}

TEST(Advice, TheCursorGoesWhereTheMousePoints) {
  Pilot pilot;
  pilot.press("power opr");
  ASSERT_TRUE(pilot.press("cursor 0.5 0.5"));
  // The middle of the display is half the range ahead: heights run from -0.1 to 1.1.
  EXPECT_NEAR(pilot.state.cursor_range_nm, 0.5 * pilot.state.range_nm, 0.01);
  ASSERT_TRUE(pilot.press("cursor 1 0.5"));
  EXPECT_NEAR(pilot.state.cursor_range_nm, std::hypot(0.5, 0.6) * pilot.state.range_nm, 0.05);
  EXPECT_FALSE(databuffer::event_from_text("cursor 1.1 0"));
  EXPECT_FALSE(databuffer::event_from_text("cursor -0.1 0"));
  pilot.press("radar pvu");
  EXPECT_FALSE(pilot.press("cursor 0.2 0.2"));
}

TEST(Advice, OnAPatchMapTheMiddleOfTheDisplayIsTheMiddleOfTheMap) {
  Pilot pilot;
  bring_into(pilot, "PATCH", false);
  ASSERT_TRUE(pilot.press("cursor 0.25 0.25"));
  ASSERT_TRUE(pilot.press("cursor 0.5 0.5"));
  EXPECT_NEAR(pilot.state.cursor_latitude_deg, pilot.state.map_latitude_deg, 1e-6);
  EXPECT_NEAR(pilot.state.cursor_longitude_deg, pilot.state.map_longitude_deg, 1e-6);
}

}  // namespace
}  // namespace yars::statemachine::testing
