// Actions on power, master mode, radar mode and main menu.
// Source: docs/pilots_manual.md#rule-18, #rule-20, #rule-21, #rule-23.
#pragma once

#include "statemachine/step.hpp"

namespace yars::statemachine {

void switch_power(Step& step);
void next_mode(Step& step);      // PB 6: cycles RBM, HRM, BCN (beacons), PVU
void select_mode(Step& step);    // hands-on control: selects RBM, HRM, BCN or PVU
void leave_patch(Step& step);    // back to the HRM PPI; keeps the range
void select_master(Step& step);  // A/G resumes its last mode
void open_menu(Step& step);
void close_menu(Step& step);

// Enters the patch mode, after a commanded map is complete.
void enter_patch(databuffer::RadarState& state);

// State with the settings of power-up (docs/pilots_manual.md#power-up). Power is off.
databuffer::RadarState power_up_settings(const Parameters& parameters);

}  // namespace yars::statemachine
