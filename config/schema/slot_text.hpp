// Reads one value of a configuration file into the field of its slot. Prints slots, configurations and the manual.
// Inputs: a row of schema.hpp, and a value of the syntax tree or a configuration.
// Outputs: the field of the slot; GUF text that reads back as an equal configuration; Markdown.
// Units: the value has the unit in the slot's row. The field has the unit in the field's name; NumberSlot converts.
// Errors: ParseError with location, kind and range of the slot, and the value found.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/guf/tree.hpp"
#include "config/schema/schema.hpp"

namespace yars::config {

// Validates one value and writes it into the field of its slot. Throws ParseError. Values that are forms are read by
// FormReader instead. For a lat-long form, FormReader fills builder.angle and then calls read_sexagesimal(). A call of
// read_simple() for a FormSlot aborts the program.
void read_simple(ConfigurationBuilder& builder, const SlotSchema& slot, const Value& value);

// Writes the latitude or longitude in builder.angle into the field of `slot`. `where` is the location of the form.
// Throws ParseError for a latitude with E or W, a longitude with N or S, or an angle out of range.
void read_sexagesimal(ConfigurationBuilder& builder, const SlotSchema& slot, const Location& where);

// The value of a slot as GUF text. Empty: the slot is unused (it writes no field) or contains forms, or its value is
// unknown (NaN, or a negative index of a ChoiceSlot).
std::string slot_text(ConfigurationBuilder& builder, const SlotSchema& slot);

// A configuration as GUF text, which reads back as an equal configuration. The text omits unused slots, slots with an
// unknown value, and slots with the same effect as another slot (SlotSchema::same_as).
std::string print_configuration(const radar::RadarConfiguration& configuration);

// Like print_configuration(), with a comment before each slot: position, kind, range, default, purpose. Forms that were
// not printed follow as comments.
std::string print_explained(const radar::RadarConfiguration& configuration);

// The form Devices as GUF text. Each radar::Device states what the buttons and axes of one input device do.
std::string print_devices(const std::vector<radar::Device>& devices);

// Names of the groups of forms. Every form is in one group. The manual has a page for each group:
// docs/configuration.md#forms-and-slots.
std::vector<std::string> form_groups();

// Manual of the forms of one group in Markdown, one table for each form: position, slot, value, default, purpose.
// Empty: `group` is not in form_groups().
std::string print_markdown(std::string_view group);

}  // namespace yars::config
