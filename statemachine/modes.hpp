// Power, master mode, radar mode and menu. Source: docs/spec/pilots_interface.md#rule-18, #rule-20, #rule-21, #rule-23.
#pragma once

#include "statemachine/step.hpp"

namespace yars::statemachine {

void switch_power(Step& step);
void next_mode(Step& step);      // PB 6: RBM, HRM, BCN, PVU, RBM
void select_mode(Step& step);    // HOTAS
void leave_patch(Step& step);    // back to the HRM PPI; the range stays
void select_master(Step& step);  // A/G resumes the mode it left
void open_menu(Step& step);
void close_menu(Step& step);

// A map has come: whatever ground mode ran, the patch runs now.
void enter_patch(databuffer::RadarState& state);

// The settings of power-up, with the power still off.
databuffer::RadarState power_up_settings(const radar::RadarConfiguration& configuration);

}  // namespace yars::statemachine
