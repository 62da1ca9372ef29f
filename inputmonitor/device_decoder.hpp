// Device map (input events of each button and axis, response curves of the axes) and decoder of one input device: bytes
// of evdev (the Linux interface of input devices) to raw events, and raw events to input events.
// Inputs: a map from GUF (radar::Device); name, ids, controls of the device; bytes of struct input_event; state of the
// controls; time of each call [ns, CLOCK_MONOTONIC]. Outputs: DeviceMap; input events, with time stamps and numbers of
// 0. Units: TDC deflection in [-1, 1], rounded to 0.01; antenna elevation [deg above the horizontal], rounded to 0.1.
// Errors: an unknown code, an invalid event, an axis without a known range or with a centre outside its range.
// Threads: one thread per decoder. No system calls. Source: docs/spec/formats.md#devices. A hat is a small four-way
// switch: two axes with values -1, 0 and 1. A rocker rests in the middle. A lever stays where it is put; its travel has
// steps (detents).
#pragma once

#include <linux/input-event-codes.h>

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "databuffer/messages/input_event.hpp"
#include "lib/error/error.hpp"
#include "lib/radar/devices.hpp"

namespace yars::inputmonitor {

// Response curve of an axis: raw value to deflection in [-1, 1].
//   v = (raw - centre) / |end - centre|, clamped to [-1, 1]; end: high if raw >= centre, else low; if inverted, -v
//   t = (|v| - dead zone) / (1 - dead zone); 0 within the dead zone
//   deflection = sign(v) ((1 - curve) t + curve t^3): continuous, odd, 1 at the end
struct AxisShape {
  double low = -1.0;  // [raw units] low < centre < high
  double high = 1.0;
  double centre = 0.0;
  double dead_zone = 0.0;  // [0, 0.9] fraction of the travel from the centre to one end
  double curve = 0.0;      // [0, 1] 0: linear; 1: cubic
  bool inverted = false;
};

// Deflection in [-1, 1] of a raw value, by the response curve.
double shaped(std::int32_t raw, const AxisShape& shape);

// Range of an axis [raw units].
struct AxisRange {
  std::int32_t low = 0;
  std::int32_t high = 0;
};

// Name, ids and controls of a device, as the kernel reports them.
struct DeviceInfo {
  bool known = false;  // false for a FIFO or a file: the other members have no values
  std::string name;
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::bitset<KEY_CNT> buttons;
  std::array<std::optional<AxisRange>, ABS_CNT> axes;
};

// Events of a button, or of one direction of a hat, rocker or lever.
struct SwitchAction {
  std::optional<databuffer::InputEvent> press;
  std::optional<databuffer::InputEvent> release;
  std::int64_t repeat_ns = 0;  // interval between repetitions of `press` while held; 0: no repetition
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
  SwitchAction positive;      // hat, rocker: events of a push toward deflection 1; lever: of each step toward it
  SwitchAction negative;      // the same for deflection -1
  double lowest_deg = -60.0;  // elevation axis: antenna elevation above the horizontal at deflection -1
  double highest_deg = 60.0;  // elevation axis: antenna elevation above the horizontal at deflection 1
  int steps = 16;             // lever: number of detents
};

// Resolved map of one device: codes as numbers, events parsed, axis ranges from the map or else from the device.
struct DeviceMap {
  std::string name;
  std::vector<ButtonAction> buttons;
  std::vector<AxisAction> axes;
};

// The last map whose conditions (lib/radar/devices.hpp) the device meets; nullptr if no map fits or `info.known` is
// false.
const radar::Device* fitting_map(const DeviceInfo& info, std::span<const radar::Device> maps);
// The last map with that name; nullptr if there is none.
const radar::Device* named_map(std::string_view name, std::span<const radar::Device> maps);

// Resolves a map for a device. An axis range comes from the map, else from the device, else for a hat it is -1 to 1.
// Axes that a known device does not have are omitted. Errors: as in the header of this file.
error::Expected<DeviceMap> resolve_map(const radar::Device& device, const DeviceInfo& info);

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
// Thresholds of the deflection of a hat or rocker: pressed at 0.5 or more, released below 0.4. The
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
