// Input event: its validation, its text form. The record: input_event_record.idl.
#pragma once

#include <string>
#include <string_view>

#include "databuffer/messages/input_event_record.hpp"
#include "databuffer/messages/inspection.hpp"
#include "lib/error/error.hpp"

namespace yars::databuffer {

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
