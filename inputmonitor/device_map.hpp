// A map of GUF made ready for one device: codes as numbers, texts as events, travels as the device or the map has them.
#pragma once

#include <linux/input-event-codes.h>

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "databuffer/records/input_event.hpp"
#include "inputmonitor/axis_shape.hpp"
#include "lib/failure/error.hpp"
#include "lib/radar/devices.hpp"

namespace yars::inputmonitor {

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
failure::Expected<DeviceMap> ready_map(const radar::Device& device, const DeviceFacts& facts);

}  // namespace yars::inputmonitor
