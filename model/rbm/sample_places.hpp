// Where the samples of a sweep lie. With five knots or more, a Taylor series of the geodesic where it holds within 1 mm
// (GeodesicSeries: rays short against the way to the pole, the usual case); else, and with fewer knots always, by
// interpolation between so many exact points, in double. Away from the poles latitude and longitude are interpolated
// themselves; near them, where longitude turns quickly, the unit vector is. Accuracy with five knots or more: 0.5 m
// against the geodesic for any ray of up to 160 NM from any latitude, millimetres at middle latitudes. Longitudes run
// on across the antimeridian.
#pragma once

#include <cstddef>

#include "lib/geo/bearing.hpp"
#include "lib/geo/geodesic.hpp"
#include "lib/memory/line_vector.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::rbm {

inline constexpr int kLeastKnots = 2;
inline constexpr int kMostKnots = 9;
inline constexpr int kExactPlaces = 0;  // as knots: the geodesic itself at every sample
inline constexpr int kSeriesKnots = 5;  // so many or more: a series will do where it is as good

// Entries behind the last sample that a pair of vectors may read.
inline constexpr std::size_t kPairSlack = 2 * terrain::kRunSlack;

// Room for the places of a sweep, and the run that they make.
struct PlaceArrays {
  explicit PlaceArrays(std::size_t samples)
      : count(samples),
        cells_north(samples + kPairSlack),
        cells_east(cells_north),
        north_deg(cells_north),
        east_deg(cells_north) {}
  terrain::PlaceRun run() const {
    return {corner,
            {cells_north.data(), count},
            {cells_east.data(), count},
            {north_deg.data(), count},
            {east_deg.data(), count}};
  }

  std::size_t count;
  terrain::CellPlace corner;  // of the cell that holds the apex
  memory::LineVector<float> cells_north, cells_east, north_deg, east_deg;
};

// Distances [m] in [0, range], finite, ascending, as many as the places; terrain::kRunSlack entries more behind them
// are read.
void sample_places(geo::GeoPoint apex, geo::Bearing azimuth, geo::Length range, int knots, const float* distance_m,
                   PlaceArrays& places);

}  // namespace yars::model::rbm
