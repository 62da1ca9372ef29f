#include "config/control_code.hpp"

#include <linux/input-event-codes.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <span>

namespace yars::config {

namespace {

struct Row {
  std::string_view name;
  std::uint16_t code;
};

#define YARS_ROW(code) \
  Row {                \
#code, code        \
  }
constexpr std::array kButtons{
    YARS_ROW(BTN_TRIGGER),   YARS_ROW(BTN_THUMB),     YARS_ROW(BTN_THUMB2),    YARS_ROW(BTN_TOP),
    YARS_ROW(BTN_TOP2),      YARS_ROW(BTN_PINKIE),    YARS_ROW(BTN_BASE),      YARS_ROW(BTN_BASE2),
    YARS_ROW(BTN_BASE3),     YARS_ROW(BTN_BASE4),     YARS_ROW(BTN_BASE5),     YARS_ROW(BTN_BASE6),
    YARS_ROW(BTN_DEAD),      YARS_ROW(BTN_SOUTH),     YARS_ROW(BTN_EAST),      YARS_ROW(BTN_C),
    YARS_ROW(BTN_NORTH),     YARS_ROW(BTN_WEST),      YARS_ROW(BTN_Z),         YARS_ROW(BTN_TL),
    YARS_ROW(BTN_TR),        YARS_ROW(BTN_TL2),       YARS_ROW(BTN_TR2),       YARS_ROW(BTN_SELECT),
    YARS_ROW(BTN_START),     YARS_ROW(BTN_MODE),      YARS_ROW(BTN_THUMBL),    YARS_ROW(BTN_THUMBR),
    YARS_ROW(BTN_DPAD_UP),   YARS_ROW(BTN_DPAD_DOWN), YARS_ROW(BTN_DPAD_LEFT), YARS_ROW(BTN_DPAD_RIGHT),
    YARS_ROW(BTN_GEAR_DOWN), YARS_ROW(BTN_GEAR_UP)};
constexpr std::array kAxes{YARS_ROW(ABS_X),     YARS_ROW(ABS_Y),     YARS_ROW(ABS_Z),        YARS_ROW(ABS_RX),
                           YARS_ROW(ABS_RY),    YARS_ROW(ABS_RZ),    YARS_ROW(ABS_THROTTLE), YARS_ROW(ABS_RUDDER),
                           YARS_ROW(ABS_WHEEL), YARS_ROW(ABS_GAS),   YARS_ROW(ABS_BRAKE),    YARS_ROW(ABS_HAT0X),
                           YARS_ROW(ABS_HAT0Y), YARS_ROW(ABS_HAT1X), YARS_ROW(ABS_HAT1Y),    YARS_ROW(ABS_HAT2X),
                           YARS_ROW(ABS_HAT2Y), YARS_ROW(ABS_HAT3X), YARS_ROW(ABS_HAT3Y),    YARS_ROW(ABS_MISC)};
#undef YARS_ROW

// The kernel numbers a joystick's buttons in two runs (hid-input.c).
constexpr int kFirstRun = 16;
constexpr int kMostNumbered = kFirstRun + (KEY_MAX - BTN_TRIGGER_HAPPY1 + 1);
constexpr std::string_view kNumbered = "button ";

std::optional<int> number_of(std::string_view text) {
  const bool hexadecimal = text.starts_with("0x");
  if (hexadecimal) text.remove_prefix(2);
  int value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value, hexadecimal ? 16 : 10);
  if (problem != std::errc{} || end != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

std::optional<std::uint16_t> code_of(std::span<const Row> rows, std::string_view text, int least, int most) {
  const auto named = std::ranges::find(rows, text, &Row::name);
  if (named != rows.end()) return named->code;
  const auto number = number_of(text);
  if (!number || *number < least || *number > most) return std::nullopt;
  return static_cast<std::uint16_t>(*number);
}

std::string name_of(std::span<const Row> rows, std::uint16_t code) {
  const auto named = std::ranges::find(rows, code, &Row::code);
  return named != rows.end() ? std::string(named->name) : std::to_string(code);
}

}  // namespace

std::optional<std::uint16_t> button_code(std::string_view text) {
  if (!text.starts_with(kNumbered)) return code_of(kButtons, text, 1, KEY_MAX);
  const auto number = number_of(text.substr(kNumbered.size()));
  if (!number || *number < 1 || *number > kMostNumbered) return std::nullopt;
  const int code = *number <= kFirstRun ? BTN_JOYSTICK + *number - 1 : BTN_TRIGGER_HAPPY1 + *number - 1 - kFirstRun;
  return static_cast<std::uint16_t>(code);
}

std::optional<std::uint16_t> axis_code(std::string_view text) {
  return code_of(kAxes, text, 0, ABS_MAX);
}

std::string button_name(std::uint16_t code) {
  if (code >= BTN_JOYSTICK && code < BTN_JOYSTICK + kFirstRun)
    return std::string(kNumbered) + std::to_string(code - BTN_JOYSTICK + 1);
  if (code >= BTN_TRIGGER_HAPPY1 && code <= KEY_MAX)
    return std::string(kNumbered) + std::to_string(code - BTN_TRIGGER_HAPPY1 + 1 + kFirstRun);
  return name_of(kButtons, code);
}

std::string axis_name(std::uint16_t code) {
  return name_of(kAxes, code);
}

}  // namespace yars::config
