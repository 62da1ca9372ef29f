#include "inputmonitor/device_decoder.hpp"

#include <linux/input.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace yars::inputmonitor {

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
