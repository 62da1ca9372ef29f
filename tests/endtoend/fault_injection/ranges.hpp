// Range checks of records that YARS publishes and does not validate itself: model ticks, model status, sweeps, outputs.
// Fields that come from outside must still pass validation.hpp.
#pragma once

#include "databuffer/messages/inspection.hpp"
#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/radar_state.hpp"

namespace yars::endtoend::fault_injection {

databuffer::Refusal why_out_of_range(const databuffer::ModelTick& tick);
databuffer::Refusal why_out_of_range(const databuffer::ModelStatus& status);
databuffer::Refusal why_out_of_range(const databuffer::Sweep& sweep);
databuffer::Refusal why_out_of_range(const databuffer::Outputs& outputs);

}  // namespace yars::endtoend::fault_injection
