// Makes a map of a device by asking for each control in turn. Pure: fed with what the device says, it tells what it
// took and what to ask next. A control counts when it has moved far: a button goes down, a hat or an axis goes kTravel
// of its range away from where it rested and comes back. So the trembling of axes is passed over. The way of the first
// move gives the sign, the extremes the ends, the place it comes back to the centre.
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

inline constexpr double kTravel = 0.3;        // share of the whole range that is no trembling
inline constexpr double kTravelUnknown = 64;  // [raw units] the same where the range is unknown; a hat has 1
inline constexpr double kBack = 0.25;         // share of the travel within which it has come back

class Learning {
 public:
  // `rest`: where the axes are, as far as it is known.
  Learning(const DeviceFacts& facts, const std::vector<std::pair<std::uint16_t, std::int32_t>>& rest);

  bool finished() const { return next_ == results_.size(); }
  // What to ask now: "PB 13 (13 of 33)".
  std::string prompt() const;
  // What is to be told of it, empty when it is nothing.
  std::string feed(const RawEvent& raw);
  void skip();
  void back();
  std::size_t learned() const;

  // The map so far.
  radar::Device device(const std::string& name) const;

 private:
  enum class Found { nothing, button, hat, axis };
  struct Result {
    Found found = Found::nothing;
    std::uint16_t code = 0;
    int way = 1;           // of a hat or an axis: towards the high end or the low one
    double extreme = 0.0;  // of an axis
    double rest = 0.0;
    double trembling = 0.0;  // how far from its rest it came back
  };
  struct Watched {
    double rest = 0.0;
    double least = 0.0;
    double most = 0.0;
  };

  std::string take_button(std::uint16_t code);
  std::string take_axis(std::uint16_t code, std::int32_t value);
  std::string take_result(const Result& result, const std::string& name);
  const Result* opposite() const;
  void add_axis(radar::Device& device, std::size_t first) const;
  void add_switch(radar::Device& device, std::size_t index) const;
  void begin_prompt();

  DeviceFacts facts_;
  std::map<std::uint16_t, Watched> watched_;
  std::vector<Result> results_;
  std::size_t next_ = 0;
};

}  // namespace yars::inputmonitor
