// How streets lie: towns everywhere are laid out in patches of a few kilometres, each with one direction of its own.
// A pure function of place, the same whatever database is loaded, so that walls face the radar (the cardinal effect)
// alike over made-up and over real culture.
#pragma once

#include <array>
#include <cstdint>

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

// The same for places one after the other: the patches about the last one are remembered.
class StreetFinder {
 public:
  StreetPatch patch(geo::GeoPoint place);
  double bearing_deg(geo::GeoPoint place) { return nearest(place).bearing_deg; }

 private:
  static constexpr std::int32_t kNoRow = -10;
  struct Row {
    int columns = 1;                          // round the earth: a row of patches has as many as fit
    double column_deg = 0.0;                  // [deg] of longitude
    int middle = kNoRow;                      // the column that the neighbours are about
    std::array<StreetPatch, 3> neighbours{};  // their longitudes run on across the antimeridian
  };
  const StreetPatch& nearest(geo::GeoPoint place);
  void use_row(std::int32_t middle_row);
  void use_column(Row& row, std::int32_t number, int middle);

  std::int32_t middle_row_ = kNoRow;
  std::array<Row, 3> rows_{};
};

}  // namespace yars::model::terrain
