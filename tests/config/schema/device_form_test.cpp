// Tests of the GUF forms of cockpit hardware: reading, errors, printing, and the built-in maps. A map (form Device)
// assigns events to the buttons and axes of one kind of device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/schema/devices.hpp"
#include "config/schema/slot_text.hpp"
#include "tests/config/support.hpp"

namespace yars::config {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string device(const std::string& slots) {
  return "( Devices `( ( Device :name \"it\" " + slots + " ) ) )";
}

TEST(ControlCode, ButtonsOfAJoystickHaveTwoRangesOfCodes) {
  EXPECT_EQ(button_code("button 1"), 0x120);
  EXPECT_EQ(button_code("button 16"), 0x12f);
  EXPECT_EQ(button_code("button 17"), 0x2c0);
  EXPECT_EQ(button_code("button 28"), 0x2cb);
  EXPECT_EQ(button_code("BTN_TRIGGER"), 0x120);
  EXPECT_EQ(button_code("BTN_SOUTH"), 0x130);
  EXPECT_EQ(button_code("0x2c3"), 0x2c3);
  EXPECT_EQ(button_code("288"), 0x120);
  EXPECT_EQ(axis_code("ABS_HAT0Y"), 0x11);
  EXPECT_EQ(axis_code("0"), 0);
}

TEST(ControlCode, UnknownNamesHaveNoCode) {
  for (const char* text :
       {"", "button", "button 0", "button 81", "button -1", "0x300", "99999999999", "BTN", "0x", "1 2"})
    EXPECT_EQ(button_code(text), std::nullopt) << text;
  for (const char* text : {"", "64", "ABS_NO", "BTN_TRIGGER", "-1"}) EXPECT_EQ(axis_code(text), std::nullopt) << text;
}

TEST(ControlCode, EveryCodeHasANameThatReadsBack) {
  for (int code = 1; code <= 0x2ff; ++code)
    EXPECT_EQ(button_code(button_name(std::uint16_t(code))), code) << button_name(std::uint16_t(code));
  for (int code = 0; code < 0x40; ++code) EXPECT_EQ(axis_code(axis_name(std::uint16_t(code))), code);
}

TEST(DeviceForm, IsReadSlotBySlot) {
  const auto read = loaded(device(R"(:vendor "044f" :products "b351 b352" :pattern "*MFD*" :has "BTN_TRIGGER"
    :buttons `( ( Button "0x120" "pb 13" "pb 2" 0.5 ) )
    :axes `( ( Axis "ABS_Y" tdcY -100 100 5 0.1 0.5 true ) ( Axis "ABS_Z" lever :positive "contrast up" :steps 8 )
             ( Axis "ABS_RZ" elevation :lowest -10 :highest 20 ) ) )"));
  EXPECT_THAT(read.warnings, IsEmpty());
  ASSERT_EQ(read.radar.devices.size(), 1U);
  const auto& device_map = read.radar.devices[0];
  EXPECT_EQ(device_map.vendor + '|' + device_map.products + '|' + device_map.pattern + '|' + device_map.has,
            "044f|b351 b352|*MFD*|BTN_TRIGGER");
  EXPECT_EQ(fields(device_map.buttons.at(0)), std::tuple("0x120", "pb 13", "pb 2", 0.5));
  const auto& axis = device_map.axes.at(0);
  EXPECT_EQ(axis.use, radar::AxisUse::tdc_y);
  EXPECT_EQ(std::tuple(axis.low, axis.high, axis.centre, axis.dead_zone, axis.curve, axis.inverted),
            std::tuple(-100.0, 100.0, 5.0, 0.1, 0.5, true));
  EXPECT_EQ(device_map.axes.at(1).steps, 8);
  EXPECT_TRUE(std::isnan(device_map.axes.at(1).low));
  EXPECT_EQ(device_map.axes.at(2).highest_deg, 20.0);
}

TEST(DeviceForm, SeveralFormsAddTheirMaps) {
  EXPECT_EQ(loaded(device("") + device("")).radar.devices.size(), 2U);
}

TEST(DeviceForm, ErrorsNameTheSlotOrItsValue) {
  EXPECT_THAT(refusal("( Devices `( ( Device ) ) )"), HasSubstr(":name"));
  EXPECT_THAT(refusal(device(R"(:vendor "44f")")), HasSubstr("four hexadecimal digits"));
  EXPECT_THAT(refusal(device(R"(:products "b351 b35")")), HasSubstr("four hexadecimal digits"));
  EXPECT_THAT(refusal(device(R"(:has "BTN_NO")")), HasSubstr(":has"));
  EXPECT_THAT(refusal(device(R"(:buttons `( ( Button "BTN_NO" "pb 1" ) ))")), HasSubstr("BTN_NO"));
  EXPECT_THAT(refusal(device(R"(:buttons `( ( Button "BTN_TOP" "pb 21" ) ))")),
              HasSubstr("expected pb 1..20 for :press"));
  EXPECT_THAT(refusal(device(R"(:buttons `( ( Button "BTN_TOP" "pb 1" "nothing" ) ))")), HasSubstr(":release"));
  EXPECT_THAT(refusal(device(R"(:axes `( ( Axis "ABS_X" :low 0 ) ))")), HasSubstr("low and high"));
  EXPECT_THAT(refusal(device(R"(:axes `( ( Axis "ABS_X" :low 5 :high 5 ) ))")), HasSubstr("more than low"));
  EXPECT_THAT(refusal(device(R"(:axes `( ( Axis "ABS_X" :low 0 :high 5 :centre 5 ) ))")), HasSubstr("between"));
  EXPECT_THAT(refusal(device(R"(:axes `( ( Axis "ABS_X" elevation :lowest 5 :highest 5 ) ))")), HasSubstr("lowest"));
  EXPECT_THAT(refusal(device(R"(:axes `( ( Axis "ABS_X" throttle ) ))")), HasSubstr("tdcX"));
}

TEST(DeviceForm, BuiltInMapsReadWithoutWarnings) {
  const auto built_in = loaded(std::string(shipped_devices_text()));
  EXPECT_THAT(built_in.warnings, IsEmpty());
  EXPECT_GE(built_in.radar.devices.size(), 6U);
}

TEST(DeviceForm, PrintedMapsReadBackEqual) {
  const auto built_in = loaded(std::string(shipped_devices_text()));
  for (const std::string& text : {print_devices(built_in.radar.devices), print_configuration(built_in.radar)})
    EXPECT_EQ(fields_of_all(loaded(text).radar.devices), fields_of_all(built_in.radar.devices));
}

}  // namespace
}  // namespace yars::config
