#include "inputmonitor/learned_controls.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "config/schema/devices.hpp"

namespace yars::inputmonitor {

namespace {

using Kind = Gesture::Kind;

constexpr int kPushButtons = 20;
constexpr int kButtonsPerSide = 5;

// What each push button of the display does (docs/pilots_manual.md#buttons).
constexpr std::array<std::string_view, kPushButtons> kUses{"not used",
                                                           "declutter",
                                                           "gain",
                                                           "brightness up",
                                                           "brightness down",
                                                           "mode",
                                                           "cursor function",
                                                           "stabilized or progressive maps",
                                                           "width of the scan",
                                                           "new, old and stored map",
                                                           "main menu",
                                                           "video recorder",
                                                           "range up",
                                                           "range down",
                                                           "store a map",
                                                           "IPVU",
                                                           "next point of the route",
                                                           "SNIFF",
                                                           "channel",
                                                           "band"};

// Push buttons count down the left side, along the bottom, up the right side and back along the top.
std::string place_of(int button) {
  constexpr std::array<std::string_view, 4> kSides{"left side", "bottom", "right side", "top"};
  constexpr std::array<std::string_view, 4> kStarts{"the top", "the left", "the bottom", "the right"};
  constexpr std::array<std::string_view, kButtonsPerSide> kOrdinals{"1st", "2nd", "3rd", "4th", "5th"};
  const auto side = static_cast<std::size_t>((button - 1) / kButtonsPerSide);
  const auto place = static_cast<std::size_t>((button - 1) % kButtonsPerSide);
  std::string text(kSides[side]);
  return text.append(", ").append(kOrdinals[place]).append(" from ").append(kStarts[side]);
}

constexpr std::string_view kPress = "press it";
constexpr std::string_view kPush = "push it to the end and let go";
constexpr std::string_view kSweep = "move it all the way down, then all the way up, and leave it there";

std::vector<RequestedControl> all_controls() {
  std::vector<RequestedControl> all;
  for (int button = 1; button <= kPushButtons; ++button) {
    const std::string number = std::to_string(button);
    all.push_back({"button " + number + " of the display",
                   place_of(button) + ": " + std::string(kUses[static_cast<std::size_t>(button - 1)]),
                   std::string(kPress), "pb " + number, ControlKind::button, 0.0, radar::AxisUse::directions,
                   "The 20 buttons around the display"});
  }
  constexpr std::string_view kTdc = "The TDC, the small stick that moves the cursor";
  const auto add_tdc = [&](const char* name, const char* event, ControlKind kind, radar::AxisUse use) {
    all.push_back({name, {}, std::string(kPush), event, kind, 0.0, use, kTdc});
  };
  add_tdc("TDC right", "tdc 1 0", ControlKind::direction, radar::AxisUse::tdc_x);
  add_tdc("TDC left", "tdc -1 0", ControlKind::opposite, radar::AxisUse::tdc_x);
  add_tdc("TDC up", "tdc 0 1", ControlKind::direction, radar::AxisUse::tdc_y);
  add_tdc("TDC down", "tdc 0 -1", ControlKind::opposite, radar::AxisUse::tdc_y);
  const auto add = [&](const char* name, const char* where, std::string_view request, const char* event,
                       std::string_view part, double repeat_s) {
    all.push_back(
        {name, where, std::string(request), event, ControlKind::button, repeat_s, radar::AxisUse::directions, part});
  };
  add("TDC switch", "maps or designates", kPress, "tdc press", kTdc, 0.0);
  constexpr std::string_view kSwitches = "Switches of stick and throttle";
  add("castle switch up", "next point of the route", kPush, "coolie up", kSwitches, 0.0);
  add("acquisition switch forward", "larger window", kPush, "acq fwd", kSwitches, 0.0);
  add("acquisition switch aft", "smaller window", kPush, "acq aft", kSwitches, 0.0);
  add("freeze", "the picture stands still", kPress, "freeze", kSwitches, 0.0);
  constexpr std::string_view kAntenna = "The antenna's elevation";
  add("antenna up", "a button or a switch", kPress, "elevation up", kAntenna, 0.1);
  add("antenna down", "a button or a switch", kPress, "elevation down", kAntenna, 0.1);
  all.push_back({"antenna wheel",
                 "a wheel or slider that stays where you leave it",
                 std::string(kSweep),
                 {},
                 ControlKind::slider,
                 0.0,
                 radar::AxisUse::elevation,
                 kAntenna});
  constexpr std::string_view kContrast = "Contrast of the picture";
  add("contrast up", "", kPress, "contrast up", kContrast, 0.2);
  add("contrast down", "", kPress, "contrast down", kContrast, 0.2);
  return all;
}

bool is_stick(ControlKind kind) {
  return kind == ControlKind::direction || kind == ControlKind::opposite;
}

// True if the gesture takes both ends of its axis: that of a stick or slider.
bool uses_whole_axis(ControlKind kind, const Gesture& gesture) {
  return gesture.kind == Kind::sweep || is_stick(kind);
}

std::string hexadecimal(std::uint16_t number) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (int shift = 12; shift >= 0; shift -= 4) text += kDigits[number >> shift & 0xFU];
  return text;
}

}  // namespace

const std::vector<RequestedControl>& requested_controls() {
  static const std::vector<RequestedControl> controls = all_controls();
  return controls;
}

LearnedControls::LearnedControls() : found_(requested_controls().size()) {}

std::size_t LearnedControls::count() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(found_, [](const Gesture& gesture) { return gesture.kind != Kind::nothing; }));
}

std::optional<std::string> LearnedControls::objection(std::size_t index, const Gesture& gesture) const {
  const ControlKind kind = requested_controls()[index].kind;
  if (kind == ControlKind::slider && gesture.kind != Kind::sweep)
    return "that is a button and not a wheel; s goes on if there is no wheel";
  if (kind == ControlKind::opposite && knows(index - 1))
    if (auto text = objection_to_opposite(index, gesture)) return text;
  for (std::size_t i = 0; i < found_.size(); ++i) {
    const Gesture& other = found_[i];
    const bool is_pair = kind == ControlKind::opposite && i + 1 == index && other.kind == Kind::push;
    if (i == index || !knows(i) || is_pair || other.code != gesture.code) continue;
    if ((other.kind == Kind::press) != (gesture.kind == Kind::press)) continue;
    if (other.kind == Kind::press || other.direction == gesture.direction ||
        uses_whole_axis(requested_controls()[i].kind, other) || uses_whole_axis(kind, gesture))
      return "that is " + requested_controls()[i].name + " already; use another one, or go back with b";
  }
  return std::nullopt;
}

std::optional<std::string> LearnedControls::objection_to_opposite(std::size_t index, const Gesture& gesture) const {
  const Gesture& first = found_[index - 1];
  const std::string& name = requested_controls()[index - 1].name;
  if (first.kind != gesture.kind)
    return name + (first.kind == Kind::press
                       ? " is a button; use a button here, too, or go back with b"
                       : " is a stick or hat; push the same one the other way, or go back with b");
  if (first.kind == Kind::press) return std::nullopt;
  if (first.code != gesture.code)
    return "that is not the stick or hat of " + name + "; push the same one the other way, or go back with b";
  if (first.direction == gesture.direction) return "that is the way of " + name + "; push it the other way";
  return std::nullopt;
}

radar::Device LearnedControls::device(const std::string& name, const DeviceInfo& info,
                                      const std::function<double(std::uint16_t)>& rest_error) const {
  radar::Device device;
  device.name = name;
  if (info.known) {
    device.vendor = hexadecimal(info.vendor);
    device.products = hexadecimal(info.product);
  }
  for (std::size_t i = 0; i < found_.size(); ++i) {
    const ControlKind kind = requested_controls()[i].kind;
    if (kind == ControlKind::direction) add_stick(device, i, rest_error);
    if (kind == ControlKind::slider && knows(i)) add_slider(device, i);
    // A direction of a stick may have been given by a button.
    if (found_[i].kind == Kind::press || (kind == ControlKind::button && knows(i))) add_switch(device, i);
  }
  return device;
}

// Adds an axis from its two directions. If only one is known, the opposite end is its mirror image.
// The centre is at least 10 % of the range away from each end.
void LearnedControls::add_stick(radar::Device& device, std::size_t first,
                                const std::function<double(std::uint16_t)>& rest_error) const {
  const Gesture& positive = found_[first];
  const Gesture& negative = found_[first + 1];
  const Gesture& known = positive.kind == Kind::push ? positive : negative;
  if (known.kind != Kind::push) return;
  // The rest value may have been corrected between the two, so the ends are compared with one of them.
  const bool both = positive.kind == Kind::push && negative.kind == Kind::push &&
                    (positive.extreme > positive.rest) != (negative.extreme > positive.rest) &&
                    negative.extreme != positive.rest;
  const double other = both ? negative.extreme : 2.0 * known.rest - known.extreme;
  constexpr double kMinDeadZone = 0.05;  // fraction of the travel from the centre to one end
  constexpr double kMaxDeadZone = 0.3;
  radar::DeviceAxis axis;
  axis.code = config::axis_name(known.code);
  axis.use = requested_controls()[first].use;
  axis.low = std::min(known.extreme, other);
  axis.high = std::max(known.extreme, other);
  axis.centre =
      std::clamp(known.rest, axis.low + (axis.high - axis.low) * 0.1, axis.high - (axis.high - axis.low) * 0.1);
  axis.inverted = (known.direction < 0) == (&known == &positive);
  const double half = (axis.high - axis.low) / 2.0;
  // Dead zone: twice the error of the rest position, as a fraction of half the range, rounded to 0.01.
  const double dead_zone = 2.0 * rest_error(known.code) / half;
  axis.dead_zone = std::clamp(std::round(dead_zone * 100.0) / 100.0, kMinDeadZone, kMaxDeadZone);
  device.axes.push_back(axis);
}

void LearnedControls::add_slider(radar::Device& device, std::size_t index) const {
  constexpr double kElevation_deg = 15.0;  // as the built-in maps have it: fine enough for a short slider
  const Gesture& sweep = found_[index];
  radar::DeviceAxis axis;
  axis.code = config::axis_name(sweep.code);
  axis.use = requested_controls()[index].use;
  axis.low = std::min(sweep.rest, sweep.extreme);
  axis.high = std::max(sweep.rest, sweep.extreme);
  axis.inverted = sweep.direction < 0;
  axis.dead_zone = 0.0;
  axis.lowest_deg = -kElevation_deg;
  axis.highest_deg = kElevation_deg;
  device.axes.push_back(axis);
}

void LearnedControls::add_switch(radar::Device& device, std::size_t index) const {
  const Gesture& gesture = found_[index];
  const RequestedControl& control = requested_controls()[index];
  if (gesture.kind == Kind::press) {
    device.buttons.push_back({config::button_name(gesture.code), control.event, {}, control.repeat_s});
    return;
  }
  const std::string code = config::axis_name(gesture.code);
  auto axis = std::ranges::find(device.axes, code, &radar::DeviceAxis::code);
  if (axis == device.axes.end()) {
    radar::DeviceAxis made;
    made.code = code;
    made.use = radar::AxisUse::directions;
    // The ends are symmetric about rest. The opposite direction, if found later, keeps these ends.
    made.low = gesture.rest - std::abs(gesture.extreme - gesture.rest);
    made.high = gesture.rest + std::abs(gesture.extreme - gesture.rest);
    made.repeat_s = control.repeat_s;
    axis = device.axes.insert(axis, made);
  }
  (gesture.direction > 0 ? axis->positive : axis->negative) = control.event;
  // An axis has one interval for both directions. A direction that is not to repeat decides.
  axis->repeat_s = std::min(axis->repeat_s, control.repeat_s);
}

}  // namespace yars::inputmonitor
