// Input event: the record, its validation, its text form.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "databuffer/messages/inspection.hpp"
#include "lib/error/error.hpp"

namespace yars::databuffer {

// One thing that a pilot's hand, a panel or a program did. As text: event_from_text().
enum class EventKind : std::uint16_t {
  none = 0,
  push_button = 1,  // argument: 1..20
  tdc = 2,          // x, y: -1..1, held until changed
  tdc_press = 3,
  tdc_release = 4,
  castle_up = 5,
  acquisition = 6,  // argument: +1 fwd, -1 aft
  freeze = 7,
  elevation = 8,        // x: [deg] absolute
  elevation_step = 9,   // argument: steps of 0.5 deg, signed
  master_mode = 10,     // argument: radar::Master
  radar_mode = 11,      // argument: radar::Mode
  power = 12,           // argument: radar::Power
  navigator = 13,       // argument: radar::Navigator, or -1 to toggle
  sequence_point = 14,  // text: its name
  altimeter = 15,       // argument: 1 ok, 0 fail
  contrast = 16,        // argument: +1 up, -1 down
  // The instructor's: argument: radar::Navigator; north and east.
  navigator_error = 17,  // x, y: [ft] of position
  navigator_drift = 18,  // x, y: [ft/s] of velocity
};

struct InputEvent {
  std::int64_t session_time_ns;  // [ns] sim time when the source made it
  std::int64_t monotonic_ns;     // [ns] CLOCK_MONOTONIC when the source made it; latency is measured from it
  double x;                      // TDC deflection right [-1, 1], or elevation [deg]
  double y;                      // TDC deflection up [-1, 1]
  std::uint16_t kind;            // EventKind
  std::int16_t argument;
  std::uint32_t number;  // counts up per source; `yars inject` waits for its own
  char text[16];         // zero terminated
};
static_assert(sizeof(InputEvent) == 56 && std::is_trivially_copyable_v<InputEvent>);
static_assert(offsetof(InputEvent, kind) == 32 && offsetof(InputEvent, text) == 40);

// The first fault of an input event as text; nothing for a good one. Other records: validation.hpp.
Refusal validate(const InputEvent& event);

// Events as people write them: in scripts, by `yars inject`, in logs. One table serves both directions.
//   pb 13 | tdc 0.5 0 | tdc press | tdc release | coolie up | acq fwd|aft | freeze | elevation -5 |
//   elevation up|down [STEPS] (0.5 deg each, project choice) | mode ag|aa|agr | radar rbm|hrm|bcn|pvu |
//   power off|stby|opr | nav mn|ins|toggle | sp 2.1 | altimeter ok|fail | contrast up|down
// Words are separated by blanks, letters of either case. Source: docs/spec/pilots_interface.md#controls.

// The event without times and number (zero). An error lists the forms that would have been right.
error::Expected<InputEvent> event_from_text(std::string_view text);

// The shortest text that event_from_text turns back into the same event; one that is none of
// docs/spec/pilots_interface.md#controls gives a text that says so and that event_from_text refuses.
std::string text_of(const InputEvent& event);

// Sets the name of a sequence point, as `sp NAME` does; a longer name is cut, and validation then refuses it.
void set_text(InputEvent& event, std::string_view name);

}  // namespace yars::databuffer
