// Slots as text: a value read into its field, fields printed, whole configurations, the manual.
#pragma once

#include <string>

#include "config/guf/tree.hpp"
#include "config/schema/schema.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::config {

// One value into the field of its slot, with its check. Throws ParseError at the value's place with kind, range and
// what was found. Not for FormSlot: forms are read by the caller; an AngleSlot's form is read into draft.angle before.
void read_simple(ConfigurationBuilder& draft, const SlotSchema& slot, const Value& value);

// A latitude or longitude from draft.angle; `where` is the lat-long form's place.
void read_sexagesimal(ConfigurationBuilder& draft, const SlotSchema& slot, const Location& where);

// What a slot holds in a draft, as GUF text. Empty when there is nothing to write: the slot is used by nothing, holds
// forms, or stands for "unknown".
std::string slot_text(ConfigurationBuilder& draft, const SlotSchema& slot);

// A configuration as GUF text. Reads back as an equal one: every slot that is used, numbers in full.
std::string print_configuration(const radar::RadarConfiguration& configuration);

// The same, each slot below a comment that tells position, kind, range, default and purpose; then the forms that stand
// only inside slots, all in comments.
std::string print_explained(const radar::RadarConfiguration& configuration);

// The maps of devices alone, as a file of their own.
std::string print_devices(const radar::RadarConfiguration& configuration);

// The schema as a manual: one Markdown table a form: position, slot, value, default, purpose.
std::string print_markdown();

}  // namespace yars::config
