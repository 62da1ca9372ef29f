// Which way the aircraft goes over ground: the axis of the scan and of the glass.
#pragma once

#include "lib/geo/bearing.hpp"

namespace yars::radar {

// Direction of the velocity; below 1 m/s, where a velocity has no direction worth following, the heading.
geo::Bearing ground_track(geo::Speed north, geo::Speed east, geo::Bearing heading);

}  // namespace yars::radar
