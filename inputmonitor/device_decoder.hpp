// Decoder of one input device: bytes of evdev (the Linux interface of input devices) to raw events, and raw events to
// input events.
// Inputs: bytes of struct input_event; device map; state of the controls; the time of each call [ns, CLOCK_MONOTONIC].
// Outputs: input events, with time stamps and sequence numbers of 0.
// Units: TDC deflection in [-1, 1], rounded to 0.01; antenna elevation [deg above the horizontal], rounded to 0.1.
// Threads: one thread per decoder. No system calls.
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

// Linux evdev event: struct input_event without its time.
struct RawEvent {
  std::uint16_t type = 0;  // EV_SYN, EV_KEY, EV_ABS ...
  std::uint16_t code = 0;
  std::int32_t value = 0;
};

// [bytes] sizeof(struct input_event) (linux/input.h) on a 64-bit machine.
inline constexpr std::size_t kRecordBytes = 24;

// Splits a byte stream into records. Chunks may have any size. An incomplete record waits for the next chunk.
class RecordStream {
 public:
  std::vector<RawEvent> feed(std::span<const std::byte> bytes);
  // Begins a new stream: drops an incomplete record.
  void restart() { kept_ = 0; }

 private:
  std::array<std::byte, kRecordBytes> record_{};
  std::size_t kept_ = 0;  // number of bytes of record_ received so far
};

// The values of a decoder are TDC deflection and antenna elevation. Minimum interval between events of values: 10 ms,
// because some devices report more often. The interval is shorter than a display frame.
inline constexpr std::int64_t kValueInterval_ns = 10'000'000;
// Rate limit of presses (token bucket): a bucket of 60 presses is refilled at 100 per second, about ten times the rate
// of a hand. Repetitions and lever steps count as presses. Presses above the limit come from a broken contact and are
// dropped.
inline constexpr double kPressBurst = 60.0;
inline constexpr double kPressesPerSecond = 100.0;
// Thresholds of the deflection (device_map.hpp) of a hat or rocker: pressed at 0.5 or more, released below 0.4. The
// hysteresis suppresses jitter.
inline constexpr double kPressThreshold = 0.5;
inline constexpr double kReleaseThreshold = 0.4;

// State of all controls of a device.
struct DeviceState {
  std::bitset<KEY_CNT> buttons;
  std::vector<std::pair<std::uint16_t, std::int32_t>> axes;  // code, raw value
};

// Decoder from raw events to input events by a device map.
// TDC deflection is the sum of all TDC axes and the `tdc` events of all held switches, clamped to [-1, 1] in x and y.
// Values are sent on change, at most once per kValueInterval_ns. A pending change is sent at once before a press or
// release. The initial positions of controls other than TDC axes send no event.
class DeviceDecoder {
 public:
  using Events = std::vector<databuffer::InputEvent>;

  explicit DeviceDecoder(DeviceMap map);

  // Sets the initial state. A deflected TDC axis takes effect at once. Every other control takes effect when it moves.
  void begin(const DeviceState& state);
  void feed(const RawEvent& raw, std::int64_t now_ns);
  // True after the kernel lost events (SYN_DROPPED), from the next SYN_REPORT until resync(). Then call resync().
  bool needs_resync() const { return loss_ == Loss::complete; }
  // Call after a loss of events. Sets all controls to `state`, or calls release_all() if `state` is nullopt.
  void resync(const std::optional<DeviceState>& state, std::int64_t now_ns);
  // Sends the end of a TDC press and of a TDC deflection. All other held switches are released without an event.
  void release_all();

  // Returns the events since the last call, with pending values and repetitions that are due.
  Events take(std::int64_t now_ns);
  // Time of the next pending value or repetition [ns, CLOCK_MONOTONIC]; nullopt if nothing is pending.
  std::optional<std::int64_t> deadline_ns() const;
  std::uint64_t dropped() const { return dropped_; }  // presses dropped by the rate limit

 private:
  // discarding: events up to the next SYN_REPORT are ignored. complete: resync() is due.
  enum class Loss { none, discarding, complete };
  struct Switch {
    SwitchAction action;
    bool held = false;
    double deflection = 1.0;   // [0, 1]; 1 for a button. The factor of the repetition rate is max(deflection, 0.1)
    std::int64_t next_ns = 0;  // time of the next repetition
  };
  struct Axis {
    AxisAction action;
    double deflection = 0.0;       // TDC axis only: [-1, 1]
    std::optional<int> detent;     // lever only: index of the detent; nullopt: unknown
    std::size_t first_switch = 0;  // hat or rocker only: index in switches_ of its positive switch; then its negative
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
  std::vector<Switch> switches_;  // one per button in the order of the map, then two per hat or rocker axis
  std::vector<Axis> axes_;
  std::pair<double, double> sent_deflection_{0.0, 0.0};
  std::optional<double> elevation_deg_;       // commanded by the elevation axis; nullopt: axis position unknown
  std::optional<double> sent_elevation_deg_;  // last one sent, or the initial position; nullopt: neither
  std::int64_t values_sent_ns_ = 0;
  Loss loss_ = Loss::none;
  double presses_left_ = kPressBurst;               // tokens of the rate limit
  std::optional<std::int64_t> presses_counted_ns_;  // time of the last refill; nullopt: no press yet
  std::uint64_t dropped_ = 0;
  Events events_;
};

}  // namespace yars::inputmonitor
