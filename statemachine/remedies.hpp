// Remedy of the message on the display: what the pilot can do about it, in words.
// Inputs: the radar state with its message, inputs of the tick, limits of the configuration.
// Outputs: a text in printable ASCII of at most about 100 characters, such as "turn 5 deg or more left". A remedy names
// an event with its key in parentheses: "acq fwd (PgUp)".
// Source: docs/pilots_manual.md#remedies
#pragma once

#include <string>
#include <string_view>

#include "statemachine/step.hpp"

namespace yars::statemachine {

// Remedy for INV, which the display shows in place of the errors of UPDT.
inline constexpr const char* kRemedyForInv = "move the cursor, then release within its seconds";

// Message of the step from the smallest window to the blank one.
inline constexpr std::string_view kBlankWindow = "BLANK WINDOW";

// Remedy for RadarState::message. Empty: no message, or nothing is to be done (MARK 3).
// For a refused map the angles and distances are those from the aircraft now to the cursor; while re-mapping stops,
// those to the centre of the map.
std::string remedy_of_message(const databuffer::RadarState& state, const Inputs& inputs, const Parameters& parameters);

}  // namespace yars::statemachine
