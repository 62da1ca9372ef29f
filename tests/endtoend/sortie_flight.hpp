// Flight of the scripted sortie: take-off to the east from the runway at point 1 of config/sortie.guf, a half circle,
// and back to the same runway. Output: a track for `flight-model --source csv:FILE`. Speed and height are continuous
// functions of time. The path consists of straight lines and arcs; the distance that results from the speeds sets
// the lengths of the straight lines.
#pragma once

#include <string>

namespace yars::endtoend {

inline constexpr double kRunwayElevation_m = 195.0;  // in the terrain that the test generates
inline constexpr double kSortie_s = 262.0;           // duration; the aircraft stands still at both ends

// The track as a CSV text with the columns of flightmodel/source_reader.hpp, one row each 0.25 s.
std::string sortie_track();

}  // namespace yars::endtoend
