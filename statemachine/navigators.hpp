// What the navigators have wrong: there from the start, put in by the instructor, grown by drift, taken out by updates.
// Truth and video never see it; symbols do. Source: docs/spec/physics.md#navigation-errors;
// docs/spec/pilots_interface.md#rule-13.
#pragma once

#include "statemachine/step.hpp"

namespace yars::statemachine {

void put_position_error(Step& step);  // `nav error`: [ft] north, east
void put_drift(Step& step);           // `nav drift`: [ft/s] north, east

// The errors with which a session begins.
void put_first_errors(databuffer::RadarState& state, const radar::NavigationConfiguration& navigation);

// A tick of drift; the velocities walk at random once a second, those of both navigators alike: the mission navigator
// is the INS with what updates have put right.
void advance_navigators(databuffer::RadarState& state, std::int64_t tick,
                        const radar::RadarConfiguration& configuration);

// Magnetic variation: what the navigator gives, else the model of the field, else the configuration.
void put_variation(databuffer::RadarState& state, const Surroundings& surroundings,
                   const radar::RadarConfiguration& configuration);

// The error of the navigator that updates and symbols use.
databuffer::NavigatorError& error_in_use(databuffer::RadarState& state);

}  // namespace yars::statemachine
