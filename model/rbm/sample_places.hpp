// Where the samples of a sweep lie, by interpolation between five exact points of the geodesic. Away from the poles
// latitude and longitude are interpolated themselves; near them, where longitude turns quickly, the unit vector is.
// Accuracy: 0.5 m against the geodesic for any ray of up to 160 NM from any latitude. Longitudes may leave
// [-180, 180] by less than a turn: they run on across the antimeridian.
#pragma once

#include <span>

#include "lib/geo/bearing.hpp"
#include "lib/geo/geodesic.hpp"

namespace yars::model::rbm {

// Distances [m] in [0, range], finite; latitude and longitude [deg] as long as the distances.
void sample_places(geo::GeoPoint apex, geo::Bearing azimuth, geo::Length range, std::span<const double> distance_m,
                   std::span<double> latitude_deg, std::span<double> longitude_deg);

}  // namespace yars::model::rbm
