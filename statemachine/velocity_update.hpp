// PVU and IPVU: the mission navigator's velocity is put right by what the radar measures.
// Source: docs/spec/pilots_interface.md#rule-16.
#pragma once

#include "statemachine/step.hpp"

namespace yars::statemachine {

// A tick: takes a new measurement of the model, shows it as differences along, across and vertical, and, once a period,
// corrects the navigator by them. IPVU shows its differences for a while, PVU as long as it runs.
void advance_velocity_update(databuffer::RadarState& state, const Surroundings& surroundings,
                             const radar::RadarConfiguration& configuration);

}  // namespace yars::statemachine
