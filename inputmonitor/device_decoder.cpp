#include "inputmonitor/device_decoder.hpp"

#include <fnmatch.h>
#include <linux/input.h>

#include <algorithm>
#include <bit>
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

Expected<std::optional<InputEvent>> parsed_event(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto event = databuffer::event_from_text(text);
  if (!event) return tl::unexpected(event.error());
  return *event;
}

Expected<SwitchAction> switch_of(const std::string& press, const std::string& release, double repeat_s) {
  const auto pressed = parsed_event(press);
  if (!pressed) return tl::unexpected(pressed.error());
  const auto released = parsed_event(release);
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

static_assert(sizeof(input_event) == kRecordBytes);

std::vector<RawEvent> RecordStream::feed(std::span<const std::byte> bytes) {
  std::vector<RawEvent> events;
  events.reserve((kept_ + bytes.size()) / kRecordBytes);
  while (!bytes.empty()) {
    const std::size_t count = std::min(bytes.size(), kRecordBytes - kept_);
    std::copy_n(bytes.begin(), count, record_.begin() + static_cast<std::ptrdiff_t>(kept_));
    kept_ += count;
    bytes = bytes.subspan(count);
    if (kept_ < kRecordBytes) break;
    kept_ = 0;
    const auto record = std::bit_cast<input_event>(record_);
    events.push_back({record.type, record.code, record.value});
  }
  return events;
}

namespace {

using databuffer::EventKind;
using databuffer::InputEvent;

InputEvent event_of(EventKind kind, double x = 0.0, double y = 0.0) {
  InputEvent event{};
  event.kind = static_cast<std::uint16_t>(kind);
  event.x = x;
  event.y = y;
  return event;
}

// `value` rounded to a multiple of `step`.
double in_steps_of(double step, double value) {
  // `step` is 1 / N. Dividing by N gives the double nearest to a decimal such as 0.07. Adding 0.0 turns -0.0 into 0.0.
  const double per_one = std::round(1.0 / step);
  return std::round(value * per_one) / per_one + 0.0;
}

bool deflects(radar::AxisUse use) {
  return use == radar::AxisUse::tdc_x || use == radar::AxisUse::tdc_y;
}

// Detent (0 to steps - 1) of a lever value in [-1, 1]. The lever stays in the detent `before` until the value is beyond
// an edge of that detent by kHysteresis.
int detent_of(double value, int steps, std::optional<int> before) {
  constexpr double kHysteresis = 0.25;  // [steps] distance beyond the edge at which the detent changes
  const double position = (value + 1.0) / 2.0 * steps;
  const int detent = std::clamp(static_cast<int>(std::floor(position)), 0, steps - 1);
  const bool stays = before && position > *before - kHysteresis && position < *before + 1 + kHysteresis;
  return stays ? *before : detent;
}

}  // namespace

DeviceDecoder::DeviceDecoder(DeviceMap map) : map_(std::move(map)) {
  for (const ButtonAction& button : map_.buttons) switches_.push_back(switch_of(button.action));
  for (const AxisAction& action : map_.axes) {
    Axis axis;
    axis.action = action;
    axis.first_switch = switches_.size();
    if (action.use == radar::AxisUse::directions) {
      switches_.push_back(switch_of(action.positive));
      switches_.push_back(switch_of(action.negative));
    }
    axes_.push_back(axis);
  }
}

DeviceDecoder::Switch DeviceDecoder::switch_of(const SwitchAction& action) {
  Switch one;
  one.action = action;
  return one;
}

void DeviceDecoder::begin(const DeviceState& state) {
  for (const auto& [code, value] : state.axes) change_axis(code, value, 0, true);
}

void DeviceDecoder::feed(const RawEvent& raw, std::int64_t now_ns) {
  if (raw.type == EV_SYN && raw.code == SYN_DROPPED) loss_ = Loss::discarding;
  if (loss_ != Loss::none) {
    // Linux has lost events. The remaining events of the incomplete report, up to SYN_REPORT, are ignored.
    if (raw.type == EV_SYN && raw.code == SYN_REPORT) loss_ = Loss::complete;
    return;
  }
  // Ignored: the value 2, a key repeat made by Linux.
  if (raw.type == EV_KEY && (raw.value == 0 || raw.value == 1)) change_button(raw.code, raw.value == 1, now_ns);
  if (raw.type == EV_ABS) change_axis(raw.code, raw.value, now_ns, false);
}

void DeviceDecoder::resync(const std::optional<DeviceState>& state, std::int64_t now_ns) {
  loss_ = Loss::none;
  if (!state) {
    release_all();
    return;
  }
  for (const ButtonAction& button : map_.buttons)
    if (button.code < KEY_CNT) change_button(button.code, state->buttons.test(button.code), now_ns);
  for (const auto& [code, value] : state->axes) change_axis(code, value, now_ns, false);
}

void DeviceDecoder::release_all() {
  for (Switch& one : switches_) {
    // Only a TDC press is released. For a latching switch, the release event would be a command.
    if (one.held && is_kind(one.action.press, EventKind::tdc_press)) send(event_of(EventKind::tdc_release));
    one.held = false;
  }
  for (Axis& axis : axes_) {
    axis.deflection = 0.0;
    axis.detent.reset();
  }
  elevation_deg_ = sent_elevation_deg_;
  send_values();
}

DeviceDecoder::Events DeviceDecoder::take(std::int64_t now_ns) {
  for (Switch& one : switches_) {
    if (!one.held || one.action.repeat_ns == 0 || now_ns < one.next_ns || !one.action.press) continue;
    if (may_press(now_ns)) send(*one.action.press);
    const double rate = std::max(one.deflection, 0.1);
    one.next_ns = now_ns + static_cast<std::int64_t>(static_cast<double>(one.action.repeat_ns) / rate);
  }
  if (values_wait() && now_ns >= values_sent_ns_ + kValueInterval_ns) {
    send_values();
    values_sent_ns_ = now_ns;
  }
  return std::exchange(events_, {});
}

std::optional<std::int64_t> DeviceDecoder::deadline_ns() const {
  std::optional<std::int64_t> deadline_ns;
  if (values_wait()) deadline_ns = values_sent_ns_ + kValueInterval_ns;
  for (const Switch& one : switches_)
    if (one.held && one.action.repeat_ns != 0) deadline_ns = std::min(deadline_ns.value_or(one.next_ns), one.next_ns);
  return deadline_ns;
}

void DeviceDecoder::change_button(std::uint16_t code, bool down, std::int64_t now_ns) {
  for (std::size_t i = 0; i < map_.buttons.size(); ++i)
    if (map_.buttons[i].code == code) change(switches_[i], down, now_ns);
}

void DeviceDecoder::change_axis(std::uint16_t code, std::int32_t raw, std::int64_t now_ns, bool first) {
  for (Axis& axis : axes_) {
    if (axis.action.code != code) continue;
    const double value = shaped(raw, axis.action.shape);
    if (deflects(axis.action.use)) axis.deflection = value;
    if (axis.action.use == radar::AxisUse::lever) move_lever(axis, value, now_ns, first);
    if (axis.action.use == radar::AxisUse::directions && !first) {
      push(switches_[axis.first_switch], value, now_ns);
      push(switches_[axis.first_switch + 1], -value, now_ns);
    }
    if (axis.action.use == radar::AxisUse::elevation) {
      const double fraction = (value + 1.0) / 2.0;
      const double span_deg = axis.action.highest_deg - axis.action.lowest_deg;
      elevation_deg_ = in_steps_of(0.1, axis.action.lowest_deg + fraction * span_deg);
      if (first) sent_elevation_deg_ = elevation_deg_;
    }
  }
}

void DeviceDecoder::move_lever(Axis& axis, double value, std::int64_t now_ns, bool first) {
  const int detent = detent_of(value, axis.action.steps, axis.detent);
  const int moved = first || !axis.detent ? 0 : detent - *axis.detent;
  axis.detent = detent;
  const auto& direction = moved > 0 ? axis.action.positive : axis.action.negative;
  for (int i = 0; i < std::abs(moved) && direction.press; ++i)
    if (may_press(now_ns)) send(*direction.press);
}

void DeviceDecoder::push(Switch& direction, double deflection, std::int64_t now_ns) {
  direction.deflection = std::max(deflection, 0.0);
  change(direction, deflection >= (direction.held ? kReleaseThreshold : kPressThreshold), now_ns);
}

// A press above the rate limit is dropped. Its release then has no effect, because the switch is not held.
void DeviceDecoder::change(Switch& one, bool down, std::int64_t now_ns) {
  if (one.held == down || (down && !may_press(now_ns))) return;
  one.held = down;
  one.next_ns = now_ns + one.action.repeat_ns;
  const auto& event = down ? one.action.press : one.action.release;
  // A TDC deflection is sent by send_values(), summed over all controls.
  if (event && !is_kind(event, EventKind::tdc)) send(*event);
}

bool DeviceDecoder::may_press(std::int64_t now_ns) {
  const auto passed_s = static_cast<double>(now_ns - presses_counted_ns_.value_or(now_ns)) * 1e-9;
  presses_left_ = std::min(kPressBurst, presses_left_ + std::max(passed_s, 0.0) * kPressesPerSecond);
  presses_counted_ns_ = now_ns;
  if (presses_left_ < 1.0) {
    ++dropped_;
    return false;
  }
  presses_left_ -= 1.0;
  return true;
}

void DeviceDecoder::send(const InputEvent& event) {
  // A pending deflection or elevation precedes the event, because the pilot set it earlier.
  send_values();
  events_.push_back(event);
}

void DeviceDecoder::send_values() {
  const auto [x, y] = deflection();
  if (std::pair(x, y) != sent_deflection_) events_.push_back(event_of(EventKind::tdc, x, y));
  sent_deflection_ = {x, y};
  if (elevation_deg_ && elevation_deg_ != sent_elevation_deg_)
    events_.push_back(event_of(EventKind::elevation, *elevation_deg_));
  sent_elevation_deg_ = elevation_deg_;
}

std::pair<double, double> DeviceDecoder::deflection() const {
  double x = 0.0;
  double y = 0.0;
  for (const Axis& axis : axes_) (axis.action.use == radar::AxisUse::tdc_x ? x : y) += axis.deflection;
  for (const Switch& one : switches_) {
    if (!one.held || !is_kind(one.action.press, EventKind::tdc)) continue;
    x += one.action.press->x;
    y += one.action.press->y;
  }
  return {in_steps_of(0.01, std::clamp(x, -1.0, 1.0)), in_steps_of(0.01, std::clamp(y, -1.0, 1.0))};
}

bool DeviceDecoder::values_wait() const {
  return deflection() != sent_deflection_ || elevation_deg_ != sent_elevation_deg_;
}

}  // namespace yars::inputmonitor
