// Ranges of what our own programs publish and the border does not judge, since they are its near side: model ticks,
// model status, sweeps, outputs. What comes in them from outside has passed validation.hpp and must still pass it.
#pragma once

#include "databuffer/messages/inspection.hpp"
#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/radar_state.hpp"

namespace yars::endtoend::storm {

databuffer::Refusal why_out_of_range(const databuffer::ModelTick& tick);
databuffer::Refusal why_out_of_range(const databuffer::ModelStatus& status);
databuffer::Refusal why_out_of_range(const databuffer::Sweep& sweep);
databuffer::Refusal why_out_of_range(const databuffer::Outputs& outputs);

}  // namespace yars::endtoend::storm
