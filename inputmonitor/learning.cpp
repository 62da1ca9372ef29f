#include "inputmonitor/learning.hpp"

#include <algorithm>
#include <cmath>

#include "config/schema/devices.hpp"

namespace yars::inputmonitor {

namespace {

// Prompt for one control, and the event of that control. An axis has two consecutive prompts, one for each direction.
struct Prompt {
  std::string_view text;
  std::string_view event;  // empty: the prompt is for one direction of an axis
  double repeat_s = 0.0;
  radar::AxisUse use = radar::AxisUse::tdc_x;
  bool is_second = false;  // opposite direction of the axis in the previous prompt
};

constexpr std::size_t kFirstAxis = 20;  // index of the first prompt for an axis
constexpr std::array kPrompts{
    Prompt{"PB 1", "pb 1"},
    Prompt{"PB 2", "pb 2"},
    Prompt{"PB 3", "pb 3"},
    Prompt{"PB 4", "pb 4"},
    Prompt{"PB 5", "pb 5"},
    Prompt{"PB 6", "pb 6"},
    Prompt{"PB 7", "pb 7"},
    Prompt{"PB 8", "pb 8"},
    Prompt{"PB 9", "pb 9"},
    Prompt{"PB 10", "pb 10"},
    Prompt{"PB 11", "pb 11"},
    Prompt{"PB 12", "pb 12"},
    Prompt{"PB 13", "pb 13"},
    Prompt{"PB 14", "pb 14"},
    Prompt{"PB 15", "pb 15"},
    Prompt{"PB 16", "pb 16"},
    Prompt{"PB 17", "pb 17"},
    Prompt{"PB 18", "pb 18"},
    Prompt{"PB 19", "pb 19"},
    Prompt{"PB 20", "pb 20"},
    Prompt{"TDC right: push it to the end and let go", "", 0.0, radar::AxisUse::tdc_x},
    Prompt{"TDC left: push it to the end and let go", "", 0.0, radar::AxisUse::tdc_x, true},
    Prompt{"TDC up: push it to the end and let go", "", 0.0, radar::AxisUse::tdc_y},
    Prompt{"TDC down: push it to the end and let go", "", 0.0, radar::AxisUse::tdc_y, true},
    Prompt{"TDC switch", "tdc press"},
    Prompt{"quick step (castle switch up)", "coolie up"},
    Prompt{"ACQ forward", "acq fwd"},
    Prompt{"ACQ aft", "acq aft"},
    Prompt{"freeze", "freeze"},
    Prompt{"antenna up", "elevation up", 0.1},
    Prompt{"antenna down", "elevation down", 0.1},
    Prompt{"contrast up", "contrast up", 0.2},
    Prompt{"contrast down", "contrast down", 0.2},
};
static_assert(kPrompts[kFirstAxis].event.empty() && !kPrompts[kFirstAxis - 1].event.empty());

bool is_hat(std::uint16_t code) {
  return code >= ABS_HAT0X && code <= ABS_HAT3Y;
}

std::string hexadecimal(std::uint16_t number) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (int shift = 12; shift >= 0; shift -= 4) text += kDigits[number >> shift & 0xFU];
  return text;
}

}  // namespace

Learning::Learning(const DeviceInfo& info, const std::vector<std::pair<std::uint16_t, std::int32_t>>& rest)
    : info_(info), results_(kPrompts.size()) {
  for (const auto& [code, value] : rest) watched_[code] = Watched{double(value), double(value), double(value)};
}

std::string Learning::prompt() const {
  if (finished()) return "done";
  return std::string(kPrompts[next_].text) + " (" + std::to_string(next_ + 1) + " of " +
         std::to_string(kPrompts.size()) + ")";
}

std::string Learning::feed(const RawEvent& raw) {
  if (finished()) return {};
  if (raw.type == EV_KEY && raw.value == 1) return take_button(raw.code);
  if (raw.type == EV_ABS && raw.code < ABS_CNT) return take_axis(raw.code, raw.value);
  return {};
}

void Learning::begin_prompt() {
  for (auto& [code, axis] : watched_) axis.min = axis.max = axis.rest;
}

void Learning::skip() {
  if (!finished()) results_[next_++] = {};
  begin_prompt();
}

void Learning::back() {
  if (next_ > 0) results_[--next_] = {};
  begin_prompt();
}

std::size_t Learning::learned() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(results_, [](const Result& result) { return result.found != Found::nothing; }));
}

// If the prompt is for the second direction of an axis: result of the first direction, or nullptr if the user skipped
// the first direction. For any other prompt: nullptr.
const Learning::Result* Learning::opposite() const {
  const bool has = kPrompts[next_].is_second && results_[next_ - 1].found != Found::nothing;
  return has ? &results_[next_ - 1] : nullptr;
}

std::string Learning::take_button(std::uint16_t code) {
  const std::string name = config::button_name(code);
  if (!config::button_code(name)) return {};
  if (kPrompts[next_].event.empty()) return name + " is a button; an axis is expected";
  begin_prompt();
  return take_result({Found::button, code, 1, 0.0, 0.0, 0.0}, name);
}

std::string Learning::take_axis(std::uint16_t code, std::int32_t value) {
  // An unknown rest value is taken to be 0 for a hat, and the first value for another axis.
  const double first = is_hat(code) ? 0.0 : double(value);
  Watched& axis = watched_.try_emplace(code, Watched{first, first, first}).first->second;
  axis.min = std::min(axis.min, double(value));
  axis.max = std::max(axis.max, double(value));
  const auto& range = info_.axes[code];
  const double min_travel = is_hat(code) ? 1.0
                            : range      ? kMinTravel * (double(range->high) - range->low)
                                         : kMinTravelUnknown;
  const bool goes_up = axis.max - axis.rest >= axis.rest - axis.min;
  const double extreme = goes_up ? axis.max : axis.min;
  const double travel = std::abs(extreme - axis.rest);
  const double away = std::abs(double(value) - axis.rest);
  if (travel < min_travel || away > kReturned * travel) return {};
  const bool wants_axis = kPrompts[next_].event.empty();
  const Result result{wants_axis ? Found::axis : Found::hat, code, goes_up ? 1 : -1, extreme, axis.rest, away};
  const std::string name = config::axis_name(code) + (goes_up ? " to its high end" : " to its low end");
  // The next move of this axis is measured from the present value.
  axis.rest = double(value);
  begin_prompt();
  if (const Result* first_half = opposite(); first_half != nullptr) {
    if (first_half->code != code)
      return name + " is not the axis of the opposite direction; move that axis, or type b to go back";
    if (first_half->direction == result.direction)
      return name + " is the direction of the previous prompt; move the axis in the opposite direction";
  }
  return take_result(result, name);
}

std::string Learning::take_result(const Result& result, const std::string& name) {
  for (std::size_t i = 0; i < next_; ++i) {
    const Result& earlier = results_[i];
    const bool same_kind = (earlier.found == Found::button) == (result.found == Found::button);
    const bool same_direction = result.found == Found::button || earlier.direction == result.direction;
    if (earlier.found != Found::nothing && same_kind && earlier.code == result.code && same_direction)
      return name + " is " + std::string(kPrompts[i].text) + " already; move another control, or type b to go back";
  }
  std::string answer = name + " is " + std::string(kPrompts[next_].text);
  results_[next_++] = result;
  return answer;
}

radar::Device Learning::device(const std::string& name) const {
  radar::Device device;
  device.name = name;
  if (info_.known) {
    device.vendor = hexadecimal(info_.vendor);
    device.products = hexadecimal(info_.product);
  }
  for (std::size_t i = 0; i < results_.size(); ++i) {
    if (kPrompts[i].event.empty())
      add_axis(device, i);
    else
      add_switch(device, i);
  }
  return device;
}

// Adds an axis from the results of its two prompts. If only one direction is known, the opposite end is the mirror
// image of the known end about the rest value. The centre is at least 10 % of the range away from each end.
void Learning::add_axis(radar::Device& device, std::size_t first) const {
  if (kPrompts[first].is_second) return;
  const Result& positive = results_[first];
  const Result& negative = results_[first + 1];
  const Result& known = positive.found != Found::nothing ? positive : negative;
  if (known.found == Found::nothing) return;
  const double other = negative.found != Found::nothing && positive.found != Found::nothing
                           ? negative.extreme
                           : 2.0 * known.rest - known.extreme;
  constexpr double kMinDeadZone = 0.05;  // fraction of the travel from the centre to one end
  constexpr double kMaxDeadZone = 0.3;
  radar::DeviceAxis axis;
  axis.code = config::axis_name(known.code);
  axis.use = kPrompts[first].use;
  axis.low = std::min(known.extreme, other);
  axis.high = std::max(known.extreme, other);
  axis.centre =
      std::clamp(known.rest, axis.low + (axis.high - axis.low) * 0.1, axis.high - (axis.high - axis.low) * 0.1);
  axis.inverted = (known.direction < 0) == (&known == &positive);
  const double half = (axis.high - axis.low) / 2.0;
  // Dead zone: twice the larger return error, as a fraction of half the range, rounded to 0.01.
  const double dead_zone = 2.0 * std::max(positive.return_error, negative.return_error) / half;
  axis.dead_zone = std::clamp(std::round(dead_zone * 100.0) / 100.0, kMinDeadZone, kMaxDeadZone);
  device.axes.push_back(axis);
}

void Learning::add_switch(radar::Device& device, std::size_t index) const {
  const Result& result = results_[index];
  const Prompt& prompt = kPrompts[index];
  if (result.found == Found::nothing) return;
  if (result.found == Found::button) {
    device.buttons.push_back({config::button_name(result.code), std::string(prompt.event), {}, prompt.repeat_s});
    return;
  }
  const std::string code = config::axis_name(result.code);
  const auto is_same = [&](const radar::DeviceAxis& axis) {
    return axis.code == code && axis.use == radar::AxisUse::directions;
  };
  auto axis_of_code = std::ranges::find_if(device.axes, is_same);
  if (axis_of_code == device.axes.end()) {
    radar::DeviceAxis axis;
    axis.code = code;
    axis.use = radar::AxisUse::directions;
    // The ends are symmetric about rest. The opposite direction, if found later, keeps these ends.
    axis.low = result.rest - std::abs(result.extreme - result.rest);
    axis.high = result.rest + std::abs(result.extreme - result.rest);
    axis.repeat_s = prompt.repeat_s;
    axis_of_code = device.axes.insert(axis_of_code, axis);
  }
  (result.direction > 0 ? axis_of_code->positive : axis_of_code->negative) = std::string(prompt.event);
}

}  // namespace yars::inputmonitor
