// The flight of the scripted sortie: take-off to the east from the runway of config/sortie.guf's point 1, out, a turn
// and back onto the same runway; a track for `flight-model --source csv:FILE`. Speeds and heights are functions of
// time without steps; the way is straight lines and arcs whose lengths follow from the speeds.
#pragma once

#include <string>

namespace yars::endtoend {

inline constexpr double kRunwayElevation_m = 195.0;  // of the land that the test generates
inline constexpr double kSortie_s = 262.0;           // [s] how long it takes, standing still at both ends

// Columns of databuffer/flight/track_flight.hpp, a row each quarter of a second.
std::string sortie_track();

}  // namespace yars::endtoend
