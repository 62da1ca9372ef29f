// Range checks of records that YARS computes and publishes: model ticks, model status, sweeps, outputs. The ownship in
// a model tick must also pass databuffer::validate(). Result: the first fault, or nullopt.
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
