// Device's bytes into raw events, and these, by its map, into input events.
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

// What a device of the kernel's input layer says: struct input_event without its time.
struct RawEvent {
  std::uint16_t type = 0;  // EV_SYN, EV_KEY, EV_ABS ...
  std::uint16_t code = 0;
  std::int32_t value = 0;
};

// Bytes of struct input_event (linux/input.h, this machine's layout), cut anywhere, into events. Any bytes are allowed;
// a record whose end has not come yet is kept.
inline constexpr std::size_t kRecordBytes = 24;

class RecordStream {
 public:
  std::vector<RawEvent> feed(std::span<const std::byte> bytes);
  // Another stream begins: half a record is forgotten.
  void restart() { kept_ = 0; }

 private:
  std::array<std::byte, kRecordBytes> record_{};
  std::size_t kept_ = 0;  // bytes of record_ that have come
};

// [ns] between values of a stick; faster than the glass is drawn, slower than the fastest devices report
inline constexpr std::int64_t kValueInterval_ns = 10'000'000;
// Presses in a row, and per second, that a hand could make ten times over; the rest are a broken contact's and dropped.
inline constexpr double kPressBurst = 60.0;
inline constexpr double kPressesPerSecond = 100.0;
// Share of the travel at which a hat or rocker counts as pushed, and below which it has come back.
inline constexpr double kPushed = 0.5;
inline constexpr double kLetGo = 0.4;

// All that a device's controls are at one moment.
struct DeviceState {
  std::bitset<KEY_CNT> buttons;
  std::vector<std::pair<std::uint16_t, std::int32_t>> axes;  // code, value
};

// What a device says, by its map, into events. Pure: it is told the time. The TDC's deflection is the sum of its axes
// and of the buttons held that deflect it, cut to [-1, 1], in hundredths; elevation goes in tenths of a degree. Such a
// value is sent when it changes, at most every 10 ms, and before any press. A lever or an elevation at rest when the
// device comes sends nothing, nor does a button that is held then.
class DeviceDecoder {
 public:
  using Events = std::vector<databuffer::InputEvent>;

  explicit DeviceDecoder(DeviceMap map);

  // Where the controls are when the device comes: a stick that is deflected deflects, all else waits for a move.
  void begin(const DeviceState& state);
  void feed(const RawEvent& raw, std::int64_t now_ns);
  // The kernel lost events (SYN_DROPPED): the next thing to do is catch_up, with the device's state where it can be
  // had.
  bool has_lost() const { return lost_ == Loss::over; }
  void catch_up(const std::optional<DeviceState>& state, std::int64_t now_ns);
  // Lets go of everything held.
  void let_go();

  // What has come of it until now, and when there will be more without a further event of the device.
  Events take(std::int64_t now_ns);
  std::optional<std::int64_t> deadline_ns() const;
  std::uint64_t dropped() const { return dropped_; }  // presses, since the beginning

 private:
  enum class Loss { none, going_on, over };
  struct Switch {
    SwitchAction action;
    bool held = false;
    double deflection = 1.0;   // share of the travel: repetitions slow down with it
    std::int64_t next_ns = 0;  // of the next repetition
  };
  struct Axis {
    AxisAction action;
    double deflection = 0.0;       // of the TDC
    std::optional<int> place;      // of a lever
    std::size_t first_switch = 0;  // of directions: positive, then negative
  };

  static Switch switch_of(const SwitchAction& action);
  void change_button(std::uint16_t code, bool down, std::int64_t now_ns);
  void change_axis(std::uint16_t code, std::int32_t raw, std::int64_t now_ns, bool first);
  void move_lever(Axis& axis, double value, std::int64_t now_ns, bool first);
  void push(Switch& way, double deflection, std::int64_t now_ns);
  void change(Switch& one, bool down, std::int64_t now_ns);
  bool may_press(std::int64_t now_ns);
  void send(const databuffer::InputEvent& event);
  void send_values();
  std::pair<double, double> deflection() const;
  bool values_wait() const;

  DeviceMap map_;
  std::vector<Switch> switches_;  // those of the buttons, in the map's order, then those of the axes
  std::vector<Axis> axes_;
  std::pair<double, double> sent_deflection_{0.0, 0.0};
  std::optional<double> elevation_deg_;       // that its axis commands
  std::optional<double> sent_elevation_deg_;  // none: it has not moved yet
  std::int64_t values_sent_ns_ = 0;
  Loss lost_ = Loss::none;
  double presses_left_ = kPressBurst;
  std::optional<std::int64_t> presses_counted_ns_;
  std::uint64_t dropped_ = 0;
  Events events_;
};

}  // namespace yars::inputmonitor
