#include "model/terrain/landscape_box.hpp"

#include <algorithm>
#include <cmath>

namespace yars::model::terrain {

namespace {

constexpr double kKmPerDegree = 111.195;  // [km] of a sphere of 6371 km: shape only, no navigation
constexpr double kCornerKm = 45.0;        // [km] radius of a corner; sharper ones show the box
constexpr double kNoEdgeKm = 1e6;

}  // namespace

double LandscapeBox::inside_km(geo::GeoPoint place) const {
  double north_km = kNoEdgeKm;  // to the nearer of the south and the north edge
  if (south_deg > -90) north_km = (place.latitude_deg - south_deg) * kKmPerDegree;
  const int north_deg = south_deg + cells_north;
  if (north_deg < 90) north_km = std::min(north_km, (north_deg - place.latitude_deg) * kKmPerDegree);
  double east_km = kNoEdgeKm;
  if (cells_east < 360) {
    double east_deg = place.longitude_deg - west_deg;
    if (east_deg < 0) east_deg += 360.0;
    const double km_per_degree = kKmPerDegree * std::max(0.0, std::cos(place.latitude_deg * geo::kRadiansPerDegree));
    east_km = std::min(east_deg, cells_east - east_deg) * km_per_degree;
  }
  const double radius_km = std::min(kCornerKm, 0.5 * kKmPerDegree * cells_north);
  if (north_km <= 0.0 || east_km <= 0.0 || north_km >= radius_km || east_km >= radius_km)
    return std::min(north_km, east_km);
  const double north = radius_km - north_km;
  const double east = radius_km - east_km;
  return radius_km - std::sqrt(north * north + east * east);
}

}  // namespace yars::model::terrain
