// Reads one value of a configuration file into the field of its slot.
// Inputs: a row of schema.hpp, and a value of the syntax tree.
// Output: the field of the slot.
// Units: the value has the unit in the slot's row. The field has the unit in the field's name; NumberSlot converts.
// Errors: ParseError with location, kind and range of the slot, and the value found.
#pragma once

#include <string>

#include "config/guf/tree.hpp"
#include "config/schema/schema.hpp"

namespace yars::config {

// Throws ParseError for a value that the slot does not take. Its fault names the slot and its limits.
[[noreturn]] void reject_value(const Location& where, const SlotSchema& slot, std::string found,
                               std::string action = {});

// Validates one value and writes it into the field of its slot. Throws ParseError. Values that are forms are read by
// FormReader instead. For a lat-long form, FormReader fills builder.angle and then calls read_sexagesimal(). A call of
// read_simple() for a FormSlot aborts the program.
void read_simple(ConfigurationBuilder& builder, const SlotSchema& slot, const Value& value);

// Writes the latitude or longitude in builder.angle into the field of `slot`. `where` is the location of the form.
// Throws ParseError for a latitude with E or W, a longitude with N or S, or an angle out of range.
void read_sexagesimal(ConfigurationBuilder& builder, const SlotSchema& slot, const Location& where);

}  // namespace yars::config
