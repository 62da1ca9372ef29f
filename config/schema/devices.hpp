// Conversion between the codes of buttons and axes of Linux input devices and their text. Also the built-in device
// maps, which assign radar events to the controls of cockpit hardware.
// Inputs: a text, or a code.
// Outputs: the code of the text, or the most readable text for the code.
// Errors: std::nullopt for a text that names no code.
// Source: linux/input-event-codes.h.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace yars::config {

// Spellings:
//   BTN_TRIGGER, ABS_HAT0X: a name of linux/input-event-codes.h that devices.cpp lists
//   button 17: the 17th button of a joystick; the first 16 have codes from 0x120, further ones from 0x2c0
//   0x12c, 300: the code itself

std::optional<std::uint16_t> button_code(std::string_view text);  // code in [1, 0x2ff]
std::optional<std::uint16_t> axis_code(std::string_view text);    // code in [0, 0x3f]

// The most readable text for a code. button_code() and axis_code() convert this text back to the same code, if the code
// is in the interval stated there.
std::string button_name(std::uint16_t code);
std::string axis_name(std::uint16_t code);

// Text of config/devices.guf at build time: the built-in device maps.
std::string_view shipped_devices_text();

}  // namespace yars::config
