// Input event of a pilot, panel or program: record, validation, text form.
// Inputs: the record from an input lane, or a text such as `tdc 0.5 0`.
// Outputs: the first fault of a record; the event of a text, and the text of an event.
// Units: degrees, feet and feet per second as stated per kind; times [ns].
// Errors: a text that matches no form is an Error with the valid forms of its verb.
// Source: docs/spec/pilots_interface.md#controls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "databuffer/messages/inspection.hpp"
#include "lib/error/error.hpp"

namespace yars::databuffer {

// Kind of an event and the use of its fields.
enum class EventKind : std::uint16_t {
  none = 0,
  push_button = 1,  // argument: 1..20
  tdc = 2,          // x, y: -1..1, held until the next one
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
  // Set by the instructor; argument: radar::Navigator; x north, y east.
  navigator_error = 17,  // x, y: [ft] of position
  navigator_drift = 18,  // x, y: [ft/s] rate of the position error
};

struct InputEvent {
  std::int64_t session_time_ns;  // [ns] sim time at which the source made it
  std::int64_t monotonic_ns;     // [ns] CLOCK_MONOTONIC at which the source made it; the reference of latency
  double x;                      // TDC deflection right [-1, 1], elevation [deg], or north [ft], [ft/s]
  double y;                      // TDC deflection up [-1, 1], or east [ft], [ft/s]
  std::uint16_t kind;            // EventKind
  std::int16_t argument;
  std::uint32_t number;  // counts up per source; `yars inject` waits for its own
  char text[16];         // zero-terminated
};
static_assert(sizeof(InputEvent) == 56 && std::is_trivially_copyable_v<InputEvent>);
static_assert(offsetof(InputEvent, kind) == 32 && offsetof(InputEvent, text) == 40);

// Returns the first fault of an input event as text, or nothing if it is valid. validation.hpp has the other records.
Refusal validate(const InputEvent& event);

// Text form of events, for scripts, `yars inject` and logs. `coolie up` is the castle switch.
//   pb 13 | tdc 0.5 0 | tdc press | tdc release | coolie up | acq fwd|aft | freeze | elevation -5 |
//   elevation up|down [STEPS] (0.5 deg each, project choice) | mode ag|aa|agr | radar rbm|hrm|bcn|pvu |
//   power off|stby|opr | nav mn|ins|toggle | nav error|drift mn|ins NORTH EAST (ft, ft/s) | sp 2.1 |
//   altimeter ok|fail | contrast up|down
// Words are separated by blanks; case is ignored.

// Parses an event; its times and number are zero. An error lists the valid forms.
error::Expected<InputEvent> event_from_text(std::string_view text);

// Shortest text that event_from_text() parses to the same event. For an event outside
// docs/spec/pilots_interface.md#controls it is a description that event_from_text() refuses.
std::string text_of(const InputEvent& event);

// Sets the name of a sequence point, as `sp NAME` does. A name over 16 bytes is cut, and validate() then refuses it.
void set_text(InputEvent& event, std::string_view name);

}  // namespace yars::databuffer
