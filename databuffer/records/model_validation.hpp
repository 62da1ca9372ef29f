// The border for what the radar model publishes; see validation.hpp. NaN stands where the records allow "unknown".
#pragma once

#include "databuffer/records/model_records.hpp"
#include "databuffer/records/refusal.hpp"

namespace yars::databuffer {

Refusal why_refused(const ModelStatus& status);
Refusal why_refused(const Sweep& sweep);
Refusal why_refused(const ModelTick& tick);

}  // namespace yars::databuffer
