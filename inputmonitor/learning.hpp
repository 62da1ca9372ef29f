// Interactive learning of a device map. The program prompts for one control after the other; the user moves each.
// Inputs: raw events; name, ids and axis ranges of the device; rest values of its axes.
// Outputs: prompts and answers as text; the map as a radar::Device.
// A button is identified when it is pressed. A hat or axis is identified when it has moved from rest and has returned.
// The minimum move is kMinTravel of the range, or kMinTravelUnknown; 1 for a hat. The direction of the move gives the
// sign of the axis. The value farthest from rest gives one end of the axis, and the rest value its centre.
// Threads: one thread per object. No system calls.
// Source: docs/hardware.md, "Learning a map"
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "inputmonitor/device_decoder.hpp"
#include "inputmonitor/device_map.hpp"
#include "lib/radar/devices.hpp"

namespace yars::inputmonitor {

inline constexpr double kMinTravel = 0.3;        // minimum move, as a fraction of the full range; less is jitter
inline constexpr double kMinTravelUnknown = 64;  // [raw units] minimum move of an axis with an unknown range
inline constexpr double kReturned = 0.25;  // maximum distance from rest after the return, in fractions of the move

class Learning {
 public:
  // `rest`: code and rest value of the axes with a known state.
  Learning(const DeviceInfo& info, const std::vector<std::pair<std::uint16_t, std::int32_t>>& rest);

  bool finished() const { return next_ == results_.size(); }
  // Text of the current prompt: "PB 13 (13 of 33)".
  std::string prompt() const;
  // Takes a raw event and returns an answer for the user: the control found, or why this control is refused. Empty if
  // the event neither presses a button nor ends the move of a hat or axis.
  std::string feed(const RawEvent& raw);
  void skip();                  // goes to the next prompt; the control remains unknown
  void back();                  // goes to the previous prompt and discards its result
  std::size_t learned() const;  // number of controls found; each direction of an axis counts as one

  // Device map of the controls found so far.
  radar::Device device(const std::string& name) const;

 private:
  // hat: one direction of a hat or axis, in answer to a prompt for a switch. axis: the same for a prompt for an axis.
  enum class Found { nothing, button, hat, axis };
  struct Result {
    Found found = Found::nothing;
    std::uint16_t code = 0;
    int direction = 1;          // hat or axis: +1 moved to the high end, -1 to the low end
    double extreme = 0.0;       // [raw units] hat or axis: value farthest from rest
    double rest = 0.0;          // [raw units]
    double return_error = 0.0;  // [raw units] hat or axis: distance from rest after the return
  };
  // Rest value, minimum and maximum of an axis [raw units]. begin_prompt() sets minimum and maximum to the rest value.
  struct Watched {
    double rest = 0.0;
    double min = 0.0;
    double max = 0.0;
  };

  std::string take_button(std::uint16_t code);
  std::string take_axis(std::uint16_t code, std::int32_t value);
  std::string take_result(const Result& result, const std::string& name);
  const Result* opposite() const;
  void add_axis(radar::Device& device, std::size_t first) const;
  void add_switch(radar::Device& device, std::size_t index) const;
  void begin_prompt();

  DeviceInfo info_;
  std::map<std::uint16_t, Watched> watched_;  // by code of the axis
  std::vector<Result> results_;               // one per prompt
  std::size_t next_ = 0;                      // index of the current prompt
};

}  // namespace yars::inputmonitor
