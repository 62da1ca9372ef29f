// Which way the streets of a place run: one bearing for each town-sized piece of ground, the same from everywhere.
#pragma once

#include "lib/geo/geodesic.hpp"

namespace yars::model::reflectivity {

// [deg] true, [0, 90): the other streets run square to it. Any longitude.
double street_bearing_deg(geo::GeoPoint place);

}  // namespace yars::model::reflectivity
