#include "lib/radar/ground_track.hpp"

#include <cmath>

namespace yars::radar {

geo::Bearing ground_track(geo::Speed north, geo::Speed east, geo::Bearing heading) {
  const double north_mps = north.metres_per_second();
  const double east_mps = east.metres_per_second();
  // Slower than this an aircraft stands or is towed, and its track would swing with every bit of noise.
  constexpr double kStanding_mps = 1.0;
  if (std::hypot(north_mps, east_mps) < kStanding_mps) return heading;
  return geo::Bearing::radians(std::atan2(east_mps, north_mps));
}

}  // namespace yars::radar
