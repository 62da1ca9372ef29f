// Learning: the dialogue of `input-monitor --learn`, which makes a device map from the controls that the user moves.
#include "inputmonitor/learning.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/schema/slot_text.hpp"
#include "inputmonitor/device_decoder.hpp"
#include "tests/inputmonitor/device_support.hpp"

namespace yars::inputmonitor {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kPushButtons = 20;

void skip_to(Learning& learning, const std::string& prompt) {
  while (!learning.finished() && !learning.prompt().starts_with(prompt)) learning.skip();
}

// Feeds values of an axis. Result: the texts of all answers.
std::string move(Learning& learning, const std::vector<int>& values, std::uint16_t code = ABS_X) {
  std::string output;
  for (const int value : values) output += learning.feed(axis(code, value));
  return output;
}

// The learned device, printed as `input-monitor --learn` writes it and read as `--config` reads it.
radar::Device read_back(const Learning& learning) {
  radar::RadarConfiguration configuration;
  configuration.devices.push_back(learning.device("learned"));
  return maps_of(config::print_devices(configuration.devices)).at(0);
}

TEST(Learning, TwentyButtonsAreRequestedInTurn) {
  Learning learning({}, {});
  for (int button = 1; button <= kPushButtons; ++button) {
    EXPECT_THAT(learning.prompt(), HasSubstr("PB " + std::to_string(button) + " ("));
    const auto code = std::uint16_t(0x120 + button);
    EXPECT_THAT(learning.feed(key(code, 1)), HasSubstr("is PB " + std::to_string(button)));
    EXPECT_THAT(learning.feed(key(code, 0)), IsEmpty());
  }
  const radar::Device device = read_back(learning);
  ASSERT_EQ(device.buttons.size(), 20U);
  EXPECT_EQ(device.buttons[19].code, "BTN_WEST");
  EXPECT_EQ(device.buttons[19].press, "pb 20");
}

TEST(Learning, SkipGoesToTheNextControlAndBackForgetsTheLastOne) {
  Learning learning({}, {});
  learning.skip();
  learning.feed(key(0x121, 1));
  learning.back();
  EXPECT_THAT(learning.prompt(), HasSubstr("PB 2 ("));
  learning.feed(key(0x122, 1));
  EXPECT_EQ(learning.learned(), 1U);
  const auto device = read_back(learning);
  ASSERT_EQ(device.buttons.size(), 1U);
  EXPECT_EQ(device.buttons[0].press, "pb 2");
  EXPECT_EQ(device.buttons[0].code, "button 3");
  for (int i = 0; i < 100; ++i) learning.back();
  EXPECT_THAT(learning.prompt(), HasSubstr("PB 1 ("));
  for (int i = 0; i < 100; ++i) learning.skip();
  EXPECT_TRUE(learning.finished());
  EXPECT_EQ(learning.learned(), 0U);
}

TEST(Learning, AButtonIsLearnedForOneControlOnly) {
  Learning learning({}, {});
  learning.feed(key(0x121, 1));
  EXPECT_THAT(learning.feed(key(0x121, 1)), HasSubstr("is PB 1 already"));
  EXPECT_THAT(learning.prompt(), HasSubstr("PB 2 ("));
}

// An axis of 0 to 255 with its rest position at 130. Its low end is to the right.
TEST(Learning, EndsCentreAndDirectionOfAnAxisAreLearned) {
  DeviceInfo info;
  info.axes[ABS_X] = AxisRange{0, 255};
  Learning learning(info, {{ABS_X, 130}});
  skip_to(learning, "TDC right");
  EXPECT_THAT(move(learning, {125, 135, 130, 128, 180, 131}), IsEmpty()) << "below 30 % of the range";
  EXPECT_THAT(move(learning, {60, 10, 5, 60}), IsEmpty()) << "the axis has not returned to its centre";
  EXPECT_THAT(move(learning, {130}), HasSubstr("ABS_X to its low end is TDC right"));
  EXPECT_THAT(move(learning, {5, 130}), HasSubstr("move the axis in the opposite direction"));
  EXPECT_THAT(move(learning, {250, 130}), HasSubstr("is TDC left"));
  const auto device = read_back(learning);
  ASSERT_EQ(device.axes.size(), 1U);
  const auto& axis = device.axes[0];
  EXPECT_EQ(axis.use, radar::AxisUse::tdc_x);
  EXPECT_EQ(std::tuple(axis.low, axis.high, axis.centre, axis.inverted), std::tuple(5.0, 250.0, 130.0, true));
}

TEST(Learning, OneLearnedDirectionIsMirroredToTheOther) {
  DeviceInfo info;
  info.axes[ABS_Y] = AxisRange{-100, 100};
  Learning learning(info, {{ABS_Y, 0}});
  skip_to(learning, "TDC down");
  move(learning, {90, 0}, ABS_Y);
  const auto axis = read_back(learning).axes.at(0);
  EXPECT_EQ(std::tuple(axis.low, axis.high, axis.centre, axis.inverted), std::tuple(-90.0, 90.0, 0.0, true));
}

// The stick returns to 6 of 100. The dead zone is twice that offset.
TEST(Learning, TheDeadZoneIsTwiceTheOffsetAfterTheReturn) {
  DeviceInfo info;
  info.axes[ABS_X] = AxisRange{-100, 100};
  Learning learning(info, {{ABS_X, 0}});
  skip_to(learning, "TDC right");
  move(learning, {100, 6});
  EXPECT_DOUBLE_EQ(read_back(learning).axes.at(0).dead_zone, 0.12);
}

TEST(Learning, WithoutAKnownRangeAFixedTravelIsAMovement) {
  Learning learning({}, {});
  skip_to(learning, "TDC right");
  EXPECT_THAT(move(learning, {1000, 1060, 1000}), IsEmpty());
  EXPECT_THAT(move(learning, {1100, 1000}), HasSubstr("ABS_X to its high end is TDC right"));
  EXPECT_FALSE(read_back(learning).axes.at(0).inverted);
}

TEST(Learning, AButtonIsRefusedWhenAnAxisIsRequested) {
  Learning learning({}, {});
  skip_to(learning, "TDC right");
  EXPECT_THAT(learning.feed(key(0x121, 1)), HasSubstr("an axis is expected"));
  EXPECT_THAT(learning.prompt(), HasSubstr("TDC right"));
}

TEST(Learning, AMoveThatBeganBeforeAButtonIsNotTheNextControl) {
  DeviceInfo info;
  info.axes[ABS_X] = AxisRange{0, 255};
  Learning learning(info, {{ABS_X, 130}});
  EXPECT_THAT(move(learning, {250}), IsEmpty());
  EXPECT_THAT(learning.feed(key(0x121, 1)), HasSubstr("is PB 1"));
  EXPECT_THAT(move(learning, {130}), IsEmpty());
  EXPECT_THAT(learning.prompt(), HasSubstr("PB 2 ("));
}

TEST(Learning, AHatIsLearnedAsTwoButtons) {
  Learning learning({}, {});
  skip_to(learning, "ACQ forward");
  EXPECT_THAT(move(learning, {-1, 0}, ABS_HAT0Y), HasSubstr("ABS_HAT0Y to its low end is ACQ forward"));
  EXPECT_THAT(move(learning, {1, 0}, ABS_HAT0Y), HasSubstr("is ACQ aft"));
  const auto device = read_back(learning);
  ASSERT_EQ(device.axes.size(), 1U);
  DeviceDecoder decoder(*resolve_map(device, {}));
  for (const int value : {-1, 0, 1, 0}) decoder.feed(axis(ABS_HAT0Y, value), 0);
  EXPECT_THAT(texts_of(decoder.take(0)), ElementsAre("acq fwd", "acq aft"));
}

TEST(Learning, TheMapHasVendorAndProductOfAKnownDevice) {
  DeviceInfo info;
  info.known = true;
  info.vendor = 0x044f;
  info.product = 0xb351;
  Learning learning(info, {});
  learning.feed(key(0x120, 1));
  const auto device = read_back(learning);
  EXPECT_EQ(device.vendor, "044f");
  EXPECT_EQ(device.products, "b351");
}

TEST(Learning, ExtremeValuesAndCodesGiveAValidMap) {
  Learning learning({}, {});
  for (const int value : {2147483647, -2147483647 - 1, 0, 2147483647})
    for (int code = 0; code < 0x10000; code += 7) {
      learning.feed({EV_ABS, std::uint16_t(code), value});
      learning.feed({EV_KEY, std::uint16_t(code), 1});
    }
  radar::RadarConfiguration configuration;
  configuration.devices.push_back(learning.device("learned"));
  maps_of(config::print_devices(configuration.devices));
}

}  // namespace
}  // namespace yars::inputmonitor
