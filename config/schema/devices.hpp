// Cockpit devices: codes of buttons and axes, the maps that are built in, forms Device, Button, Axis.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace yars::config {

// Names of buttons and axes of the kernel's input layer, and their numbers.
//   BTN_TRIGGER, ABS_HAT0X ...: as linux/input-event-codes.h has them
//   button 17: the joystick's 17th, as the kernel numbers them: 0x120 up to the 16th, 0x2c0 up from there
//   0x12c, 300: the number itself

// Nothing when the text names none.
std::optional<std::uint16_t> button_code(std::string_view text);  // [1, 0x2ff]
std::optional<std::uint16_t> axis_code(std::string_view text);    // [0, 0x3f]

// The text that people know best; reads back as the same code.
std::string button_name(std::uint16_t code);
std::string axis_name(std::uint16_t code);

// config/devices.guf as it was when this was built: the maps of cockpit hardware that need no file.
std::string_view shipped_devices_text();

}  // namespace yars::config
