// UPDT: the navigator chosen is put right by a sequence point that the pilot finds on the video.
// Source: docs/spec/pilots_interface.md#rule-13.
#pragma once

#include "statemachine/step.hpp"

namespace yars::statemachine {

// TDC release: moves the navigator so that the selected point stands under the cursor. Dead while nothing is shown, or
// while the data is INV.
void accept_update(Step& step);

// A tick: the errors from the selected point to the cursor, and how long an INS update may still use them.
void advance_update(databuffer::RadarState& state, const Surroundings& surroundings,
                    const radar::RadarConfiguration& configuration);

}  // namespace yars::statemachine
