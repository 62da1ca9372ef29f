// The box of whole cells that is made as one island: how far inside it a place lies. Beyond a box all is sea, since
// a cell without a file is; an edge at a pole, or where a box goes round the earth, is none.
#pragma once

#include "lib/geo/geodesic.hpp"

namespace yars::model::terrain {

struct LandscapeBox {
  int south_deg = -90;  // [-90, 89]
  int west_deg = -180;  // [-180, 179]
  int cells_north = 180;
  int cells_east = 360;

  // [km] to the nearest edge, round the corners in an arc; negative outside, very large without an edge.
  double inside_km(geo::GeoPoint place) const;
};

}  // namespace yars::model::terrain
