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

StreetPatch street_patch(geo::GeoPoint place) {
  const double latitude_deg = std::clamp(place.latitude_deg, -90.0, 90.0);
  const double longitude_deg = geo::wrapped_degrees(place.longitude_deg);
  const double parallel = std::cos(latitude_deg * geo::kRadiansPerDegree);
  const auto middle_row = static_cast<std::int32_t>(std::floor((latitude_deg + 90.0) / kRowDeg));
  StreetPatch nearest;
  double least = 1e9;
  for (std::int32_t row = middle_row - 1; row <= middle_row + 1; ++row) {
    const double row_middle_deg = std::clamp((row + 0.5) * kRowDeg - 90.0, -90.0, 90.0);
    // A row of patches has as many as fit round it.
    const int columns =
        std::max(1, static_cast<int>(360.0 * std::cos(row_middle_deg * geo::kRadiansPerDegree) / kRowDeg));
    const double column_deg = 360.0 / columns;
    const int middle = static_cast<int>((longitude_deg + 180.0) / column_deg);
    for (int column = middle - 1; column <= middle + 1; ++column) {
      const std::uint32_t hash = lattice_hash((column + columns) % columns, row, 3, kSeed);
      const double origin_deg = (column + static_cast<double>(hash >> 16U) / 65536.0) * column_deg - 180.0;
      const double north_deg = (row + static_cast<double>(hash & 0xFFFFU) / 65536.0) * kRowDeg - 90.0;
      const double east = (longitude_deg - origin_deg) * parallel;
      const double north = latitude_deg - north_deg;
      const double square = east * east + north * north;
      if (square >= least) continue;
      least = square;
      nearest.origin = {north_deg, geo::wrapped_degrees(origin_deg)};
      // Half of all towns keep near the compass, as surveyors like it.
      const std::uint32_t turn = lattice_hash((column + columns) % columns, row, 4, kSeed);
      nearest.bearing_deg = (turn & 1U) != 0 ? 90.0 * share_of(turn) : std::fmod(97.5 - 15.0 * share_of(turn), 90.0);
    }
  }
  return nearest;
}

}  // namespace yars::model::terrain
