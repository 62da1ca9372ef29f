// Device map: the input events of each button and axis of a device, and the response curves of the axes. Buttons and
// axes have the codes of evdev (the Linux interface of input devices).
// Inputs: a map from GUF (radar::Device); name, ids and controls of the device (DeviceInfo).
// Outputs: DeviceMap, with numeric codes, parsed events and axis ranges.
// Errors: an unknown code, an invalid event, an axis without a known range or with a centre outside its range.
// A hat is a small four-way switch that reports two axes with values -1, 0 and 1. A rocker is a switch that rests in
// the middle and is pressed at either end. A lever stays in any position; its travel is divided into steps (detents).
#pragma once

#include <linux/input-event-codes.h>

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "databuffer/messages/input_event.hpp"
#include "lib/error/error.hpp"
#include "lib/radar/devices.hpp"

namespace yars::inputmonitor {

// Response curve of an axis: raw value to deflection in [-1, 1].
//   v = (raw - centre) / |end - centre|, clamped to [-1, 1]; end: high if raw >= centre, else low; if inverted, -v
//   t = (|v| - dead zone) / (1 - dead zone); 0 within the dead zone
//   deflection = sign(v) ((1 - curve) t + curve t^3): continuous, odd, 1 at the end
struct AxisShape {
  double low = -1.0;  // [raw units] low < centre < high
  double high = 1.0;
  double centre = 0.0;
  double dead_zone = 0.0;  // [0, 0.9] fraction of the travel from the centre to one end
  double curve = 0.0;      // [0, 1] 0: linear; 1: cubic
  bool inverted = false;
};

// Deflection in [-1, 1] of a raw value, by the response curve.
double shaped(std::int32_t raw, const AxisShape& shape);

// Range of an axis [raw units].
struct AxisRange {
  std::int32_t low = 0;
  std::int32_t high = 0;
};

// Name, ids and controls of a device, as the kernel reports them.
struct DeviceInfo {
  bool known = false;  // false for a FIFO or a file: the other members have no values
  std::string name;
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::bitset<KEY_CNT> buttons;
  std::array<std::optional<AxisRange>, ABS_CNT> axes;
};

// Events of a button, or of one direction of a hat, rocker or lever.
struct SwitchAction {
  std::optional<databuffer::InputEvent> press;
  std::optional<databuffer::InputEvent> release;
  std::int64_t repeat_ns = 0;  // interval between repetitions of `press` while held; 0: no repetition
};

inline bool is_kind(const std::optional<databuffer::InputEvent>& event, databuffer::EventKind kind) {
  return event && event->kind == static_cast<std::uint16_t>(kind);
}

struct ButtonAction {
  std::uint16_t code = 0;
  SwitchAction action;
};

struct AxisAction {
  std::uint16_t code = 0;
  radar::AxisUse use = radar::AxisUse::tdc_x;
  AxisShape shape;
  SwitchAction positive;      // hat, rocker: events of a push toward deflection 1; lever: of each step toward it
  SwitchAction negative;      // the same for deflection -1
  double lowest_deg = -60.0;  // elevation axis: antenna elevation above the horizontal at deflection -1
  double highest_deg = 60.0;  // elevation axis: antenna elevation above the horizontal at deflection 1
  int steps = 16;             // lever: number of detents
};

// Resolved map of one device: codes as numbers, events parsed, axis ranges from the map or else from the device.
struct DeviceMap {
  std::string name;
  std::vector<ButtonAction> buttons;
  std::vector<AxisAction> axes;
};

// The last map whose conditions (lib/radar/devices.hpp) the device meets; nullptr if no map fits or `info.known` is
// false.
const radar::Device* fitting_map(const DeviceInfo& info, std::span<const radar::Device> maps);
// The last map with that name; nullptr if there is none.
const radar::Device* named_map(std::string_view name, std::span<const radar::Device> maps);

// Resolves a map for a device. An axis range comes from the map, else from the device, else for a hat it is -1 to 1.
// Axes that a known device does not have are omitted. Errors: as in the header of this file.
error::Expected<DeviceMap> resolve_map(const radar::Device& device, const DeviceInfo& info);

}  // namespace yars::inputmonitor
