// Navigation errors: drift of the navigators, and their correction by UPDT, PVU and IPVU.
#pragma once

#include "statemachine/step.hpp"

namespace yars::statemachine {

// What the navigators have wrong: there from the start, put in by the instructor, grown by drift, taken out by updates.
// Truth and video never see it; symbols do. Source: docs/spec/physics.md#navigation-errors;
// docs/spec/pilots_interface.md#rule-13.
void put_position_error(Step& step);  // `nav error`: [ft] north, east
void put_drift(Step& step);           // `nav drift`: [ft/s] north, east

// The errors with which a session begins.
void put_first_errors(databuffer::RadarState& state, const radar::NavigationConfiguration& navigation);

// A tick of drift; the velocities walk at random once a second, those of both navigators alike: the mission navigator
// is the INS with what updates have put right.
void advance_navigators(databuffer::RadarState& state, std::int64_t tick,
                        const radar::RadarConfiguration& configuration);

// Magnetic variation: what the navigator gives, else the model of the field, else the configuration.
void put_variation(databuffer::RadarState& state, const Inputs& inputs, const radar::RadarConfiguration& configuration);

// The error of the navigator that updates and symbols use.
databuffer::NavigatorError& error_in_use(databuffer::RadarState& state);

// UPDT: the navigator chosen is put right by a sequence point that the pilot finds on the video.
// Source: docs/spec/pilots_interface.md#rule-13.

// TDC release: moves the navigator so that the selected point stands under the cursor. Dead while nothing is shown, or
// while the data is INV.
void accept_update(Step& step);

// A tick: the errors from the selected point to the cursor, and how long an INS update may still use them.
void advance_update(databuffer::RadarState& state, const Inputs& inputs,
                    const radar::RadarConfiguration& configuration);

// PVU and IPVU: the mission navigator's velocity is put right by what the radar measures.
// Source: docs/spec/pilots_interface.md#rule-16.

// A tick: takes a new measurement of the model, shows it as differences along, across and vertical, and, once a period,
// corrects the navigator by them. IPVU shows its differences for a while, PVU as long as it runs.
void advance_velocity_update(databuffer::RadarState& state, const Inputs& inputs,
                             const radar::RadarConfiguration& configuration);

}  // namespace yars::statemachine
