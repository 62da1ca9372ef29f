// Power, master mode, radar mode, menu and freeze. Source: spec pvi.md rules 8, 18 to 21, 23.
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
void toggle_freeze(Step& step);

// The settings of power-up, with the power still off.
databuffer::RadarState power_up_settings(const radar::RadarConfiguration& configuration);

// Rule 19: HRM that may not transmit keeps the picture it has.
void freeze_silent_hrm(databuffer::RadarState& state);

}  // namespace yars::statemachine
