// Selection of the map that fits a device, and resolving of the map: travel of the axes, codes of the buttons.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inputmonitor/device_decoder.hpp"
#include "tests/inputmonitor/device_support.hpp"

namespace yars::inputmonitor {
namespace {

using namespace testing;
using ::testing::HasSubstr;

DeviceInfo info_of(std::uint16_t vendor, std::uint16_t product, const std::string& name,
                   const std::vector<std::uint16_t>& buttons) {
  DeviceInfo info;
  info.known = true;
  info.vendor = vendor;
  info.product = product;
  info.name = name;
  for (const std::uint16_t code : buttons) info.buttons.set(code);
  return info;
}

std::string fitting_name(const DeviceInfo& info, const std::vector<radar::Device>& maps) {
  const auto* map = fitting_map(info, maps);
  return map == nullptr ? "" : map->name;
}

TEST(FittingMap, IsFoundByVendorAndProductElseByTheButtonsOfTheDevice) {
  const auto maps = shipped_maps();
  EXPECT_EQ(fitting_name(info_of(0x044f, 0xb351, "Cougar MFD 1", {0x120, 0x2c0}), maps), "mfd-cougar");
  EXPECT_EQ(fitting_name(info_of(0x044f, 0xb352, "Cougar MFD 2", {0x120, 0x2c0}), maps), "mfd-cougar");
  EXPECT_EQ(fitting_name(info_of(0x044f, 0xb10a, "T.16000M", {0x120}), maps), "t16000m");
  EXPECT_EQ(fitting_name(info_of(0x1234, 0x5678, "some stick", {BTN_TRIGGER}), maps), "stick");
  EXPECT_EQ(fitting_name(info_of(0x045e, 0x028e, "some pad", {BTN_SOUTH}), maps), "pad");
  EXPECT_EQ(fitting_name(info_of(0x0001, 0x0001, "AT keyboard", {KEY_A, KEY_ENTER}), maps), "");
  EXPECT_EQ(fitting_name({}, maps), "") << "a FIFO has no device information";
}

TEST(FittingMap, TheLastFittingMapIsSelected) {
  const auto maps = maps_of(R"(( Devices `( ( Device "any" :pattern "*" ) ( Device "stick" :pattern "*stick*" )
                                            ( Device "by name alone" ) ) ))");
  EXPECT_EQ(fitting_name(info_of(1, 1, "Some Stick 3", {}), maps), "stick");
  EXPECT_EQ(fitting_name(info_of(1, 1, "Some Pad", {}), maps), "any");
}

TEST(ReadyMap, TheCougarsButtonsAreThePushButtonsInOppositeOrder) {
  const auto maps = shipped_maps();
  DeviceDecoder decoder(*resolve_map(*named_map("mfd-cougar", maps), {}));
  // The device numbers its buttons clockwise from the top left. The MPD numbers them counter-clockwise from the top of
  // the left side (docs/pilots_manual.md#buttons).
  for (int button = 1; button <= 20; ++button) {
    const auto code = std::uint16_t(button <= 16 ? 0x120 + button - 1 : 0x2c0 + button - 17);
    const std::int64_t now_ns = button * 1'000'000'000LL;
    decoder.feed(key(code, 1), now_ns);
    decoder.feed(key(code, 0), now_ns);
    EXPECT_EQ(texts_of(decoder.take(now_ns)), std::vector{"pb " + std::to_string(21 - button)}) << button;
  }
}

TEST(ReadyMap, AnAxisHasTheTravelOfTheDeviceUnlessTheMapGivesOne) {
  const auto maps = maps_of(R"(( Devices `( ( Device "it" :axes `( ( Axis "ABS_X" ) ( Axis "ABS_Y" :low 0 :high 10 )
                                                                   ( Axis "ABS_Z" ) ) ) ) ))");
  DeviceInfo info = info_of(1, 1, "it", {});
  info.axes[ABS_X] = AxisRange{-512, 511};
  info.axes[ABS_Y] = AxisRange{-512, 511};
  const auto map = resolve_map(maps[0], info);
  ASSERT_TRUE(map);
  ASSERT_EQ(map->axes.size(), 2U) << "the device has no ABS_Z";
  EXPECT_EQ(map->axes[0].shape.low, -512.0);
  EXPECT_EQ(map->axes[0].shape.centre, -0.5);
  EXPECT_EQ(map->axes[1].shape.high, 10.0);
  EXPECT_EQ(map->axes[1].shape.centre, 5.0);
}

TEST(ReadyMap, AnAxisWithoutTravelIsAnError) {
  const auto maps = maps_of(R"(( Devices `( ( Device "it" :axes `( ( Axis "ABS_X" ) ) ) ) ))");
  const auto map = resolve_map(maps[0], {});
  ASSERT_FALSE(map);
  EXPECT_THAT(map.error().message(), HasSubstr("ABS_X"));
  EXPECT_THAT(map.error().message(), HasSubstr(":low and :high"));
}

TEST(ReadyMap, ADeviceWithAnInvalidAxisRangeIsRefused) {
  const auto maps = maps_of(R"(( Devices `( ( Device "it" :axes `( ( Axis "ABS_X" ) ) ) ) ))");
  DeviceInfo info = info_of(1, 1, "it", {});
  for (const AxisRange range : {AxisRange{0, 0}, AxisRange{5, -5}}) {
    info.axes[ABS_X] = range;
    EXPECT_FALSE(resolve_map(maps[0], info));
  }
}

}  // namespace
}  // namespace yars::inputmonitor
