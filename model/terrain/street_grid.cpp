#include "model/terrain/street_grid.hpp"

#include <algorithm>
#include <cmath>

#include "model/terrain/noise.hpp"

namespace yars::model::terrain {

namespace {

constexpr double kMetresPerDegree = 111195.0;  // [m] of a sphere of 6371 km
constexpr double kPatchM = 5000.0;             // [m] a town of middle size
constexpr double kRowDeg = kPatchM / kMetresPerDegree;
constexpr std::uint32_t kSeed = 0;  // whatever the landscape's: real culture has streets too

}  // namespace

void StreetFinder::use_row(std::int32_t middle_row) {
  if (middle_row == middle_row_) return;
  middle_row_ = middle_row;
  for (int i = 0; i < 3; ++i) {
    Row& row = rows_[static_cast<std::size_t>(i)];
    const double row_middle_deg = std::clamp((middle_row - 1 + i + 0.5) * kRowDeg - 90.0, -90.0, 90.0);
    row.columns = std::max(1, static_cast<int>(360.0 * std::cos(row_middle_deg * geo::kRadiansPerDegree) / kRowDeg));
    row.column_deg = 360.0 / row.columns;
    row.middle = kNoRow;
  }
}

void StreetFinder::use_column(Row& row, std::int32_t number, int middle) {
  if (middle == row.middle) return;
  row.middle = middle;
  for (int i = 0; i < 3; ++i) {
    const int column = middle - 1 + i;
    StreetPatch& patch = row.neighbours[static_cast<std::size_t>(i)];
    const std::uint32_t hash = lattice_hash((column + row.columns) % row.columns, number, 3, kSeed);
    patch.origin = {(number + static_cast<double>(hash & 0xFFFFU) / 65536.0) * kRowDeg - 90.0,
                    (column + static_cast<double>(hash >> 16U) / 65536.0) * row.column_deg - 180.0};
    // Half of all towns keep near the compass, as surveyors like it.
    const std::uint32_t turn = lattice_hash((column + row.columns) % row.columns, number, 4, kSeed);
    patch.bearing_deg = (turn & 1U) != 0 ? 90.0 * share_of(turn) : std::fmod(97.5 - 15.0 * share_of(turn), 90.0);
  }
}

const StreetPatch& StreetFinder::nearest(geo::GeoPoint place) {
  const double latitude_deg = std::clamp(place.latitude_deg, -90.0, 90.0);
  const double longitude_deg = geo::wrapped_degrees(place.longitude_deg);
  const double parallel = std::cos(latitude_deg * geo::kRadiansPerDegree);
  use_row(static_cast<std::int32_t>(std::floor((latitude_deg + 90.0) / kRowDeg)));
  const StreetPatch* nearest = &rows_[0].neighbours[0];
  double least = 1e9;
  for (std::int32_t i = 0; i < 3; ++i) {
    Row& row = rows_[static_cast<std::size_t>(i)];
    use_column(row, middle_row_ - 1 + i, static_cast<int>((longitude_deg + 180.0) / row.column_deg));
    for (const StreetPatch& patch : row.neighbours) {
      const double east = (longitude_deg - patch.origin.longitude_deg) * parallel;
      const double north = latitude_deg - patch.origin.latitude_deg;
      const double square = east * east + north * north;
      if (square >= least) continue;
      least = square;
      nearest = &patch;
    }
  }
  return *nearest;
}

StreetPatch StreetFinder::patch(geo::GeoPoint place) {
  StreetPatch found = nearest(place);
  found.origin.longitude_deg = geo::wrapped_degrees(found.origin.longitude_deg);
  return found;
}

StreetPatch street_patch(geo::GeoPoint place) {
  return StreetFinder().patch(place);
}

}  // namespace yars::model::terrain
