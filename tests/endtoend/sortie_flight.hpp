// Flight of the scripted sortie: take-off to the east from the runway of config/sortie.guf's point 1, out, a turn and
// back to the same runway. Output: a track for `flight-model --source csv:FILE`. Speeds and heights are continuous
// functions of time. The path has straight lines and arcs with lengths that follow from the speeds.
#pragma once

#include <string>

namespace yars::endtoend {

inline constexpr double kRunwayElevation_m = 195.0;  // of the land that the test generates
inline constexpr double kSortie_s = 262.0;           // [s] how long it takes, standing still at both ends

// Columns of databuffer/flight/track_flight.hpp, a row each quarter of a second.
std::string sortie_track();

}  // namespace yars::endtoend
