// The border for input events; see validation.hpp.
#pragma once

#include "databuffer/records/input_event.hpp"
#include "databuffer/records/refusal.hpp"

namespace yars::databuffer {

Refusal why_refused(const InputEvent& event);

}  // namespace yars::databuffer
