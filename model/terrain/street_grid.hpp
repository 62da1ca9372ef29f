// How streets lie: towns everywhere are laid out in patches of a few kilometres, each with one direction of its own.
// A pure function of place, the same whatever database is loaded, so that walls face the radar (the cardinal effect)
// alike over made-up and over real culture.
#pragma once

#include "lib/geo/geodesic.hpp"

namespace yars::model::terrain {

struct StreetPatch {
  geo::GeoPoint origin;      // a corner of the patch's grid of streets
  double bearing_deg = 0.0;  // [0, 90) of one set of streets; the other is at right angles
};

// The patch that holds a place: the nearest of scattered origins, about one to 5 x 5 km.
StreetPatch street_patch(geo::GeoPoint place);

inline double street_bearing_deg(geo::GeoPoint place) {
  return street_patch(place).bearing_deg;
}

}  // namespace yars::model::terrain
