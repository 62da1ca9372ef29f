// Controls that `input-monitor --learn` asks for, and those of a device that were found: they become a device map.
// Inputs: one gesture for each control; ids of the device.
// Outputs: names and requests for the user; objections to a gesture; the map as a radar::Device.
// A control that was not found has no entry in the map.
// Source: docs/hardware.md#learning-a-map
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "inputmonitor/device_decoder.hpp"
#include "inputmonitor/gestures.hpp"
#include "lib/radar/devices.hpp"

namespace yars::inputmonitor {

// button: a press, or a push of a hat or rocker. direction, opposite: the two directions of a stick, one after the
// other, by a stick, a hat or buttons. slider: a wheel or slider that stays where it is left.
enum class ControlKind { button, direction, opposite, slider };

struct RequestedControl {
  std::string name;     // "button 13 of the display"
  std::string where;    // place and use, in words; may be empty
  std::string request;  // what the user is to do: "press it"
  std::string event;    // sent by a button or by one direction of a hat; empty for a slider
  ControlKind kind = ControlKind::button;
  double repeat_s = 0.0;  // [s] interval of repetitions while it is held; 0: none
  radar::AxisUse use = radar::AxisUse::directions;
  std::string_view part;  // title of the part of the dialogue
};

// All controls, in the order in which they are asked for.
const std::vector<RequestedControl>& requested_controls();

class LearnedControls {
 public:
  LearnedControls();

  // Why this gesture cannot be the control `index`; nullopt if it can.
  std::optional<std::string> objection(std::size_t index, const Gesture& gesture) const;
  void learn(std::size_t index, const Gesture& gesture) { found_[index] = gesture; }
  void forget(std::size_t index) { found_[index] = {}; }
  bool knows(std::size_t index) const { return found_[index].kind != Gesture::Kind::nothing; }
  // Number of controls found; each direction of a stick counts as one.
  std::size_t count() const;

  // `rest_error`: GestureDetector::rest_error().
  radar::Device device(const std::string& name, const DeviceInfo& info,
                       const std::function<double(std::uint16_t)>& rest_error) const;

 private:
  std::optional<std::string> objection_to_opposite(std::size_t index, const Gesture& gesture) const;
  void add_stick(radar::Device& device, std::size_t first,
                 const std::function<double(std::uint16_t)>& rest_error) const;
  void add_slider(radar::Device& device, std::size_t index) const;
  void add_switch(radar::Device& device, std::size_t index) const;

  std::vector<Gesture> found_;  // by index of the control
};

}  // namespace yars::inputmonitor
