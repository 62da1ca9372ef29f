// Gestures: what a user does with one control of a device, found in the stream of its raw events.
//   press: a button goes down
//   push: a stick, hat or rocker moves away from rest and comes back
//   sweep: a wheel or slider moves over its travel and is left at one end
// Inputs: raw events with their times; axis ranges of the device; rest values of its axes.
// Outputs: at most one gesture for each event.
// Units: raw values of the device; times in nanoseconds of one clock.
// Threads: one thread per object. No system calls.
// Source: docs/hardware.md#what-counts
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "inputmonitor/device_decoder.hpp"

namespace yars::inputmonitor {

inline constexpr double kMinTravel = 0.3;        // minimum push, as a fraction of the full range; less is jitter
inline constexpr double kMinTravelUnknown = 64;  // [raw units] minimum push of an axis with an unknown range
inline constexpr double kReturned = 0.25;  // maximum distance from rest after the return, in fractions of the push
inline constexpr double kShort = 1.0 / 3;  // a push of this part of the minimum is reported as too short
inline constexpr double kMinSweep = 2.0;   // minimum travel of a sweep, in fractions of the minimum push
inline constexpr double kEnd = 0.1;        // a sweep ends within this fraction of its travel from one end
inline constexpr std::int64_t kStill_ns = 1'000'000'000;  // an axis stands still after this time without a move

// Result for one event. too_short: a push below the minimum. new_rest: an axis has come to rest between its former rest
// value and its extreme. Its former rest value was wrong: some devices report 0 until the first move.
struct Gesture {
  enum class Kind { nothing, press, push, sweep, too_short, new_rest };
  Kind kind = Kind::nothing;
  std::uint16_t code = 0;  // of the button or axis
  int direction = 1;       // push: +1 to the high end, -1 to the low end; sweep: the end at which it was left
  double extreme = 0.0;    // [raw units] push: value farthest from rest; sweep: value at that end
  double rest = 0.0;       // [raw units] push: rest value; sweep: value at the opposite end
};

// True for a hat: a four-way switch, which reports two axes with the values -1, 0 and 1.
bool is_hat(std::uint16_t code);

class GestureDetector {
 public:
  enum class Wanted { push, sweep };  // presses are found in either case

  // `rest`: code and rest value of the axes with a known state. An unknown rest value is 0 for a hat, and the first
  // value for another axis.
  GestureDetector(const DeviceInfo& info, const std::vector<std::pair<std::uint16_t, std::int32_t>>& rest);

  // Forgets what has moved so far. An axis away from rest is ignored until it has come back: its return belongs to the
  // gesture before. `after_press`: the same for axes that move in the same report as that press, as of a trigger
  // that is a button and an axis.
  void begin(Wanted wanted, bool after_press = false);
  // Takes the present values of all axes as their rest values. Hats keep 0.
  void take_rest();
  // The rest values after a new connection to the device. Other axes keep theirs.
  void reconnect(const std::vector<std::pair<std::uint16_t, std::int32_t>>& rest);

  Gesture feed(const RawEvent& raw, std::int64_t now_ns);
  // A gesture that ends because its axis stands still: a sweep, a new rest value. Call it every few tenths of a second.
  Gesture wait(std::int64_t now_ns);
  // True while an axis has moved far enough for a push and has not come back.
  bool is_held() const;
  // Time of the last press, or of the last move away from rest; nullopt: nothing has moved.
  std::optional<std::int64_t> last_motion_ns() const { return last_motion_ns_; }
  // [raw units] Distance between the rest value and the value at which the axis stayed longest after a push; the
  // largest of all pushes. 0 without a push.
  double rest_error(std::uint16_t code) const;

 private:
  struct Axis {
    double rest = 0.0;
    double value = 0.0;
    std::int64_t since_ns = 0;  // time of `value`
    double low = 0.0;           // extremes since begin()
    double high = 0.0;          // extremes since begin()
    double standing = 0.0;      // value since moved_ns, apart from jitter
    std::int64_t moved_ns = 0;
    bool ignored = false;           // until it has come back to rest
    bool was_pushed = false;        // a push was found; the two values below belong to the time after the last one
    std::int64_t longest_ns = -1;   // longest stay at one value near rest
    double error_of_longest = 0.0;  // [raw units] that value's distance from rest
    double largest_error = 0.0;     // [raw units] the same after earlier pushes
    double travel() const;
    double extreme() const { return high - rest >= rest - low ? high : low; }
  };

  Gesture take_axis(std::uint16_t code, double value, std::int64_t now_ns);
  Gesture find_push(std::uint16_t code, Axis& axis);
  Gesture find_sweep(std::uint16_t code, const Axis& axis) const;
  Gesture find_new_rest(std::uint16_t code, Axis& axis) const;
  void measure_rest(std::uint16_t code, Axis& axis, std::int64_t now_ns) const;
  double min_travel(std::uint16_t code) const;
  bool is_away(std::uint16_t code, const Axis& axis) const;
  bool another_moved_more(std::uint16_t code, const Axis& axis) const;

  std::array<std::optional<AxisRange>, ABS_CNT> ranges_;
  std::map<std::uint16_t, Axis> axes_;  // by code
  Wanted wanted_ = Wanted::push;
  bool in_report_of_press_ = false;
  std::int64_t press_ns_ = 0;  // time of the last press
  std::optional<std::int64_t> last_motion_ns_;
};

}  // namespace yars::inputmonitor
