// One value into the field of its slot, with its check. Forms are read by the caller.
#pragma once

#include "config/draft.hpp"
#include "config/schema.hpp"
#include "config/value.hpp"

namespace yars::config {

// Throws Rejection at the value's place with kind, range and what was found. Not for FormSlot; an AngleSlot's form is
// read into draft.angle before.
void read_simple(Draft& draft, const SlotSchema& slot, const Value& value);

// A latitude or longitude from draft.angle; `where` is the lat-long form's place.
void read_sexagesimal(Draft& draft, const SlotSchema& slot, const Location& where);

}  // namespace yars::config
