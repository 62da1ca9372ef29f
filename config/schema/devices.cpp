#include "config/schema/devices.hpp"

#include <linux/input-event-codes.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <span>

#include "config/guf/parser.hpp"
#include "config/schema/schema.hpp"
#include "databuffer/messages/input_event.hpp"
#include "lib/radar/devices.hpp"
#include "lib/text/plain_text.hpp"

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

// Linux gives the buttons of a joystick two blocks of codes (drivers/hid/hid-input.c). The first has 16 codes.
constexpr int kFirstBlock = 16;
// Highest button number N of the text `button N`.
constexpr int kMaxNumbered = kFirstBlock + (KEY_MAX - BTN_TRIGGER_HAPPY1 + 1);
constexpr std::string_view kNumberedPrefix = "button ";

std::optional<int> number_of(std::string_view text) {
  const bool hexadecimal = text.starts_with("0x");
  if (hexadecimal) text.remove_prefix(2);
  const auto value = text::whole_number<int>(text, hexadecimal ? 16 : 10);
  return value && *value >= 0 ? value : std::nullopt;
}

std::optional<std::uint16_t> code_of(std::span<const Row> rows, std::string_view text, int min, int max) {
  const auto named = std::ranges::find(rows, text, &Row::name);
  if (named != rows.end()) return named->code;
  const auto number = number_of(text);
  if (!number || *number < min || *number > max) return std::nullopt;
  return static_cast<std::uint16_t>(*number);
}

std::string name_of(std::span<const Row> rows, std::uint16_t code) {
  const auto named = std::ranges::find(rows, code, &Row::code);
  return named != rows.end() ? std::string(named->name) : std::to_string(code);
}

}  // namespace

std::optional<std::uint16_t> button_code(std::string_view text) {
  if (!text.starts_with(kNumberedPrefix)) return code_of(kButtons, text, 1, KEY_MAX);
  const auto number = number_of(text.substr(kNumberedPrefix.size()));
  if (!number || *number < 1 || *number > kMaxNumbered) return std::nullopt;
  const int code = *number <= kFirstBlock ? BTN_JOYSTICK + *number - 1 : BTN_TRIGGER_HAPPY1 + *number - 1 - kFirstBlock;
  return static_cast<std::uint16_t>(code);
}

std::optional<std::uint16_t> axis_code(std::string_view text) {
  return code_of(kAxes, text, 0, ABS_MAX);
}

std::string button_name(std::uint16_t code) {
  if (code >= BTN_JOYSTICK && code < BTN_JOYSTICK + kFirstBlock)
    return std::string(kNumberedPrefix) + std::to_string(code - BTN_JOYSTICK + 1);
  if (code >= BTN_TRIGGER_HAPPY1 && code <= KEY_MAX)
    return std::string(kNumberedPrefix) + std::to_string(code - BTN_TRIGGER_HAPPY1 + 1 + kFirstBlock);
  return name_of(kButtons, code);
}

std::string axis_name(std::uint16_t code) {
  return name_of(kAxes, code);
}

namespace {

// Words in the order of radar::AxisUse.
constexpr std::array<std::string_view, 5> kUses{"tdcX", "tdcY", "elevation", "directions", "lever"};
constexpr double kMaxRaw = 1e10;  // greater than every 32-bit value of struct input_event

SlotSchema text_slot(std::string_view name, std::string& (*of)(ConfigurationBuilder&), std::string_view purpose) {
  return {.name = name, .binding = TextSlot{of}, .purpose = purpose};
}

// Rule: the text is empty, or describes an event as in `yars inject`.
std::optional<ConstraintViolation> check_event(std::string_view slot, const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto event = databuffer::event_from_text(text);
  if (event) return std::nullopt;
  const std::string& meant = event.error().action;
  return ConstraintViolation{slot, event.error().expected, event.error().found + (meant.empty() ? "" : "; " + meant)};
}

// Rule: `count` is below `max`, so that one more can be added.
std::optional<ConstraintViolation> too_many(std::size_t count, std::size_t max, std::string_view slot,
                                            const char* what) {
  if (count < max) return std::nullopt;
  return ConstraintViolation{slot, "at most " + std::to_string(max) + ' ' + what, "one more"};
}

std::optional<ConstraintViolation> check_button(const ConfigurationBuilder& builder) {
  const auto& button = builder.device_button;
  if (!button_code(button.code))
    return ConstraintViolation{"code", "a button, such as BTN_TRIGGER, \"button 17\" or 0x120",
                               quoted_text(button.code)};
  if (auto wrong = too_many(builder.device.buttons.size(), radar::kMaxControls, "code", "buttons")) return wrong;
  if (auto wrong = check_event("press", button.press)) return wrong;
  return check_event("release", button.release);
}

FormSchema button() {
  return {
      .name = "Button",
      .purpose = "a button of a device",
      .slots = {text_slot("code", YARS_FIELD(device_button.code),
                          "a name such as BTN_SOUTH, \"button 17\" (of a joystick), or a number such as 0x12c"),
                text_slot(
                    "press", YARS_FIELD(device_button.press),
                    "event when the button is pressed, as in `yars inject`; `tdc X Y` lasts while the button is held"),
                text_slot(
                    "release", YARS_FIELD(device_button.release),
                    "event when the button is released; left out: `tdc release` if press is `tdc press`, else none"),
                number_slot("repeat", "s", 0, 10, {YARS_FIELD(device_button.repeat_s)},
                            "interval of repetitions while the button is held; left out: none")},
      .part_of_value = true,
      .begin = [](ConfigurationBuilder& builder) { builder.device_button = {}; },
      .check = check_button,
      .end = [](ConfigurationBuilder& builder) { builder.device.buttons.push_back(builder.device_button); },
      .count = [](const ConfigurationBuilder& builder) { return builder.device.buttons.size(); },
      .select = [](ConfigurationBuilder& builder,
                   std::size_t index) { builder.device_button = builder.device.buttons[index]; }};
}

// Rules: low and high are both given or both omitted. If they are given, low < high, and a given centre lies between
// them. lowest < highest.
std::optional<ConstraintViolation> check_travel(const radar::DeviceAxis& axis) {
  const bool has_ends = !std::isnan(axis.low) && !std::isnan(axis.high);
  if (std::isnan(axis.low) != std::isnan(axis.high))
    return ConstraintViolation{"low", "low and high, or neither", "one of them"};
  if (has_ends && axis.low >= axis.high)
    return ConstraintViolation{"high", "more than low, " + number_text(axis.low), number_text(axis.high)};
  if (has_ends && (axis.centre <= axis.low || axis.centre >= axis.high))
    return ConstraintViolation{"centre", "a value between low and high", number_text(axis.centre)};
  if (axis.lowest_deg >= axis.highest_deg)
    return ConstraintViolation{"highest", "more than lowest, " + number_text(axis.lowest_deg),
                               number_text(axis.highest_deg)};
  return std::nullopt;
}

std::optional<ConstraintViolation> check_axis(const ConfigurationBuilder& builder) {
  const auto& axis = builder.device_axis;
  if (!axis_code(axis.code))
    return ConstraintViolation{"code", "an axis, such as ABS_X, or a number up to 63", quoted_text(axis.code)};
  if (auto wrong = too_many(builder.device.axes.size(), radar::kMaxControls, "code", "axes")) return wrong;
  if (auto wrong = check_travel(axis)) return wrong;
  if (auto wrong = check_event("positive", axis.positive)) return wrong;
  return check_event("negative", axis.negative);
}

std::vector<SlotSchema> axis_slots() {
  const auto raw = [](std::string_view name, double& (*of)(ConfigurationBuilder&), std::string_view purpose) {
    return number_slot(name, "", -kMaxRaw, kMaxRaw, {of}, purpose);
  };
  return {
      text_slot("code", YARS_FIELD(device_axis.code), "ABS_X, ABS_HAT0Y ... or a number"),
      {.name = "drives",
       .binding = ChoiceSlot{
           kUses, [](const ConfigurationBuilder& builder) { return static_cast<int>(builder.device_axis.use); },
           [](ConfigurationBuilder& builder, int index) {
             builder.device_axis.use = static_cast<radar::AxisUse>(index);
           }},
       .purpose = "tdcX, tdcY: TDC, right and up positive; elevation: antenna elevation above the horizontal; "
                  "directions: each "
                  "end acts as a button; lever: each step is an event; left out: tdcX"},
      raw("low", YARS_FIELD(device_axis.low), "value at the low end; left out: as the device reports"),
      raw("high", YARS_FIELD(device_axis.high), "value at the high end; left out: as the device reports"),
      raw("centre", YARS_FIELD(device_axis.centre), "value at rest; left out: midway between low and high"),
      number_slot("deadZone", "", 0, 0.9, {YARS_FIELD(device_axis.dead_zone)},
                  "fraction of the travel from the centre to an end that has no effect; left out: 0.05"),
      number_slot("curve", "", 0, 1, {YARS_FIELD(device_axis.curve)},
                  "0 = linear, 1 = cubic: finer near the centre; left out: 0"),
      {.name = "inverted",
       .binding = BooleanSlot{YARS_FIELD(device_axis.inverted)},
       .purpose = "true: exchanges the low and the high end; left out: false"},
      text_slot("positive", YARS_FIELD(device_axis.positive),
                "for directions and lever: event of a move to the high end"),
      text_slot("negative", YARS_FIELD(device_axis.negative), "like positive, for a move to the low end"),
      number_slot(
          "repeat", "s", 0, 10, {YARS_FIELD(device_axis.repeat_s)},
          "for directions: interval of repetitions at full deflection, longer at smaller deflections; left out: none"),
      number_slot("lowest", "deg", -60, 60, {YARS_FIELD(device_axis.lowest_deg)},
                  "for elevation: angle at the low end; left out: -60"),
      number_slot("highest", "deg", -60, 60, {YARS_FIELD(device_axis.highest_deg)},
                  "for elevation: angle at the high end; left out: 60"),
      {.name = "steps",
       .lowest = 2,
       .highest = 256,
       .binding = IntegerSlot{YARS_FIELD(device_axis.steps)},
       .purpose = "for a lever: positions over its travel; left out: 16"}};
}

FormSchema axis() {
  return {.name = "Axis",
          .purpose = "an axis of a device: a stick, a hat, a rocker, a lever",
          .slots = axis_slots(),
          .part_of_value = true,
          .begin = [](ConfigurationBuilder& builder) { builder.device_axis = {}; },
          .check = check_axis,
          .end = [](ConfigurationBuilder& builder) { builder.device.axes.push_back(builder.device_axis); },
          .count = [](const ConfigurationBuilder& builder) { return builder.device.axes.size(); },
          .select = [](ConfigurationBuilder& builder,
                       std::size_t index) { builder.device_axis = builder.device.axes[index]; }};
}

// True for four hexadecimal digits, as in the ids of USB vendors and products.
bool is_identity(std::string_view word) {
  constexpr std::size_t kDigits = 4;
  return word.size() == kDigits && std::ranges::all_of(word, [](char character) {
           return std::isxdigit(static_cast<unsigned char>(character)) != 0;
         });
}

std::optional<ConstraintViolation> check_device(const ConfigurationBuilder& builder) {
  const auto& device = builder.device;
  if (auto wrong = too_many(builder.radar.devices.size(), radar::kMaxDevices, "name", "devices")) return wrong;
  if (device.name.empty() || device.name.find_first_of("/,") != std::string::npos)
    return ConstraintViolation{"name", "a name without comma and slash", quoted_text(device.name)};
  if (!device.vendor.empty() && !is_identity(device.vendor))
    return ConstraintViolation{"vendor", "four hexadecimal digits", quoted_text(device.vendor)};
  if (!std::ranges::all_of(text::words_of(device.products), is_identity))
    return ConstraintViolation{"products", "four hexadecimal digits each", quoted_text(device.products)};
  if (!device.has.empty() && !button_code(device.has) && !axis_code(device.has))
    return ConstraintViolation{"has", "a button or an axis, such as BTN_SOUTH or ABS_X", quoted_text(device.has)};
  return std::nullopt;
}

FormSchema device() {
  return {.name = "Device",
          .purpose =
              "device map: events of a device's controls; without the slots vendor, pattern and has, it is selected by "
              "name only",
          .slots = {text_slot("name", YARS_FIELD(device.name), "name of this map, as in `--source evdev:PATH,NAME`"),
                    text_slot("vendor", YARS_FIELD(device.vendor),
                              "vendor id of the device, such as 044f (lsusb shows it); left out: any"),
                    text_slot("products", YARS_FIELD(device.products), "accepted product ids, such as b351 b352"),
                    text_slot("pattern", YARS_FIELD(device.pattern), "pattern of the device's own name, with * and ?"),
                    text_slot("has", YARS_FIELD(device.has), "control that the device must have, such as BTN_SOUTH"),
                    {.name = "buttons",
                     .binding = FormSlot{{"Button"}, {"Button"}, true},
                     .purpose = "at most 256 buttons"},
                    {.name = "axes", .binding = FormSlot{{"Axis"}, {"Axis"}, true}, .purpose = "at most 256 axes"}},
          .part_of_value = true,
          .begin = [](ConfigurationBuilder& builder) { builder.device = {}; },
          .check = check_device,
          .end = [](ConfigurationBuilder& builder) { builder.radar.devices.push_back(builder.device); },
          .count = [](const ConfigurationBuilder& builder) { return builder.radar.devices.size(); },
          .select = [](ConfigurationBuilder& builder,
                       std::size_t index) { builder.device = builder.radar.devices[index]; }};
}

}  // namespace

std::vector<FormSchema> device_forms() {
  return {{.name = "Devices",
           .purpose =
               "maps of cockpit hardware, added to earlier ones; of several maps that match a device, the last is used",
           .slots = {{.name = "devices",
                      .binding = FormSlot{{"Device"}, {"Device"}, true},
                      .purpose = "at most 64 maps; those of config/devices.guf are built in before them"}}},
          device(),
          button(),
          axis()};
}

}  // namespace yars::config
