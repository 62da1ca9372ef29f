#include "inputmonitor/gestures.hpp"

#include <algorithm>
#include <cmath>

#include "config/schema/devices.hpp"

namespace yars::inputmonitor {

namespace {

constexpr double kJitter = 0.1;                  // a move below this fraction of the minimum push is no move
constexpr std::int64_t kReport_ns = 10'000'000;  // events of one report are read together

bool is_button(std::uint16_t code) {
  return config::button_code(config::button_name(code)).has_value();
}

}  // namespace

bool is_hat(std::uint16_t code) {
  return code >= ABS_HAT0X && code <= ABS_HAT3Y;
}

double GestureDetector::Axis::travel() const {
  return std::max(high - rest, rest - low);
}

GestureDetector::GestureDetector(const DeviceInfo& info,
                                 const std::vector<std::pair<std::uint16_t, std::int32_t>>& rest)
    : ranges_(info.axes) {
  reconnect(rest);
}

void GestureDetector::reconnect(const std::vector<std::pair<std::uint16_t, std::int32_t>>& rest) {
  for (const auto& [code, value] : rest) {
    Axis& axis = axes_[code];
    axis.rest = is_hat(code) ? 0.0 : double(value);
    axis.value = axis.standing = double(value);
  }
  begin(wanted_);
}

void GestureDetector::begin(Wanted wanted, bool after_press) {
  wanted_ = wanted;
  in_report_of_press_ = after_press;
  for (auto& [code, axis] : axes_) {
    axis.ignored = wanted == Wanted::push && is_away(code, axis);
    axis.low = axis.high = wanted == Wanted::push ? axis.rest : axis.value;
  }
}

void GestureDetector::take_rest() {
  for (auto& [code, axis] : axes_)
    if (!is_hat(code)) axis.rest = axis.value;
  begin(wanted_);
}

double GestureDetector::rest_error(std::uint16_t code) const {
  const auto found = axes_.find(code);
  if (found == axes_.end()) return 0.0;
  const Axis& axis = found->second;
  // An axis that has not moved since its last push stays where it is.
  const bool is_at_rest = axis.was_pushed && !is_away(code, axis);
  return std::max(axis.largest_error, is_at_rest ? std::abs(axis.value - axis.rest) : axis.error_of_longest);
}

double GestureDetector::min_travel(std::uint16_t code) const {
  if (is_hat(code)) return 1.0;
  const auto& range = ranges_[code];
  return range && range->high > range->low ? kMinTravel * (double(range->high) - range->low) : kMinTravelUnknown;
}

bool GestureDetector::is_away(std::uint16_t code, const Axis& axis) const {
  return std::abs(axis.value - axis.rest) > kReturned * min_travel(code);
}

Gesture GestureDetector::feed(const RawEvent& raw, std::int64_t now_ns) {
  if (raw.type == EV_SYN && raw.code == SYN_REPORT) in_report_of_press_ = false;
  // Events were lost: what moved meanwhile is unknown.
  if (raw.type == EV_SYN && raw.code == SYN_DROPPED) begin(wanted_);
  if (raw.type == EV_KEY && raw.value == 1 && is_button(raw.code)) {
    last_motion_ns_ = press_ns_ = now_ns;
    return {Gesture::Kind::press, raw.code, 1, 0.0, 0.0};
  }
  if (raw.type == EV_ABS && raw.code < ABS_CNT) return take_axis(raw.code, raw.value, now_ns);
  return {};
}

Gesture GestureDetector::take_axis(std::uint16_t code, double value, std::int64_t now_ns) {
  auto [entry, is_new] = axes_.try_emplace(code);
  Axis& axis = entry->second;
  if (is_new) axis.rest = axis.low = axis.high = axis.standing = is_hat(code) ? 0.0 : value;
  if (!is_new) measure_rest(code, axis, now_ns);
  axis.value = value;
  axis.since_ns = now_ns;
  if (is_away(code, axis)) last_motion_ns_ = now_ns;
  if (std::abs(value - axis.standing) > kJitter * min_travel(code)) {
    axis.standing = value;
    axis.moved_ns = now_ns;
  }
  const bool is_companion = in_report_of_press_ && now_ns - press_ns_ < kReport_ns && wanted_ == Wanted::push;
  if (axis.ignored || is_companion) {
    axis.ignored = is_away(code, axis);
    return {};
  }
  axis.low = std::min(axis.low, value);
  axis.high = std::max(axis.high, value);
  return wanted_ == Wanted::push ? find_push(code, axis) : Gesture{};
}

// How long the axis has stayed at the value that it leaves, if that is near rest after a push. A stick on its way back
// passes many values near rest and stays at one.
void GestureDetector::measure_rest(std::uint16_t code, Axis& axis, std::int64_t now_ns) const {
  const std::int64_t stay_ns = now_ns - axis.since_ns;
  if (!axis.was_pushed || is_away(code, axis) || stay_ns < axis.longest_ns) return;
  axis.longest_ns = stay_ns;
  axis.error_of_longest = std::abs(axis.value - axis.rest);
}

// A push ends when the axis is back near its rest value.
Gesture GestureDetector::find_push(std::uint16_t code, Axis& axis) {
  const double travel = axis.travel();
  if (travel < kShort * min_travel(code) || std::abs(axis.value - axis.rest) > kReturned * travel) return {};
  const double extreme = axis.extreme();
  const bool is_other = another_moved_more(code, axis);
  axis.low = axis.high = axis.rest;
  if (is_other) return {};
  const auto kind = travel < min_travel(code) ? Gesture::Kind::too_short : Gesture::Kind::push;
  if (kind == Gesture::Kind::push) {
    axis.was_pushed = true;
    axis.largest_error = std::max(axis.largest_error, axis.error_of_longest);
    axis.error_of_longest = 0.0;
    axis.longest_ns = -1;
  }
  return {kind, code, extreme > axis.rest ? 1 : -1, extreme, axis.rest};
}

// True while another axis is farther away from rest: a stick that is pushed to the right also moves a little up or
// down.
bool GestureDetector::another_moved_more(std::uint16_t code, const Axis& axis) const {
  const double share = axis.travel() / min_travel(code);
  return std::ranges::any_of(axes_, [&](const auto& entry) {
    const auto& [other, moved] = entry;
    return other != code && !moved.ignored && is_away(other, moved) && moved.travel() / min_travel(other) > share;
  });
}

Gesture GestureDetector::wait(std::int64_t now_ns) {
  for (auto& [code, axis] : axes_) {
    if (is_hat(code) || axis.ignored || now_ns - axis.moved_ns < kStill_ns) continue;
    const Gesture gesture = wanted_ == Wanted::sweep ? find_sweep(code, axis) : find_new_rest(code, axis);
    if (gesture.kind != Gesture::Kind::nothing) return gesture;
  }
  return {};
}

Gesture GestureDetector::find_sweep(std::uint16_t code, const Axis& axis) const {
  const double travel = axis.high - axis.low;
  if (travel < kMinSweep * min_travel(code)) return {};
  const bool is_high = axis.high - axis.value <= kEnd * travel;
  if (!is_high && axis.value - axis.low > kEnd * travel) return {};
  return {Gesture::Kind::sweep, code, is_high ? 1 : -1, is_high ? axis.high : axis.low, is_high ? axis.low : axis.high};
}

Gesture GestureDetector::find_new_rest(std::uint16_t code, Axis& axis) const {
  const double travel = axis.travel();
  // An axis near its extreme is being held there.
  const bool is_held_there = std::abs(axis.value - axis.extreme()) <= kReturned * travel;
  if (travel < min_travel(code) || is_held_there) return {};
  axis.rest = axis.low = axis.high = axis.value;
  return {Gesture::Kind::new_rest, code, 1, 0.0, axis.rest};
}

bool GestureDetector::is_held() const {
  return std::ranges::any_of(axes_, [this](const auto& entry) {
    const auto& [code, axis] = entry;
    return !axis.ignored && is_away(code, axis) && axis.travel() >= min_travel(code);
  });
}

}  // namespace yars::inputmonitor
