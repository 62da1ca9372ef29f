// Navigation errors of the mission navigator and the INS: initial values, drift, correction by UPDT, PVU and IPVU.
// Inputs: instructor events, cursor, velocity measurements of the model, configuration.
// Outputs: position error [m] and velocity error [m/s] of each navigator, which are added to its position and velocity;
//   for the display, the offset of UPDT and the velocity differences of PVU and IPVU; magnetic variation.
// Source: docs/spec/physics.md#navigation-errors
#pragma once

#include "statemachine/step.hpp"

namespace yars::statemachine {

// A position error displaces the symbols of points, and the coordinates that the navigator assigns to ground positions.
// Ownship and video use the true position. Events with values that are not finite change nothing.
void put_position_error(Step& step);  // `nav error`: position error [ft] north, east
void put_drift(Step& step);           // `nav drift`: velocity error [ft/s] north, east

// Errors of both navigators at the start of a session, from the configuration.
void put_initial_errors(databuffer::RadarState& state, const radar::NavigationConfiguration& navigation);

// One tick: the velocity errors change the position errors. Once per second a random walk changes the velocity errors
// of both navigators by the same amount, because the mission navigator is the INS with corrections.
void advance_navigators(databuffer::RadarState& state, std::int64_t tick, const Parameters& parameters);

// Magnetic variation [deg], east positive: from the navigator, else the geomagnetic model, else the configuration.
void put_variation(databuffer::RadarState& state, const Inputs& inputs, const Parameters& parameters);

// Error of the selected navigator.
databuffer::NavigatorError& error_in_use(databuffer::RadarState& state);

// UPDT: corrects the selected navigator. The pilot first places the cursor on the sequence point's echo in the video.
// Source: docs/pilots_manual.md#rule-13.

// TDC release: corrects the navigator's position so that the selected point is displayed at the cursor. The release has
// an effect only while the display shows the offset of advance_update(). With the INS selected, INV replaces the offset
// if the cursor was last moved too long ago.
void accept_update(Step& step);

// One tick: offset north and east [m] from the displayed selected point to the cursor, and the seconds left for an INS
// update.
void advance_update(databuffer::RadarState& state, const Inputs& inputs, const Parameters& parameters);

// PVU and IPVU: correct the velocity of the mission navigator by radar measurements.
// Source: docs/pilots_manual.md#rule-16.

// One tick: takes the radar model's new velocity measurement, if there is one, and corrects the mission navigator once
// per configured period. Shows radar velocity minus navigator velocity [m/s]: along the ground track, across it (right
// positive) and vertical (up positive). IPVU shows these differences for 10 s, PVU while the mode runs.
void advance_velocity_update(databuffer::RadarState& state, const Inputs& inputs, const Parameters& parameters);

}  // namespace yars::statemachine
