// Device decoder: bytes of the kernel's input layer to raw events, and raw events to input events by a device map.
// Inputs: bytes of struct input_event; state of the controls; the time of each call [ns, CLOCK_MONOTONIC].
// Outputs: input events without time stamps and numbers.
// Units: TDC deflection in steps of 0.01, elevation in steps of 0.1 deg.
// Threads: pure; one thread for each decoder.
// Source: docs/spec/formats.md#devices
#pragma once

#include <linux/input-event-codes.h>

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "databuffer/messages/input_event.hpp"
#include "inputmonitor/device_map.hpp"

namespace yars::inputmonitor {

// Event of the kernel's input layer: struct input_event without its time.
struct RawEvent {
  std::uint16_t type = 0;  // EV_SYN, EV_KEY, EV_ABS ...
  std::uint16_t code = 0;
  std::int32_t value = 0;
};

// Size of struct input_event (linux/input.h) in the layout of this machine.
inline constexpr std::size_t kRecordBytes = 24;

// Splits a byte stream into records. Any bytes and any chunk sizes are allowed. An incomplete record is kept.
class RecordStream {
 public:
  std::vector<RawEvent> feed(std::span<const std::byte> bytes);
  // For a new stream: drops an incomplete record.
  void restart() { kept_ = 0; }

 private:
  std::array<std::byte, kRecordBytes> record_{};
  std::size_t kept_ = 0;  // bytes of record_ received
};

// Minimum interval of stick values: 10 ms, shorter than a display frame. Fast devices report more often.
inline constexpr std::int64_t kValueInterval_ns = 10'000'000;
// Rate limit of presses: a burst of 60, and 100 per second. About ten times what a hand can do; more comes from a
// broken contact and is dropped.
inline constexpr double kPressBurst = 60.0;
inline constexpr double kPressesPerSecond = 100.0;
// A hat or rocker is pressed from 0.5 of its travel on, and released below 0.4. The hysteresis suppresses jitter.
inline constexpr double kPressThreshold = 0.5;
inline constexpr double kReleaseThreshold = 0.4;

// State of all controls of a device.
struct DeviceState {
  std::bitset<KEY_CNT> buttons;
  std::vector<std::pair<std::uint16_t, std::int32_t>> axes;  // code, value
};

// Decoder from raw events to input events by a map. TDC deflection is the sum of its axes and held buttons, clamped to
// [-1, 1]. Deflection and elevation are sent on change, at most every kValueInterval_ns, and before any press. The
// initial positions of levers, elevation axes and buttons send nothing.
class DeviceDecoder {
 public:
  using Events = std::vector<databuffer::InputEvent>;

  explicit DeviceDecoder(DeviceMap map);

  // Initial state. A deflected stick takes effect; all other controls take effect when they move.
  void begin(const DeviceState& state);
  void feed(const RawEvent& raw, std::int64_t now_ns);
  // True after lost events (SYN_DROPPED): call resync next, with the state of the device if it is available.
  bool needs_resync() const { return loss_ == Loss::complete; }
  // Takes over the state. Without a state, releases all held controls.
  void resync(const std::optional<DeviceState>& state, std::int64_t now_ns);
  void release_all();

  // Input events up to now.
  Events take(std::int64_t now_ns);
  // Time of the next event without a further raw event. None: no such event is due.
  std::optional<std::int64_t> deadline_ns() const;
  std::uint64_t dropped() const { return dropped_; }  // presses dropped by the rate limit

 private:
  enum class Loss { none, discarding, complete };  // discarding: until the next SYN_REPORT
  struct Switch {
    SwitchAction action;
    bool held = false;
    double deflection = 1.0;   // 0..1 of the travel; a smaller one slows repetitions
    std::int64_t next_ns = 0;  // of the next repetition
  };
  struct Axis {
    AxisAction action;
    double deflection = 0.0;       // of the TDC
    std::optional<int> detent;     // of a lever; none: not known
    std::size_t first_switch = 0;  // of directions: index of positive, followed by negative
  };

  static Switch switch_of(const SwitchAction& action);
  void change_button(std::uint16_t code, bool down, std::int64_t now_ns);
  void change_axis(std::uint16_t code, std::int32_t raw, std::int64_t now_ns, bool first);
  void move_lever(Axis& axis, double value, std::int64_t now_ns, bool first);
  void push(Switch& direction, double deflection, std::int64_t now_ns);
  void change(Switch& one, bool down, std::int64_t now_ns);
  bool may_press(std::int64_t now_ns);
  void send(const databuffer::InputEvent& event);
  void send_values();
  std::pair<double, double> deflection() const;
  bool values_wait() const;

  DeviceMap map_;
  std::vector<Switch> switches_;  // of the buttons, in the order of the map, then of the axes
  std::vector<Axis> axes_;
  std::pair<double, double> sent_deflection_{0.0, 0.0};
  std::optional<double> elevation_deg_;       // commanded by the axis
  std::optional<double> sent_elevation_deg_;  // none: not sent yet
  std::int64_t values_sent_ns_ = 0;
  Loss loss_ = Loss::none;
  double presses_left_ = kPressBurst;
  std::optional<std::int64_t> presses_counted_ns_;
  std::uint64_t dropped_ = 0;
  Events events_;
};

}  // namespace yars::inputmonitor
