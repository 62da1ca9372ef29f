// The dialogue of `input-monitor --learn` as a state machine. It asks for one control after the other; the user moves
// each, or types a key: skip, next part, back, again, end.
// Inputs: raw events of the device, typed bytes, time.
// Outputs: text for the user, whole lines; the map as a radar::Device.
// Units: times in nanoseconds of one clock (CLOCK_MONOTONIC).
// Threads: one thread per object. No system calls.
// Source: docs/hardware.md#learning-a-map
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "inputmonitor/device_decoder.hpp"
#include "inputmonitor/gestures.hpp"
#include "inputmonitor/learned_controls.hpp"
#include "lib/radar/devices.hpp"

namespace yars::inputmonitor {

inline constexpr std::int64_t kIdle_ns = 20'000'000'000;  // then the dialogue says that nothing has moved
inline constexpr std::int64_t kHeld_ns = 3'000'000'000;   // then it says that a stick has not come back

// How the user types: not at all, one key at a time, or lines that end with Enter.
enum class Typing { none, keys, lines };

class Learning {
 public:
  using RestValues = std::vector<std::pair<std::uint16_t, std::int32_t>>;  // code, value

  // `rest`: values of the axes with a known state.
  Learning(DeviceInfo info, const RestValues& rest, Typing typing);

  // Each of these returns what to tell the user: whole lines, or nothing.
  std::string begin(std::int64_t now_ns);  // the keys, and the first request
  std::string feed(const RawEvent& raw, std::int64_t now_ns);
  std::string type(std::string_view bytes, std::int64_t now_ns);
  std::string wait(std::int64_t now_ns);  // call it every few tenths of a second
  std::string reconnect(const RestValues& rest, std::int64_t now_ns);

  bool finished() const { return ended_ || next_ == requested_controls().size(); }
  std::size_t learned() const { return controls_.count(); }
  // Device map of the controls found so far.
  radar::Device device(const std::string& name) const;

 private:
  std::string request(std::int64_t now_ns);
  void begin_request(bool after_press);
  std::string take(const Gesture& gesture, std::int64_t now_ns);
  std::string take_key(char key, std::int64_t now_ns);
  std::string skip(std::size_t to, std::int64_t now_ns);
  std::string back(std::int64_t now_ns);
  std::size_t next_part() const;
  std::string keys_text() const;
  std::string hint(std::string_view text);

  DeviceInfo info_;
  Typing typing_;
  GestureDetector detector_;
  LearnedControls controls_;
  std::size_t next_ = 0;         // index of the control that is asked for
  std::string_view shown_part_;  // title of the part that was shown last
  std::int64_t asked_ns_ = 0;    // time of the request, or of the last key
  bool hinted_ = false;          // a hint about a stick was given for this request
  bool idle_reported_ = false;   // for this request
  bool ended_ = false;           // by the user
};

}  // namespace yars::inputmonitor
