// Device map: codes of a device's controls with their input events, and the response curves of its axes.
// Inputs: a map from GUF (radar::Device); name, ids and controls of the device (DeviceFacts).
// Outputs: DeviceMap, with numeric codes, parsed events and axis ranges.
// Errors: an unknown code, an invalid event, an axis without a known range.
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
//   v = (raw - centre) / |end - centre| with the end on the side of raw, clamped to [-1, 1]; negated when inverted
//   t = (|v| - dead zone) / (1 - dead zone); 0 within the dead zone
//   deflection = sign(v) ((1 - curve) t + curve t^3): continuous, odd, 1 at the end
struct AxisShape {
  double low = -1.0;  // [raw units] low < centre < high
  double high = 1.0;
  double centre = 0.0;
  double dead_zone = 0.0;  // [0, 0.9]
  double curve = 0.0;      // [0, 1]
  bool inverted = false;
};

// Deflection of a raw value, in [-1, 1].
double shaped(std::int32_t raw, const AxisShape& shape);

// Range of an axis [raw units].
struct AxisRange {
  std::int32_t low = 0;
  std::int32_t high = 0;
};

// Description of a device by its descriptor.
struct DeviceFacts {
  bool known = false;  // false for a FIFO or a file: all else is empty
  std::string name;
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::bitset<KEY_CNT> buttons;
  std::array<std::optional<AxisRange>, ABS_CNT> axes;
};

// Events of a button, or of one direction of a hat.
struct SwitchAction {
  std::optional<databuffer::InputEvent> press;
  std::optional<databuffer::InputEvent> release;
  std::int64_t repeat_ns = 0;  // between repetitions of `press` while held; 0: none
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
  SwitchAction positive;
  SwitchAction negative;
  double lowest_deg = -60.0;
  double highest_deg = 60.0;
  int steps = 16;
};

// Map of one device: codes as numbers, texts as events, axis ranges from the map or the device.
struct DeviceMap {
  std::string name;
  std::vector<ButtonAction> buttons;
  std::vector<AxisAction> axes;
};

// The last map that fits. Null when none does, or when the device is not known.
const radar::Device* fitting_map(const DeviceFacts& facts, std::span<const radar::Device> maps);
// The last map of that name. Null when there is none.
const radar::Device* named_map(std::string_view name, std::span<const radar::Device> maps);

// Resolves a map for a device. Errors: an unknown code, an invalid event, an axis without a range in map or device.
// The default range of a hat is -1 to 1. Axes that a known device does not have are omitted.
error::Expected<DeviceMap> resolve_map(const radar::Device& device, const DeviceFacts& facts);

}  // namespace yars::inputmonitor
