#include "inputmonitor/device_map.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>

#include "config/schema/devices.hpp"
#include "databuffer/messages/input_event.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::inputmonitor {

double shaped(std::int32_t raw, const AxisShape& shape) {
  const double offset = static_cast<double>(raw) - shape.centre;
  const double travel = offset >= 0.0 ? shape.high - shape.centre : shape.centre - shape.low;
  const double linear = std::clamp(offset / travel, -1.0, 1.0) * (shape.inverted ? -1.0 : 1.0);
  const double beyond = (std::abs(linear) - shape.dead_zone) / (1.0 - shape.dead_zone);
  if (beyond <= 0.0) return 0.0;
  return std::copysign((1.0 - shape.curve) * beyond + shape.curve * beyond * beyond * beyond, linear);
}

namespace {

using databuffer::EventKind;
using databuffer::InputEvent;
using error::Expected;

constexpr double kNanosecondsPerSecond = 1e9;

bool is_identity(std::string_view word, std::uint16_t wanted) {
  return text::whole_number<std::uint16_t>(word, 16) == wanted;
}

bool has_control(const DeviceInfo& info, std::string_view text) {
  if (const auto button = config::button_code(text); button && info.buttons.test(*button)) return true;
  const auto axis = config::axis_code(text);
  // axis_code() also accepts numbers. In a condition a number means a button, so an axis needs its name, "ABS_...".
  return axis && text.starts_with("ABS_") && info.axes[*axis].has_value();
}

bool fits(const DeviceInfo& info, const radar::Device& map) {
  if (map.vendor.empty() && map.pattern.empty() && map.has.empty()) return false;
  const auto products = text::words_of(map.products);
  const auto is_product = [&info](std::string_view word) { return is_identity(word, info.product); };
  return (map.vendor.empty() || is_identity(map.vendor, info.vendor)) &&
         (products.empty() || std::ranges::any_of(products, is_product)) &&
         (map.pattern.empty() || fnmatch(map.pattern.c_str(), info.name.c_str(), FNM_CASEFOLD) == 0) &&
         (map.has.empty() || has_control(info, map.has));
}

Expected<std::optional<InputEvent>> event_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto event = databuffer::event_from_text(text);
  if (!event) return tl::unexpected(event.error());
  return *event;
}

Expected<SwitchAction> switch_of(const std::string& press, const std::string& release, double repeat_s) {
  const auto pressed = event_of(press);
  if (!pressed) return tl::unexpected(pressed.error());
  const auto released = event_of(release);
  if (!released) return tl::unexpected(released.error());
  SwitchAction action{*pressed, *released, std::llround(repeat_s * kNanosecondsPerSecond)};
  // A switch without a press event repeats nothing. A TDC deflection lasts until it changes and needs no repetition.
  if (!action.press || is_kind(action.press, EventKind::tdc)) action.repeat_ns = 0;
  // A TDC press needs a release event, because the cursor function acts on release.
  if (is_kind(action.press, EventKind::tdc_press) && !action.release) {
    action.release = InputEvent{};
    action.release->kind = static_cast<std::uint16_t>(EventKind::tdc_release);
  }
  return action;
}

Expected<AxisShape> shape_of(const radar::DeviceAxis& axis, std::uint16_t code, const DeviceInfo& info) {
  AxisShape shape{axis.low, axis.high, axis.centre, axis.dead_zone, axis.curve, axis.inverted};
  const bool is_hat = code >= ABS_HAT0X && code <= ABS_HAT3Y;
  if (std::isnan(shape.low)) {
    if (!info.axes[code] && !is_hat)
      return error::fail("axis " + axis.code, ":low and :high in its map", "neither, and the device reports no range",
                         "write the values at both ends into the map");
    const AxisRange range = info.axes[code].value_or(AxisRange{-1, 1});
    shape.low = range.low;
    shape.high = range.high;
  }
  if (std::isnan(shape.centre)) shape.centre = (shape.low + shape.high) / 2.0;
  if (shape.low < shape.centre && shape.centre < shape.high) return shape;
  return error::fail("axis " + axis.code, "a centre between its low and high end",
                     text::text_of_number(shape.centre) + " between " + text::text_of_number(shape.low) + " and " +
                         text::text_of_number(shape.high),
                     "write :low, :high and :centre into the map");
}

Expected<ButtonAction> resolve_button(const radar::DeviceButton& button) {
  const auto code = config::button_code(button.code);
  if (!code) return error::fail("button", "a code such as BTN_TRIGGER", '"' + button.code + '"');
  auto action = switch_of(button.press, button.release, button.repeat_s);
  if (!action) return tl::unexpected(action.error());
  return ButtonAction{*code, *action};
}

Expected<AxisAction> resolve_axis(const radar::DeviceAxis& axis, std::uint16_t code, const DeviceInfo& info) {
  const auto shape = shape_of(axis, code, info);
  if (!shape) return tl::unexpected(shape.error());
  const auto positive = switch_of(axis.positive, {}, axis.repeat_s);
  if (!positive) return tl::unexpected(positive.error());
  const auto negative = switch_of(axis.negative, {}, axis.repeat_s);
  if (!negative) return tl::unexpected(negative.error());
  return AxisAction{code, axis.use, *shape, *positive, *negative, axis.lowest_deg, axis.highest_deg, axis.steps};
}

}  // namespace

const radar::Device* fitting_map(const DeviceInfo& info, std::span<const radar::Device> maps) {
  if (!info.known) return nullptr;
  const auto last = std::find_if(maps.rbegin(), maps.rend(), [&](const radar::Device& map) { return fits(info, map); });
  return last == maps.rend() ? nullptr : &*last;
}

const radar::Device* named_map(std::string_view name, std::span<const radar::Device> maps) {
  const auto last =
      std::find_if(maps.rbegin(), maps.rend(), [&](const radar::Device& map) { return map.name == name; });
  return last == maps.rend() ? nullptr : &*last;
}

Expected<DeviceMap> resolve_map(const radar::Device& device, const DeviceInfo& info) {
  DeviceMap map;
  map.name = device.name;
  for (const radar::DeviceButton& button : device.buttons) {
    auto resolved = resolve_button(button);
    if (!resolved) return tl::unexpected(resolved.error());
    map.buttons.push_back(*resolved);
  }
  for (const radar::DeviceAxis& axis : device.axes) {
    const auto code = config::axis_code(axis.code);
    if (!code) return error::fail("axis", "a code such as ABS_X", '"' + axis.code + '"');
    if (info.known && !info.axes[*code]) continue;
    auto resolved = resolve_axis(axis, *code, info);
    if (!resolved) return tl::unexpected(resolved.error());
    map.axes.push_back(*resolved);
  }
  return map;
}

}  // namespace yars::inputmonitor
