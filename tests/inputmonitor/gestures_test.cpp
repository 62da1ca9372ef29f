// Gestures in a device's events: presses, pushes, sweeps, and what is none.
#include "inputmonitor/gestures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/inputmonitor/device_support.hpp"

namespace yars::inputmonitor {
namespace {

using namespace testing;
using Kind = Gesture::Kind;
using Wanted = GestureDetector::Wanted;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A detector with a clock: each event is 5 ms after the one before.
class Device {
 public:
  Device(const std::map<std::uint16_t, AxisRange>& ranges,
         const std::vector<std::pair<std::uint16_t, std::int32_t>>& rest)
      : detector(info_of(ranges), rest) {
    detector.begin(Wanted::push);
  }
  // The gestures in these values of an axis.
  std::vector<Gesture> move(std::uint16_t code, const std::vector<int>& values) {
    std::vector<Gesture> found;
    for (const int value : values) {
      now_ns += 5 * kMillisecond_ns;
      const Gesture gesture = detector.feed(axis(code, value), now_ns);
      if (gesture.kind != Kind::nothing) found.push_back(gesture);
    }
    return found;
  }
  Gesture wait(std::int64_t time_ns) {
    now_ns += time_ns;
    return detector.wait(now_ns);
  }

  GestureDetector detector;
  std::int64_t now_ns = 0;

 private:
  static DeviceInfo info_of(const std::map<std::uint16_t, AxisRange>& ranges) {
    DeviceInfo info;
    for (const auto& [code, range] : ranges) info.axes[code] = range;
    return info;
  }
};

std::vector<int> directions_of(const std::vector<Gesture>& gestures) {
  std::vector<int> directions;
  for (const Gesture& gesture : gestures)
    if (gesture.kind == Kind::push) directions.push_back(gesture.direction);
  return directions;
}

TEST(Gestures, APushHasItsDirectionExtremeAndRest) {
  Device stick({{ABS_X, {0, 255}}}, {{ABS_X, 130}});
  EXPECT_THAT(stick.move(ABS_X, {125, 135, 130, 128, 140, 131}), IsEmpty()) << "jitter";
  EXPECT_THAT(stick.move(ABS_X, {60, 10, 5, 60}), IsEmpty()) << "it has not come back";
  EXPECT_TRUE(stick.detector.is_held());
  const auto found = stick.move(ABS_X, {130});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(std::tuple(found[0].kind, found[0].direction, found[0].extreme, found[0].rest),
            std::tuple(Kind::push, -1, 5.0, 130.0));
  EXPECT_FALSE(stick.detector.is_held());
}

TEST(Gestures, AShortPushIsNamedAsSuch) {
  Device stick({{ABS_X, {0, 255}}}, {{ABS_X, 130}});
  const auto found = stick.move(ABS_X, {180, 131});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, Kind::too_short);
}

TEST(Gestures, AHatPushedBothWaysIsTwoPushes) {
  Device pad({}, {});
  EXPECT_THAT(directions_of(pad.move(ABS_HAT0Y, {-1, 0, 1, 0})), ElementsAre(-1, 1));
}

TEST(Gestures, AnAxisWithoutAKnownRangeMovesByAFixedTravel) {
  Device stick({}, {});
  EXPECT_THAT(directions_of(stick.move(ABS_X, {1000, 1060, 1000})), IsEmpty());
  EXPECT_THAT(directions_of(stick.move(ABS_X, {1100, 1000})), ElementsAre(1));
}

// A push to the right takes the other axis along, whichever of the two comes back first.
TEST(Gestures, OfTwoAxesTheOneThatMovedMoreCounts) {
  Device stick({{ABS_X, {0, 255}}, {ABS_Y, {0, 255}}}, {{ABS_X, 128}, {ABS_Y, 128}});
  EXPECT_THAT(stick.move(ABS_X, {255}), IsEmpty());
  EXPECT_THAT(stick.move(ABS_Y, {210, 128}), IsEmpty()) << "the other axis is still out";
  EXPECT_THAT(directions_of(stick.move(ABS_X, {128})), ElementsAre(1));
  stick.move(ABS_X, {255});
  stick.move(ABS_Y, {210});
  EXPECT_THAT(directions_of(stick.move(ABS_X, {128})), ElementsAre(1));
  stick.detector.begin(Wanted::push);
  EXPECT_THAT(stick.move(ABS_Y, {128}), IsEmpty()) << "the end of the push before";
  EXPECT_THAT(directions_of(stick.move(ABS_Y, {255, 128})), ElementsAre(1));
}

// Triggers of pads are a button and an axis at once.
TEST(Gestures, AnAxisThatMovesWithAPressIsNoGesture) {
  Device pad({{ABS_Z, {0, 255}}}, {{ABS_Z, 0}});
  EXPECT_EQ(pad.detector.feed(key(BTN_TL2, 1), pad.now_ns).kind, Kind::press);
  pad.detector.begin(Wanted::push, true);
  EXPECT_EQ(pad.detector.feed(axis(ABS_Z, 100), pad.now_ns).kind, Kind::nothing);
  pad.detector.feed(kReport, pad.now_ns);
  EXPECT_THAT(pad.move(ABS_Z, {255, 120, 0}), IsEmpty());
  EXPECT_THAT(directions_of(pad.move(ABS_Z, {255, 0})), ElementsAre(1)) << "the next one counts";
}

TEST(Gestures, AWrongRestValueIsMended) {
  Device stick({{ABS_X, {0, 255}}}, {{ABS_X, 0}});  // reports 0 before its first move
  EXPECT_THAT(stick.move(ABS_X, {200, 255, 128}), IsEmpty());
  EXPECT_EQ(stick.wait(kStill_ns / 2).kind, Kind::nothing);
  EXPECT_EQ(stick.wait(kStill_ns).kind, Kind::new_rest);
  const auto found = stick.move(ABS_X, {255, 128});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].rest, 128.0);
}

TEST(Gestures, AStickThatIsHeldKeepsItsRestValue) {
  Device stick({{ABS_X, {0, 255}}}, {{ABS_X, 128}});
  stick.move(ABS_X, {255});
  EXPECT_EQ(stick.wait(10 * kStill_ns).kind, Kind::nothing);
  EXPECT_THAT(directions_of(stick.move(ABS_X, {128})), ElementsAre(1));
}

// The stick passes 150 on its way back and stays at 134.
TEST(Gestures, TheErrorOfTheRestValueIsThatOfTheLongestStay) {
  Device stick({{ABS_X, {0, 255}}}, {{ABS_X, 128}});
  stick.move(ABS_X, {255, 150, 134});
  EXPECT_EQ(stick.detector.rest_error(ABS_X), 6.0);
  stick.now_ns += 500 * kMillisecond_ns;
  stick.move(ABS_X, {140, 255, 140, 128});
  EXPECT_EQ(stick.detector.rest_error(ABS_X), 6.0);
}

TEST(Gestures, ASweepIsFoundWhereItIsLeft) {
  Device slider({{ABS_THROTTLE, {0, 1000}}}, {{ABS_THROTTLE, 400}});
  slider.detector.begin(Wanted::sweep);
  EXPECT_THAT(slider.move(ABS_THROTTLE, {200, 10, 500, 990}), IsEmpty());
  const Gesture found = slider.wait(kStill_ns);
  EXPECT_EQ(std::tuple(found.kind, found.direction, found.extreme, found.rest),
            std::tuple(Kind::sweep, 1, 990.0, 10.0));
  slider.detector.begin(Wanted::sweep);
  slider.move(ABS_THROTTLE, {600, 990, 500});
  EXPECT_EQ(slider.wait(kStill_ns).kind, Kind::nothing) << "half of the travel, and left in the middle";
}

}  // namespace
}  // namespace yars::inputmonitor
