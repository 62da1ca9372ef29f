// Map of a device made ready: codes, events, travel and shape of its axes.
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

// From an axis's raw value to what the hand means, in [-1, 1].
//   v = (raw - centre) / (the end on its side - centre), cut to [-1, 1]; negated when inverted
//   t = (|v| - dead) / (1 - dead), 0 within the dead zone
//   result = sign(v) ((1 - curve) t + curve t^3): continuous, odd, 1 at the end
struct AxisShape {
  double low = -1.0;  // raw values; low < centre < high
  double high = 1.0;
  double centre = 0.0;
  double dead_zone = 0.0;  // [0, 0.9]
  double curve = 0.0;      // [0, 1]
  bool inverted = false;
};

double shaped(std::int32_t raw, const AxisShape& shape);

struct AxisRange {
  std::int32_t low = 0;
  std::int32_t high = 0;
};

// What a descriptor tells of itself. A FIFO or a file tells nothing.
struct DeviceFacts {
  bool known = false;
  std::string name;
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::bitset<KEY_CNT> buttons;
  std::array<std::optional<AxisRange>, ABS_CNT> axes;
};

// A button, or one way of a hat.
struct SwitchAction {
  std::optional<databuffer::InputEvent> press;
  std::optional<databuffer::InputEvent> release;
  std::int64_t repeat_ns = 0;  // [ns] 0: none
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

// A map of GUF made ready for one device: codes as numbers, texts as events, travels as the device or the map has them.
struct DeviceMap {
  std::string name;
  std::vector<ButtonAction> buttons;
  std::vector<AxisAction> axes;
};

// The last map that fits; null when none does, always so for a descriptor that tells nothing.
const radar::Device* fitting_map(const DeviceFacts& facts, std::span<const radar::Device> maps);
// The last map of that name; null when there is none.
const radar::Device* named_map(std::string_view name, std::span<const radar::Device> maps);

// An error where a code or an event is none, or where neither map nor device tell the travel of an axis; a hat's is -1
// to 1. An axis that a known device lacks is left out.
error::Expected<DeviceMap> ready_map(const radar::Device& device, const DeviceFacts& facts);

}  // namespace yars::inputmonitor
