// Text form of an input event of a pilot, panel or program. input_event_record.idl defines the record, validation.hpp
// checks it.
// Inputs: the record from an input lane, or a text such as `tdc 0.5 0`.
// Outputs: the event parsed from a text; the text of an event.
// Units: degrees (antenna elevation above the horizontal), feet and feet per second as stated per kind; times [ns].
// Errors: a text that matches no form is an Error with the valid forms of its verb.
// Source: docs/pilots_manual.md#controls.
#pragma once

#include <string>
#include <string_view>

#include "databuffer/messages/input_event_record.hpp"
#include "lib/error/error.hpp"

namespace yars::databuffer {

// Text form of events, for scripts, `yars inject` and logs. `coolie up` is a push of the castle switch.
//   pb 13 | tdc 0.5 0 | tdc press | tdc release | cursor 0.5 0.4 | coolie up | acq fwd|aft | freeze | elevation -5 |
//   elevation up|down [STEPS] (0.5 deg each, project choice) | mode ag|aa|agr | radar rbm|hrm|bcn|pvu |
//   power off|stby|opr | nav mn|ins|toggle | nav error|drift mn|ins NORTH EAST (ft, ft/s) | sp 2.1 |
//   altimeter ok|fail | contrast up|down | next
// Words are separated by blanks; case is ignored.

// Parses an event. The times and the sequence number of the result are zero. A value out of range is an error, too. The
// error names the event that a misspelled one most likely means. Else it lists the valid forms of the verb, or all
// forms if the verb is unknown.
error::Expected<InputEvent> event_from_text(std::string_view text);

// All forms, a line for each verb: "acq fwd | acq aft".
std::string event_forms();

// Shortest text that event_from_text() parses to an event of the same kind and values. An event without a text form
// (docs/pilots_manual.md#controls) gives a description that event_from_text() refuses.
std::string text_of(const InputEvent& event);

// Sets the name of a sequence point, as `sp NAME` does. A name of 16 bytes or more is cut to 16 bytes. The name
// then has no final zero byte, and validate() refuses the event.
void set_text(InputEvent& event, std::string_view name);

}  // namespace yars::databuffer
