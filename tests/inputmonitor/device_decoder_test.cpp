// DeviceDecoder: input events from the raw events of a device. Codes: 0x120 + n is "button n + 1", 0x2c0 "button 17".
#include "inputmonitor/device_decoder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "databuffer/messages/validation.hpp"
#include "tests/inputmonitor/device_support.hpp"

namespace yars::inputmonitor {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr const char* kPanel = R"(
  :buttons `( ( Button "button 1" "tdc press" ) ( Button "button 2" "pb 13" ) ( Button "button 17" "freeze" )
              ( Button "button 3" "elevation up" :repeat 0.1 ) ( Button "button 4" "tdc 0 0.5" )
              ( Button "button 5" "power opr" "power stby" ) )
  :axes `( ( Axis "ABS_X" tdcX :low -100 :high 100 :deadZone 0 ) ( Axis "ABS_Y" tdcY :low -100 :high 100 :deadZone 0 )
           ( Axis "ABS_HAT0X" directions :positive "pb 9" :negative "pb 8" )
           ( Axis "ABS_RZ" elevation :low 0 :high 100 :deadZone 0 :lowest -10 :highest 10 )
           ( Axis "ABS_THROTTLE" lever :low 0 :high 100 :deadZone 0 :steps 4 :positive "contrast up"
             :negative "contrast down" ) ))";

class Panel : public ::testing::Test {
 protected:
  // Feeds the events 20 ms apart, so that no rate limit applies. Result: the input events.
  std::vector<std::string> play(const std::vector<RawEvent>& events) {
    std::vector<std::string> all;
    for (const RawEvent& event : events) {
      now_ns_ += 20 * kMillisecond_ns;
      decoder_.feed(event, now_ns_);
      for (auto& text : texts_of(decoder_.take(now_ns_))) all.push_back(std::move(text));
    }
    return all;
  }
  std::vector<std::string> take_after(std::int64_t milliseconds) {
    now_ns_ += milliseconds * kMillisecond_ns;
    return texts_of(decoder_.take(now_ns_));
  }

  DeviceDecoder decoder_{ready(kPanel)};
  std::int64_t now_ns_ = 1'000'000'000;
};

TEST_F(Panel, AButtonSendsTheEventsOfItsMap) {
  EXPECT_THAT(play({key(0x121, 1), key(0x121, 0), kReport}), ElementsAre("pb 13"));
  EXPECT_THAT(play({key(0x2c0, 1), key(0x2c0, 0)}), ElementsAre("freeze")) << "button 17";
  EXPECT_THAT(play({key(0x124, 1), key(0x124, 0)}), ElementsAre("power opr", "power stby"));
  EXPECT_THAT(play({key(0x12f, 1), key(0x12f, 0)}), IsEmpty()) << "not in the map";
}

TEST_F(Panel, ATdcPressIsReleasedWithItsButton) {
  EXPECT_THAT(play({key(BTN_TRIGGER, 1), key(BTN_TRIGGER, 0)}), ElementsAre("tdc press", "tdc release"));
}

TEST_F(Panel, ARepeatedPressOrReleaseIsIgnored) {
  EXPECT_THAT(play({key(0x121, 1), key(0x121, 1), key(0x121, 2), key(0x121, 0), key(0x121, 0)}), ElementsAre("pb 13"));
}

TEST_F(Panel, BothAxesAreOneDeflection) {
  EXPECT_THAT(play({axis(ABS_X, 50), axis(ABS_Y, -25), axis(ABS_X, 0), axis(ABS_Y, 0)}),
              ElementsAre("tdc 0.5 0", "tdc 0.5 -0.25", "tdc 0 -0.25", "tdc 0 0"));
}

TEST_F(Panel, AButtonMayAddToTheDeflection) {
  EXPECT_THAT(play({axis(ABS_Y, 25), key(0x123, 1), axis(ABS_Y, 100), key(0x123, 0)}),
              ElementsAre("tdc 0 0.25", "tdc 0 0.75", "tdc 0 1"));
}

TEST_F(Panel, AStickSendsAtMostEveryTenMilliseconds) {
  EXPECT_THAT(play({axis(ABS_X, 10)}), ElementsAre("tdc 0.1 0"));
  for (int value = 11; value <= 40; ++value) decoder_.feed(axis(ABS_X, value), now_ns_);
  EXPECT_THAT(take_after(9), IsEmpty());
  EXPECT_EQ(decoder_.deadline_ns(), now_ns_ + kMillisecond_ns);
  EXPECT_THAT(take_after(1), ElementsAre("tdc 0.4 0"));
  EXPECT_EQ(decoder_.deadline_ns(), std::nullopt);
}

TEST_F(Panel, APressSendsThePendingDeflectionFirst) {
  EXPECT_THAT(play({axis(ABS_X, 10)}), ElementsAre("tdc 0.1 0"));
  for (const RawEvent& event : {axis(ABS_X, 90), key(BTN_TRIGGER, 1), axis(ABS_X, 0)}) decoder_.feed(event, now_ns_);
  EXPECT_THAT(take_after(0), ElementsAre("tdc 0.9 0", "tdc press"));
  EXPECT_THAT(take_after(10), ElementsAre("tdc 0 0"));
}

TEST_F(Panel, AHatIsTwoButtons) {
  EXPECT_THAT(play({axis(ABS_HAT0X, 1), axis(ABS_HAT0X, 0), axis(ABS_HAT0X, -1), axis(ABS_HAT0X, 1)}),
              ElementsAre("pb 9", "pb 8", "pb 9"));
}

TEST_F(Panel, AHeldButtonRepeatsItsEvent) {
  EXPECT_THAT(play({key(0x122, 1)}), ElementsAre("elevation up"));
  EXPECT_THAT(take_after(99), IsEmpty());
  EXPECT_EQ(decoder_.deadline_ns(), now_ns_ + kMillisecond_ns);
  EXPECT_THAT(take_after(1), ElementsAre("elevation up"));
  EXPECT_THAT(take_after(5000), ElementsAre("elevation up")) << "missed repetitions are not sent later";
  EXPECT_THAT(play({key(0x122, 0)}), IsEmpty());
  EXPECT_THAT(take_after(5000), IsEmpty());
}

TEST_F(Panel, AnElevationAxisCoversItsConfiguredRange) {
  EXPECT_THAT(play({axis(ABS_RZ, 0), axis(ABS_RZ, 75), axis(ABS_RZ, 100)}),
              ElementsAre("elevation -10", "elevation 5", "elevation 10"));
}

// The lever has 4 positions of 25 counts each, from 0 to 100.
TEST_F(Panel, ALeverStepsFromPositionToPosition) {
  EXPECT_THAT(play({axis(ABS_THROTTLE, 10)}), IsEmpty()) << "the first value only sets the position";
  EXPECT_THAT(play({axis(ABS_THROTTLE, 60)}), ElementsAre("contrast up", "contrast up"));
  EXPECT_THAT(play({axis(ABS_THROTTLE, 48), axis(ABS_THROTTLE, 52)}), IsEmpty()) << "jitter at a border";
  EXPECT_THAT(play({axis(ABS_THROTTLE, 40)}), ElementsAre("contrast down"));
}

TEST_F(Panel, TheInitialStateSendsTheDeflectionButNoElevationOrLeverStep) {
  decoder_.begin({{}, {{ABS_X, 100}, {ABS_RZ, 80}, {ABS_THROTTLE, 100}, {ABS_HAT0X, 1}}});
  EXPECT_THAT(take_after(0), ElementsAre("tdc 1 0"));
  EXPECT_THAT(play({axis(ABS_RZ, 80), axis(ABS_THROTTLE, 99)}), IsEmpty());
  EXPECT_THAT(play({axis(ABS_RZ, 75)}), ElementsAre("elevation 5"));
}

TEST_F(Panel, ReleaseAllReleasesButtonsAndStick) {
  play({key(BTN_TRIGGER, 1), key(0x124, 1), key(0x122, 1), axis(ABS_X, 100)});
  decoder_.release_all();
  EXPECT_THAT(take_after(1000), ElementsAre("tdc release", "tdc 0 0")) << "a switch keeps its position";
  EXPECT_THAT(take_after(1000), IsEmpty());
}

TEST_F(Panel, AfterLostEventsTheStateOfTheDeviceIsApplied) {
  play({key(BTN_TRIGGER, 1), axis(ABS_X, 50)});
  EXPECT_THAT(play({kDropped, key(0x121, 1), axis(ABS_X, 99)}), IsEmpty()) << "ignored until the report ends";
  EXPECT_FALSE(decoder_.needs_resync());
  play({kReport});
  ASSERT_TRUE(decoder_.needs_resync());
  DeviceState state;
  state.buttons.set(0x2c0);
  state.axes = {{ABS_X, -50}};
  decoder_.resync(state, now_ns_);
  EXPECT_THAT(take_after(20), ElementsAre("tdc release", "freeze", "tdc -0.5 0"));
  EXPECT_FALSE(decoder_.needs_resync());
  EXPECT_THAT(play({key(0x121, 1)}), ElementsAre("pb 13"));
}

TEST_F(Panel, AfterLostEventsOfADeviceWithoutStateAllControlsAreReleased) {
  play({key(BTN_TRIGGER, 1), axis(ABS_X, 50), kDropped, kReport});
  decoder_.resync(std::nullopt, now_ns_);
  EXPECT_THAT(take_after(20), ElementsAre("tdc release", "tdc 0 0"));
}

TEST_F(Panel, PressesAboveTheRateLimitAreDropped) {
  for (int i = 0; i < 1000; ++i)
    for (const int value : {1, 0}) decoder_.feed(key(BTN_TRIGGER, value), now_ns_);
  EXPECT_EQ(take_after(0).size(), std::size_t(2 * kPressBurst)) << "each press with its release";
  EXPECT_EQ(decoder_.dropped(), 1000 - std::uint64_t(kPressBurst));
  EXPECT_THAT(take_after(1000), IsEmpty());
  EXPECT_THAT(play({key(0x121, 1)}), ElementsAre("pb 13")) << "after a second of rest";
}

// Each event from random raw events passes the validation of state-machine.
TEST(Decoder, RandomRawEventsGiveValidEvents) {
  std::mt19937 random(20260101);
  DeviceDecoder decoder(ready(kPanel));
  std::int64_t now_ns = 0;
  std::size_t count = 0;
  for (int i = 0; i < 200'000; ++i) {
    const std::uint16_t type = std::uint16_t(random() % 5);
    const std::uint16_t code = random() % 2 == 0 ? std::uint16_t(random()) : std::uint16_t(random() % 0x30);
    const std::int32_t value = random() % 4 == 0 ? std::int32_t(random()) : std::int32_t(random() % 3) - 1;
    decoder.feed({type, code, value}, now_ns);
    if (decoder.needs_resync()) decoder.resync(std::nullopt, now_ns);
    now_ns += std::int64_t(random() % 10) * kMillisecond_ns;
    for (const auto& event : decoder.take(now_ns)) {
      ASSERT_FALSE(databuffer::validate(event)) << databuffer::text_of(event);
      ++count;
    }
  }
  EXPECT_GT(count, 300U);
}

}  // namespace
}  // namespace yars::inputmonitor
