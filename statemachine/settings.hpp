// Actions on power, master mode, radar mode and main menu, and on settings: range, scan width, window, antenna
// elevation, gain, brightness, contrast, switches.
// Source: docs/pilots_manual.md#rule-18, #rule-20, #rule-21, #rule-23.
#pragma once

#include <cstddef>
#include <string_view>

#include "lib/geo/quantity.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

// Range, scan width, window, antenna elevation. Source: docs/pilots_manual.md#rule-1, #rule-2, #rule-4.
void range_up(Step& step);
void range_down(Step& step);
void next_scan_width(Step& step);  // FULL, HALF, QTR, FULL
void step_window(Step& step);      // next larger (at most the range) or smaller window; below the smallest: blank
void set_elevation(Step& step);    // [deg] above the horizontal; clamped to the limits of the antenna
void step_elevation(Step& step);   // 0.5 deg up or down for each step of the event; the same limits

// Selects the range with this index. A window larger than the range is replaced by the largest window that fits.
void set_range_index(databuffer::RadarState& state, std::size_t index, const Parameters& parameters);
void set_scan_width(databuffer::RadarState& state, radar::ScanWidth scan, const Parameters& parameters);
// Selects the largest window that exceeds neither `window` nor the range.
void select_window(databuffer::RadarState& state, geo::Length window, const Parameters& parameters);

// Sets the range by height (rule 1). No change without a valid ownship.
void set_range_by_height(databuffer::RadarState& state, const Inputs& inputs, const Parameters& parameters);

// Reason why the recorder cannot be switched on: none is present, or the present one has stopped at a problem.
std::string_view recorder_problem(bool recorder_present);

// Switches and levels. Cyclic settings wrap around; levels stop at their ends.
// Source: docs/pilots_manual.md#buttons, #controls, #rule-9, #rule-19, #rule-22.
void toggle_declutter(Step& step);
void cycle_gain(Step& step);    // 3, 2, 1, 0, 3
void toggle_looks(Step& step);  // ML1, ML2
void brightness_up(Step& step);
void brightness_down(Step& step);
void step_contrast(Step& step);
void toggle_stabilizing(Step& step);  // STAB, PROG
void toggle_recorder(Step& step);     // rule 22: sends a request; refused with NO RECORDER or VTR FULL
void advance_recorder(databuffer::RadarState& state, const Inputs& inputs);  // one tick: VTR on while recording
void toggle_ipvu(Step& step);
void toggle_sniff(Step& step);      // rules 9, 19: SNIFF on cancels the map in progress and freezes HRM
void next_channel(Step& step);      // 1 to 8, then 1
void next_band(Step& step);         // A to E, then A
void select_navigator(Step& step);  // mission navigator, INS, or toggle
void switch_altimeter(Step& step);  // radar altimeter: working or failed

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
