#include "model/reflectivity/ground_grid.hpp"

#include <algorithm>
#include <cmath>

#include "lib/geo/quantity.hpp"

namespace yars::model::reflectivity {

namespace {
constexpr double kMetresPerDegree = 60.0 * geo::kMetresPerNauticalMile;  // [m] of latitude, to half a percent

// The finalizer "lowbias32" (C. Wellons, "hash prospector"): every bit in moves every bit out.
std::uint32_t mixed(std::uint32_t x) {
  x ^= x >> 16U;
  x *= 0x7feb352dU;
  x ^= x >> 15U;
  x *= 0x846ca68bU;
  return x ^ (x >> 16U);
}
}  // namespace

GroundGrid make_ground_grid(double edge_m) {
  GroundGrid grid;
  grid.rows_per_degree = kMetresPerDegree / edge_m;
  for (std::size_t band = 0; band < grid.columns.size(); ++band) {
    const double latitude_deg = static_cast<double>(band) - 89.5;
    const double around = 360.0 * grid.rows_per_degree * std::cos(latitude_deg * geo::kRadiansPerDegree);
    grid.columns[band] = std::max(1.0, std::round(around));
  }
  return grid;
}

std::uint32_t ground_bits(const GroundGrid& grid, geo::GeoPoint place) {
  const double north_deg = place.latitude_deg + 90.0;
  const auto band = static_cast<std::size_t>(std::clamp(north_deg, 0.0, 179.0));
  const double turns = place.longitude_deg / 360.0 + 0.5;
  // By way of signed integers: those a loop converts many at a time.
  const auto row = static_cast<std::int32_t>(std::max(0.0, north_deg * grid.rows_per_degree));
  const auto column = static_cast<std::int32_t>((turns - std::floor(turns)) * grid.columns[band]);
  return mixed(static_cast<std::uint32_t>(row) * kRowFactor + static_cast<std::uint32_t>(column));
}

}  // namespace yars::model::reflectivity
