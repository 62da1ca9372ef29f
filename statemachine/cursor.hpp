// The cursor: held on its ground point (docs/spec/pilots_interface.md#rule-12), slewed by the TDC in the frame of the
// glass: ground track up, or, on a patch map, line of sight up, fixed at its start
// (docs/spec/pilots_interface.md#rule-5). Its place is that on the video; what the navigator makes of it stands beside
// it, for whoever is told. It may lie off the glass (the aircraft has passed it, the range is shorter, the point jumped
// to is far); slewing brings it to the edge first.
#pragma once

#include "statemachine/step.hpp"

namespace yars::statemachine {

void deflect(Step& step);               // TDC, held until changed
void next_cursor_function(Step& step);  // MAP, UPDT, CUE, TGT, MARK, MAP; in SET without MAP

// Puts the cursor where the glass draws a place that the navigator knows by its coordinates.
void jump_cursor(databuffer::RadarState& state, geo::GeoPoint known, const Surroundings& surroundings);

// PVU shows no cursor; in A/A and ranging there is a picture to slew it over in SET alone.
bool shows_cursor(const databuffer::RadarState& state);

// A tick of the cursor: the frame follows the aircraft unless the picture is frozen or a map, the deflection moves the
// cursor, bearing and range follow. A cursor that was nowhere goes to the selected point when that is on the glass,
// else half the range ahead, or to the middle of the map. Needs a valid ownship.
void advance_cursor(databuffer::RadarState& state, const Surroundings& surroundings,
                    const radar::RadarConfiguration& configuration);

}  // namespace yars::statemachine
